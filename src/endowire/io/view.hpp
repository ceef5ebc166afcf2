#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace endowire::io {

/// How a patient is looked at.
struct Directions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit: the long axis of the vessel, away from the access
  Eigen::Vector3d forward =
      Eigen::Vector3d::UnitY();  ///< unit, normal to `up`: into the picture, from the front
};

/// The front is seen along the weight, as on a patient who lies on the back, or along the vessel's shortest axis when
/// there is no weight.
/// @param box  around the vessel [mm]
[[nodiscard]] Directions directions_of(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& access_mm,
                                       const Eigen::Vector3d& gravity_m_per_s2);

}  // namespace endowire::io

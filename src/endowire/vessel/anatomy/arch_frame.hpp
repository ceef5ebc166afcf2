#pragma once

#include <Eigen/Core>

#include "endowire/vessel/anatomy/parameters.hpp"

namespace endowire::vessel::anatomy {

/// The arch of the aorta: half a circle in an upright plane. φ counts from its top [rad], negative on the
/// ascending side.
struct ArchFrame {
  Eigen::Vector3d centre_mm;
  Eigen::Vector3d along;  ///< horizontal, from the ascending to the descending side
  double radius_mm = 0.0;
  double trunk_phi = 0.0;  ///< where the brachiocephalic trunk leaves
  double carotid_phi = 0.0;
  double subclavian_phi = 0.0;

  [[nodiscard]] Eigen::Vector3d at_mm(double phi) const;
  [[nodiscard]] Eigen::Vector3d flow(double phi) const;
  [[nodiscard]] Eigen::Vector3d outward(double phi) const;
  /// Direction at an angle to the flow, from the outer side of the arch turned about the flow by `clock_rad`:
  /// positive to the left and front, negative to the right and back.
  [[nodiscard]] Eigen::Vector3d leaving(double phi, double angle_rad, double clock_rad) const;
};

/// Where the branches leave, around the arch from its outer side: the trunk to the right and back. Estimates.
inline constexpr double trunk_clock_deg = -20.0;
inline constexpr double carotid_clock_deg = 0.0;
inline constexpr double subclavian_clock_deg = 5.0;

/// Places the arch above the descending aorta and its branches on the arch.
///
/// The type of an arch says how far below its top the trunk's ostium lies: type I less than one diameter of the
/// common carotid artery, type II one to two, type III more than two [Madhwal2008]. Here: (type − ½) diameters,
/// which fixes φ of the trunk; the others follow at their distances along the axis.
[[nodiscard]] ArchFrame arch_frame(const Values& values);

}  // namespace endowire::vessel::anatomy

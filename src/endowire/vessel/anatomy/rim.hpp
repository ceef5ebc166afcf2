#pragma once

#include <Eigen/Core>

namespace endowire::vessel::anatomy {

/// A circle that a border of a mesh runs along: an open end of a vessel.
struct Rim {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< out of the vessel, length one
  double radius_mm = 0.0;
};

}  // namespace endowire::vessel::anatomy

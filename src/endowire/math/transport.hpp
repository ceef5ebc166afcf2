#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace endowire::math {

/// Parallel transport of `v` along the great arc from the unit tangent `from` to the unit tangent `to`: the
/// smallest rotation that takes one to the other, applied to `v`.
///
/// Domain   from·to > −1: a rod never turns by 180° within one update (steps are limited far below).
/// Source   [Bergou2008 §4.2]
[[nodiscard]] inline Eigen::Vector3d parallel_transport(const Eigen::Vector3d& v, const Eigen::Vector3d& from,
                                                        const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  return from.dot(to) * v + axis.cross(v) + axis * (axis.dot(v) / (1.0 + from.dot(to)));
}

/// Rotates `director`, normal to the unit `axis`, right-handedly about it.
[[nodiscard]] inline Eigen::Vector3d spin_about(const Eigen::Vector3d& director, const Eigen::Vector3d& axis,
                                                double angle_rad) {
  return std::cos(angle_rad) * director + std::sin(angle_rad) * axis.cross(director);
}

/// The unit vector along the part of `director` that is normal to the unit `axis`.
[[nodiscard]] inline Eigen::Vector3d normal_part(const Eigen::Vector3d& director,
                                                 const Eigen::Vector3d& axis) {
  return (director - axis * axis.dot(director)).normalized();
}

/// Some unit vector normal to the unit `axis`, the same for the same axis.
[[nodiscard]] inline Eigen::Vector3d any_normal(const Eigen::Vector3d& axis) {
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  return axis.cross(Eigen::Vector3d::Unit(smallest)).normalized();
}

}  // namespace endowire::math

#pragma once

#include <Eigen/Core>

#include "endowire/vessel/field.hpp"

namespace endowire::sim {

/// Curvature of the vessel ahead of a point in it, from how far one sees along it [1/mm].
///
///   κ = 2R / (d² − R²)
///
/// d is the way from the middle of the lumen, straight on along the wall, to the wall: in a tube of radius R whose axis is a circle of
/// radius 1/κ, (1/κ + R)² = 1/κ² + d². No more than 1/R, where the vessel ends or the point looks at the wall.
/// Domain  d up to 60 mm: what bends less counts as straight, κ = 0
/// @param direction  unit, in which the vessel is looked at
[[nodiscard]] double vessel_curvature_ahead_per_mm(const vessel::Field& field,
                                                   const Eigen::Vector3d& point_mm,
                                                   const Eigen::Vector3d& direction);

}  // namespace endowire::sim

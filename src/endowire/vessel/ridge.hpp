#pragma once

#include <Eigen/Core>

#include "endowire/vessel/lumen_space.hpp"

namespace endowire::vessel {

/// The centre of a lumen's section.
struct RidgePoint {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0.0;
  bool settled = false;  ///< false: the radius still grows where the search had to stop, as beside an ostium
};

/// Climbs in a plane to the ridge of the inscribed radius.
///
///   max φ(x),  x = x₀ + a e₁ + b e₂,  |a|, |b| ≤ reach
///
/// Each place visited adds the tangent plane of φ there, φ ≤ φ_i + n_i·(x − x_i); the next place is the highest
/// point under all of them (Kelley's cutting planes), found by trying all their corners. Where the walls are
/// flat facets the planes are φ itself, and the centre is exact after a few steps. The best place visited is
/// kept, so a wall that bulges inward, where planes cut too deep, costs accuracy and no more.
///
/// Source  J. E. Kelley, J. Soc. Indust. Appl. Math. 8:703, 1960 [Kelley1960].
/// @param start     inside the lumen
/// @param normal    of the plane, length one
/// @param reach_mm  furthest move along each axis of the plane
[[nodiscard]] RidgePoint climb_to_ridge(const LumenSpace& lumen, const Eigen::Vector3d& start_mm,
                                        const Eigen::Vector3d& normal, double reach_mm);

}  // namespace endowire::vessel

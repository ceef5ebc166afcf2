#pragma once

#include <Eigen/Core>
#include <vector>

namespace endowire::vessel {

/// A smooth row of points near given ones.
///
///   min Σ_i w_i |p_i − q_i|² + λ Σ_i |p_{i+3} − 3 p_{i+2} + 3 p_{i+1} − p_i|²
///
/// Third differences vanish on parabolas and are θ³ of the radius on a circle of θ per point: the row follows
/// bends to 1/(1 + λθ⁶) of their radius and cuts no corners, while waves shorter than 2π λ^{1/6} points go.
/// Second differences, the usual choice, would pull every bend inward.
/// Source  penalised least squares on differences: [Whittaker1923]; third order: [Eilers2003].
/// @param points   q, at least 4
/// @param weights  w ≥ 0, some of them positive; one per point
[[nodiscard]] std::vector<Eigen::Vector3d> smooth_row(const std::vector<Eigen::Vector3d>& points,
                                                      const std::vector<double>& weights, double stiffness);

/// Points along a polyline at equal steps of ∫ ds/r, first and last included.
/// @param radii       r at the points of the line, > 0 [mm]
/// @param step        wanted, in radii [-]
/// @param min_pieces  at least so many
[[nodiscard]] std::vector<Eigen::Vector3d> resample_by_radius(const std::vector<Eigen::Vector3d>& line,
                                                              const std::vector<double>& radii_mm,
                                                              double step, std::size_t min_pieces);

}  // namespace endowire::vessel

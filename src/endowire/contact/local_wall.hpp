#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace endowire::contact {

/// The wall near one sample, as one detection saw it.
///
/// The height of the wire's axis over the wall follows the displacement u of the sample with no new detection; this is
/// the force correction of the method. Two kinds of wall:
///
///   round   H(u) = (2a − κ₁(a² + b²)) / (1 + S) − ½ κ₂ c²,   S = √((1 − κ₁a)² + κ₁²b²)
///   ridge   H(u) = ½ (a + a' + √((a − a')² + w²)) − ½ κ₂ c²
///           a = h + n·u,  a' = h' + n'·u,  b = e₁·u,  c = e₂·u
///
/// Round is the exact distance to a circle of curvature κ₁ ≥ 0, concave towards the lumen (a tube; a plane for κ₁ = 0), so
/// that a wire may run all round a tube. A ridge (a carina, the rim of an ostium, the edge between two facets that stand out)
/// is the greater of two planes, joined by a hyperbola that passes through the height at the sample: sharp and rounded
/// ridges alike. The second direction, usually that of the vessel's axis, is second order.
/// To either, c + t·w + ½ wᵀBw is added, w = u − u₀: the correction by which the wall has the height and the slope of the field
/// where the sample was last compared with it, at u₀. Zero at detection; set by correct_local_wall().
/// Symbols    n, n' normals into the lumen, h, h' heights of the two planes at the sample; e₁, e₂ directions of
///            principal curvature, w blend of the ridge [mm]
/// Source     ours; a single plane errs by u²/2R, 0.17 mm for u = 1 mm in a vessel of 3 mm.
/// Accuracy   exact on planes, cylinders and along their axes, and over edges to their blend; else third order.
struct LocalWall {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  Eigen::Vector3d first = Eigen::Vector3d::UnitY();
  Eigen::Vector3d second = Eigen::Vector3d::UnitZ();
  double height_mm = 0.0;
  double first_curvature_per_mm = 0.0;
  double second_curvature_per_mm = 0.0;
  bool ridge = false;
  Eigen::Vector3d other_normal = Eigen::Vector3d::UnitX();
  double other_height_mm = 0.0;
  double blend_mm = 0.0;
  bool corrected = false;
  Eigen::Vector3d corrected_at_mm = Eigen::Vector3d::Zero();  ///< u₀
  double offset_mm = 0.0;                                     ///< c
  Eigen::Vector3d tilt = Eigen::Vector3d::Zero();             ///< t
  Eigen::Matrix3d bend_per_mm = Eigen::Matrix3d::Zero();      ///< B
};

/// Walls that one sample may have around it: a corner of three and what is opposite.
inline constexpr std::size_t kMaxWalls = 4;

/// Height with its gradient and Hessian by the displacement.
struct LocalHeight {
  double value_mm = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

[[nodiscard]] double local_height_mm(const LocalWall& wall, const Eigen::Vector3d& displacement_mm);
[[nodiscard]] LocalHeight local_height_derivatives(const LocalWall& wall,
                                                   const Eigen::Vector3d& displacement_mm);

/// Gives a wall the height and the gradient that it is found to have at a displacement.
///
/// From the second time on a wall that turns faster than it should, and towards the wire, gets the curvature that two gradients
/// show (the symmetric rank-one secant update): in a shallow crease tilts alone would swing from side to side for ever.
/// Source  B ← B + rrᵀ/rᵀs, r = y − Bs: [Nocedal2006]
void correct_local_wall(const Eigen::Vector3d& displacement_mm, double height_mm,
                        const Eigen::Vector3d& gradient, LocalWall& wall);

/// Whether an equilibrium with this wall, as it was corrected before, is one on a kink of the field: the two places differ by less than
/// the solution's own accuracy, and the slope of the wall lies between what the field had there and what it has here. No
/// correction brings it nearer, the field has no one slope; the wall's, which balances the forces, is one of its
/// generalised slopes there.
/// Source  generalised gradients: [Clarke1983 §2.5]
/// @param accuracy_mm     of positions
/// @param slope_accuracy  of slopes
[[nodiscard]] bool rests_on_kink(const LocalWall& wall, const Eigen::Vector3d& displacement_mm,
                                 const Eigen::Vector3d& gradient, double accuracy_mm, double slope_accuracy);

}  // namespace endowire::contact

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace endowire::contact {

/// The wall near one sample, as one detection saw it: an osculating surface.
///
/// The height of the wire's axis over the wall follows the displacement u of the sample with no new detection; this is
/// the force correction of the method.
///
///   a = h + n·u,  b₁ = e₁·u,  b₂ = e₂·u
///   H(u) = (2a − κ₁(a² + b₁²)) / (1 + S) − ½ κ₂ b₂²,   S = √((1 − κ₁a)² + κ₁²b₁²)
///
/// The first term is the exact distance to a circle of curvature κ₁ (κ₁ > 0: concave towards the lumen, a tube; κ₁ = 0: a
/// plane; κ₁ < 0: a ridge, such as a carina or the rim of an ostium), so that a wire may run all round a tube; the
/// second direction, usually that of the vessel's axis, is second order.
/// Symbols    n normal into the lumen, e₁, e₂ directions of principal curvature, |κ₁| ≥ |κ₂|
/// Source     ours; a single plane errs by u²/2R, 0.17 mm for u = 1 mm in a vessel of 3 mm.
/// Accuracy   exact on planes, cylinders and along their axes; third order on smooth surfaces.
struct LocalWall {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  Eigen::Vector3d first = Eigen::Vector3d::UnitY();
  Eigen::Vector3d second = Eigen::Vector3d::UnitZ();
  double height_mm = 0.0;
  double first_curvature_per_mm = 0.0;
  double second_curvature_per_mm = 0.0;
};

/// Height with its gradient and Hessian by the displacement.
struct LocalHeight {
  double value_mm = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

[[nodiscard]] double local_height_mm(const LocalWall& wall, const Eigen::Vector3d& displacement_mm);
[[nodiscard]] LocalHeight local_height_derivatives(const LocalWall& wall, const Eigen::Vector3d& displacement_mm);

}  // namespace endowire::contact

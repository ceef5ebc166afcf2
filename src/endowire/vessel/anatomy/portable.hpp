#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace endowire::vessel::anatomy {

// Arithmetic with the same bits on every machine: sums of products in one written order (a vectorised reduction
// adds in another), sine and cosine from + − × and floor alone (C libraries differ in their last bit). A
// generated vessel is a reference that others must be able to make again.

/// Scalar product, from x to z.
[[nodiscard]] inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

[[nodiscard]] inline double length(const Eigen::Vector3d& v) {
  return std::sqrt(dot(v, v));
}

/// v / |v|, for v ≠ 0.
[[nodiscard]] inline Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  return v / length(v);
}

[[nodiscard]] inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

[[nodiscard]] inline double radians(double angle_deg) {
  return angle_deg * (std::numbers::pi / 180.0);
}

/// sin x by its Taylor series up to x¹⁷ on [−π/4, π/4] and the quadrant.
/// Accuracy  1e-15 for |x| ≤ 100.
[[nodiscard]] double sine(double angle_rad);
/// cos x, likewise.
[[nodiscard]] double cosine(double angle_rad);

/// `v` turned by an angle about the unit vector `axis`, right-handed (Rodrigues' formula).
[[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& v, const Eigen::Vector3d& axis, double angle_rad);

/// Twice continuously differentiable step from 0 to 1 between u = 0 and u = 1: u³ (10 − 15 u + 6 u²).
[[nodiscard]] inline double smooth_step(double u) {
  if (u <= 0.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

}  // namespace endowire::vessel::anatomy

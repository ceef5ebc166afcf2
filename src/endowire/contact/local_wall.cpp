#include "endowire/contact/local_wall.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::contact {

double local_height_mm(const LocalWall& wall, const Eigen::Vector3d& displacement_mm) {
  const Eigen::Vector3d& u = displacement_mm;
  const double k = wall.first_curvature_per_mm;
  const double a = wall.height_mm + wall.normal.dot(u);
  const double b = wall.first.dot(u);
  const double c = wall.second.dot(u);
  if (wall.ridge) {
    const double other = wall.other_height_mm + wall.other_normal.dot(u);
    return 0.5 * (a + other + std::hypot(a - other, wall.blend_mm)) -
           0.5 * wall.second_curvature_per_mm * c * c;
  }
  const double s = std::hypot(1.0 - k * a, k * b);
  return (2.0 * a - k * (a * a + b * b)) / (1.0 + s) - 0.5 * wall.second_curvature_per_mm * c * c;
}

namespace {

LocalHeight ridge_derivatives(const LocalWall& wall, double a, double c, const Eigen::Vector3d& u) {
  const double other = wall.other_height_mm + wall.other_normal.dot(u);
  const double s = std::max(std::hypot(a - other, wall.blend_mm), 1e-12);
  const Eigen::Vector3d difference = wall.normal - wall.other_normal;
  LocalHeight h;
  h.value_mm = 0.5 * (a + other + s) - 0.5 * wall.second_curvature_per_mm * c * c;
  h.gradient = 0.5 * (wall.normal + wall.other_normal) + 0.5 * (a - other) / s * difference -
               wall.second_curvature_per_mm * c * wall.second;
  h.hessian = 0.5 * wall.blend_mm * wall.blend_mm / (s * s * s) * difference * difference.transpose() -
              wall.second_curvature_per_mm * wall.second * wall.second.transpose();
  return h;
}

}  // namespace

LocalHeight local_height_derivatives(const LocalWall& wall, const Eigen::Vector3d& displacement_mm) {
  const Eigen::Vector3d& u = displacement_mm;
  const double k = wall.first_curvature_per_mm;
  const double a = wall.height_mm + wall.normal.dot(u);
  const double b = wall.first.dot(u);
  const double c = wall.second.dot(u);
  if (wall.ridge) return ridge_derivatives(wall, a, c, u);
  const double p = 1.0 - k * a;
  // At the centre of curvature the distance has no gradient; no wire that touches the wall is there.
  const double s = std::max(std::hypot(p, k * b), 1e-9);
  LocalHeight h;
  h.value_mm = (2.0 * a - k * (a * a + b * b)) / (1.0 + s) - 0.5 * wall.second_curvature_per_mm * c * c;
  h.gradient =
      (p / s) * wall.normal - (k * b / s) * wall.first - wall.second_curvature_per_mm * c * wall.second;
  const double s3 = s * s * s;
  const Eigen::Vector3d turning = k * b * wall.normal + p * wall.first;  // tangent of the circle, times s
  h.hessian = -(k / s3) * turning * turning.transpose() -
              wall.second_curvature_per_mm * wall.second * wall.second.transpose();
  return h;
}

}  // namespace endowire::contact

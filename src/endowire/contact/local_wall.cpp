#include "endowire/contact/local_wall.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::contact {

namespace {

double correction_mm(const LocalWall& wall, const Eigen::Vector3d& u) {
  if (!wall.corrected) return 0.0;
  const Eigen::Vector3d w = u - wall.corrected_at_mm;
  return wall.offset_mm + wall.tilt.dot(w) + 0.5 * w.dot(wall.bend_per_mm * w);
}

void add_correction(const LocalWall& wall, const Eigen::Vector3d& u, LocalHeight& h) {
  if (!wall.corrected) return;
  h.value_mm += correction_mm(wall, u);
  h.gradient += wall.tilt + wall.bend_per_mm * (u - wall.corrected_at_mm);
  h.hessian += wall.bend_per_mm;
}

}  // namespace

double local_height_mm(const LocalWall& wall, const Eigen::Vector3d& displacement_mm) {
  const Eigen::Vector3d& u = displacement_mm;
  const double k = wall.first_curvature_per_mm;
  const double a = wall.height_mm + wall.normal.dot(u);
  const double b = wall.first.dot(u);
  const double c = wall.second.dot(u);
  const double corrected = correction_mm(wall, u) - 0.5 * wall.second_curvature_per_mm * c * c;
  if (wall.ridge) {
    const double other = wall.other_height_mm + wall.other_normal.dot(u);
    return 0.5 * (a + other + std::hypot(a - other, wall.blend_mm)) + corrected;
  }
  const double s = std::hypot(1.0 - k * a, k * b);
  return (2.0 * a - k * (a * a + b * b)) / (1.0 + s) + corrected;
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
  add_correction(wall, u, h);
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
  add_correction(wall, u, h);
  return h;
}

void correct_local_wall(const Eigen::Vector3d& displacement_mm, double height_mm,
                        const Eigen::Vector3d& gradient, LocalWall& wall) {
  constexpr double kAlong =
      0.1;  // cosine between the turn of the wall and the motion, for one to be due to the other
  constexpr double kLeastMotion_mm = 1e-5;
  const Eigen::Vector3d& u = displacement_mm;
  LocalHeight now = local_height_derivatives(wall, u);
  const Eigen::Vector3d turn = gradient - now.gradient;
  const Eigen::Vector3d moved = u - wall.corrected_at_mm;
  const double along = turn.dot(moved);
  if (wall.corrected) wall.tilt += wall.bend_per_mm * moved;
  if (wall.corrected && moved.norm() > kLeastMotion_mm && along < -kAlong * turn.norm() * moved.norm())
    wall.bend_per_mm += turn * turn.transpose() / along;
  wall.tilt += turn;
  wall.corrected_at_mm = u;
  wall.offset_mm = 0.0;
  wall.corrected = true;
  wall.offset_mm = height_mm - local_height_mm(wall, u);
}

bool rests_on_kink(const LocalWall& wall, const Eigen::Vector3d& displacement_mm,
                   const Eigen::Vector3d& gradient, double accuracy_mm, double slope_accuracy) {
  if (!wall.corrected || (displacement_mm - wall.corrected_at_mm).norm() > accuracy_mm) return false;
  const Eigen::Vector3d there = local_height_derivatives(wall, wall.corrected_at_mm).gradient;
  const Eigen::Vector3d jump = gradient - there;
  if (jump.isZero()) return false;
  const Eigen::Vector3d turned = local_height_derivatives(wall, displacement_mm).gradient - there;
  const double share = std::clamp(turned.dot(jump) / jump.squaredNorm(), 0.0, 1.0);
  return (turned - share * jump).norm() <= slope_accuracy;
}

}  // namespace endowire::contact

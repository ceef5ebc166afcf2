#include "endowire/contact/detect.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/math/transport.hpp"

namespace endowire::contact {

namespace {

/// Height over the wall at which a path is stopped: the wire's axis never comes so near, its radius keeps it off.
constexpr double kStop_mm = 0.02;
/// Curvature is measured over this length, or this share of the lumen radius: a few cells of the distance field.
constexpr double kCurvatureStep_mm = 0.25;
constexpr double kCurvatureStep_radii = 0.15;
/// Walls are looked for this far around a sample: beyond what it moves in one step, usually.
constexpr double kProbe_mm = 0.6;
constexpr double kProbe_radii = 0.5;
/// A wall is added where the known ones are wrong by more than this: half of the gap error that is allowed.
constexpr double kNewWall_mm = 0.01;
/// Concave curvature above 2/R is a corner between facets, not a round wall: taken as planes.
constexpr double kCornerCurvature_radii = 2.0;
/// A ridge sharper than this is as good as an edge.
constexpr double kSharpestRidge_per_mm = 20.0;

/// Convex walls from this curvature on are taken as ridges.
constexpr double kRidge_per_mm = 0.02;
/// Blend of a perfectly sharp edge: keeps Newton's Hessian finite.
constexpr double kLeastBlend_mm = 0.005;

struct PrincipalCurvatures {
  Eigen::Vector3d first, second;
  double first_per_mm, second_per_mm;
};

/// Curvature of the wall itself from that of the level set at height φ: κ = −h/(1 − hφ), h an eigenvalue of ∇∇φ.
double wall_curvature(double level_set, double height_mm, double lumen_radius_mm) {
  const double denominator = 1.0 - level_set * height_mm;
  if (level_set > 0.0 && denominator < level_set / kSharpestRidge_per_mm) return -kSharpestRidge_per_mm;
  const double curvature = -level_set / denominator;
  return curvature > kCornerCurvature_radii / lumen_radius_mm ? 0.0 : curvature;
}

PrincipalCurvatures principal_curvatures(const vessel::Field& field, const Eigen::Vector3d& point,
                                         double height, const Eigen::Vector3d& e1, const Eigen::Vector3d& e2,
                                         double lumen_radius) {
  const double step = std::min(kCurvatureStep_mm, kCurvatureStep_radii * lumen_radius);
  const auto slope = [&](const Eigen::Vector3d& e) {
    return Eigen::Vector3d((field.at(point + step * e).gradient - field.at(point - step * e).gradient) /
                           (2.0 * step));
  };
  const Eigen::Vector3d s1 = slope(e1);
  const Eigen::Vector3d s2 = slope(e2);
  const double a = s1.dot(e1);
  const double b = s2.dot(e2);
  const double c = 0.5 * (s1.dot(e2) + s2.dot(e1));
  const double angle = 0.5 * std::atan2(2.0 * c, a - b);
  const double mean = 0.5 * (a + b);
  const double radius = std::hypot(0.5 * (a - b), c);
  PrincipalCurvatures k{std::cos(angle) * e1 + std::sin(angle) * e2,
                        std::cos(angle) * e2 - std::sin(angle) * e1,
                        wall_curvature(mean + radius, height, lumen_radius),
                        wall_curvature(mean - radius, height, lumen_radius)};
  if (std::abs(k.second_per_mm) > std::abs(k.first_per_mm)) {
    std::swap(k.first, k.second);
    std::swap(k.first_per_mm, k.second_per_mm);
  }
  return k;
}

/// Turns a convex wall into the two planes on both sides of its ridge, at the sample as high as the field says.
void make_ridge(const vessel::Field& field, const Eigen::Vector3d& q, double height, double reach,
                LocalWall& wall) {
  const Eigen::Vector3d offset = reach * wall.first;
  const vessel::WallDistance one = field.at(q + offset);
  const vessel::WallDistance other = field.at(q - offset);
  const double one_height = one.distance_mm - one.gradient.dot(offset);
  const double other_height = other.distance_mm + other.gradient.dot(offset);
  const double twice_blend = 2.0 * height - one_height - other_height;
  const double split = one_height - other_height;
  // Not convex over the whole reach: the circle stays.
  if (!(twice_blend >= std::abs(split)) || one.gradient.dot(other.gradient) < 0.0) return;
  wall.ridge = true;
  wall.normal = one.gradient;
  wall.height_mm = one_height;
  wall.other_normal = other.gradient;
  wall.other_height_mm = other_height;
  wall.blend_mm = std::max(kLeastBlend_mm, std::sqrt(twice_blend * twice_blend - split * split));
}

double predicted_height_mm(const Sample& sample, const Eigen::Vector3d& displacement) {
  double height = HUGE_VAL;
  for (int k = 0; k < sample.walls; ++k) {
    height = std::min(height, local_height_mm(sample.wall[static_cast<std::size_t>(k)], displacement));
  }
  return height;
}

}  // namespace

Eigen::Vector3d reachable_point_mm(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                                   const Eigen::Vector3d& to_mm) {
  const double length = (to_mm - from_mm).norm();
  // Where the nearest wall is further than the path is long, nothing can be in between.
  double height = field.at(from_mm).distance_mm;
  if (height > length || field.at(to_mm).distance_mm > length) return to_mm;
  double travelled = 0.0;
  double previous = -HUGE_VAL;
  while (height > kStop_mm || height > previous) {  // a path that starts low may rise
    travelled += std::max(height, 0.5 * kStop_mm);
    if (travelled >= length) return to_mm;
    previous = height;
    height = field.at(from_mm + travelled / length * (to_mm - from_mm)).distance_mm;
  }
  return length > 0.0 ? Eigen::Vector3d(from_mm + travelled / length * (to_mm - from_mm)) : from_mm;
}

Eigen::Vector3d slid_point_mm(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                              const Eigen::Vector3d& to_mm, double radius_mm) {
  Eigen::Vector3d at = reachable_point_mm(field, from_mm, to_mm);
  for (int slide = 0; slide < 2; ++slide) {
    Eigen::Vector3d left = to_mm - at;
    if (left.norm() < kStop_mm) return at;
    const vessel::WallDistance wall = field.at(at);
    const double slope = wall.gradient.norm();
    if (!(slope > 0.5)) return at;
    const Eigen::Vector3d n = wall.gradient / slope;
    at += std::max(0.0, radius_mm - wall.distance_mm) * n;
    left -= n * n.dot(left);
    at = reachable_point_mm(field, at, at + left);
  }
  return at;
}

void find_local_walls(const vessel::Field& field, const ContactSpec& spec, const Eigen::Vector3d& tangent,
                      Sample& sample) {
  Eigen::Vector3d& q = sample.detected_at_mm;
  vessel::WallDistance nearest = field.at(q);
  if (nearest.distance_mm < sample.radius_mm && nearest.gradient.norm() > 0.5) {
    // Lifted to where the wire will lie on the wall: there the local walls must be good.
    q += (sample.radius_mm - nearest.distance_mm) * nearest.gradient.normalized();
    nearest = field.at(q);
  }
  sample.walls = 0;
  sample.clearance_mm = nearest.distance_mm - sample.radius_mm;
  const double slope = nearest.gradient.norm();
  if (sample.clearance_mm > spec.reach_mm || !(slope > 0.1)) return;

  sample.lumen_radius_mm = field.lumen_radius_mm(q);
  const Eigen::Vector3d n = nearest.gradient / slope;
  Eigen::Vector3d e2 = tangent - n * n.dot(tangent);
  e2 = e2.norm() > 0.1 ? e2.normalized() : math::any_normal(n);
  const Eigen::Vector3d e1 = n.cross(e2);

  // Low over the wall the field is smooth; at the middle of a lumen its gradient jumps.
  const double height = std::min(nearest.distance_mm, 0.3 * sample.lumen_radius_mm);
  const PrincipalCurvatures k = principal_curvatures(field, q - (nearest.distance_mm - height) * n, height,
                                                     e1, e2, sample.lumen_radius_mm);
  sample.wall[0] = LocalWall{n, k.first, k.second, nearest.distance_mm, k.first_per_mm, k.second_per_mm};
  sample.walls = 1;
  const double reach = std::min(kProbe_mm, kProbe_radii * sample.lumen_radius_mm);
  if (k.first_per_mm < -kRidge_per_mm) make_ridge(field, q, nearest.distance_mm, reach, sample.wall[0]);

  for (const double distance : {reach, 0.4 * reach}) {
    for (const Eigen::Vector3d& direction : {e1, Eigen::Vector3d(-e1), e2, Eigen::Vector3d(-e2)}) {
      if (sample.walls == Sample::kMaxWalls) break;
      const Eigen::Vector3d offset = distance * direction;
      const vessel::WallDistance probe = field.at(q + offset);
      if (probe.distance_mm > predicted_height_mm(sample, offset) - kNewWall_mm) continue;
      const double norm = probe.gradient.norm();
      if (!(norm > 0.5)) continue;
      const Eigen::Vector3d normal = probe.gradient / norm;
      const Eigen::Vector3d first = math::any_normal(normal);
      // Over a ridge the plane would pass above the sample: no wall is nearer to it than the nearest one.
      sample.wall[static_cast<std::size_t>(sample.walls++)] =
          LocalWall{normal,
                    first,
                    normal.cross(first),
                    std::max(probe.distance_mm - normal.dot(offset), nearest.distance_mm),
                    0.0,
                    0.0};
    }
  }
}

}  // namespace endowire::contact

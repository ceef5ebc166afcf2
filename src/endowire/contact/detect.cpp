#include "endowire/contact/detect.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/math/transport.hpp"

namespace endowire::contact {

namespace {

/// Height over the wall at which a path is stopped: the wire's axis never comes so near, its radius keeps it off.
constexpr double kStop_mm = 0.02;
/// Walls are looked for this far around a sample: as far as it moves in a step, usually.
constexpr double kProbe_mm = 0.7;
constexpr double kProbe_radii = 0.4;
/// A wall is added where the known ones are wrong by more than this: half of the gap error that is allowed.
constexpr double kNewWall_mm = 0.01;
/// Largest difference of slope between a round wall and what the probes see: half a probe's length makes kNewWall_mm of it.
constexpr double kRoundSlope = 0.03;
/// Convex walls from this curvature on are taken as ridges.
constexpr double kRidge_per_mm = 0.02;
/// Blend of a perfectly sharp edge: keeps Newton's Hessian finite.
constexpr double kLeastBlend_mm = 0.005;

/// The wall on both sides of a sample, along one direction.
struct Profile {
  vessel::WallDistance ahead, behind;  ///< at ± reach along the direction
  double curvature_per_mm = 0.0;       ///< > 0 concave; of the side that bends less towards the wire
  bool round = false;                  ///< whether the wall has the slopes of such circles on both sides

  Profile(const vessel::Field& field, const Eigen::Vector3d& q, const Eigen::Vector3d& direction,
          double reach, double height)
      : ahead(field.at(q + reach * direction)), behind(field.at(q - reach * direction)) {
    const double one = curvature_to(ahead.distance_mm, height, reach);
    const double other = curvature_to(behind.distance_mm, height, reach);
    curvature_per_mm = std::min(one, other);
    round = has_slope(one, ahead.gradient.dot(direction), height, reach) &&
            has_slope(other, -behind.gradient.dot(direction), height, reach);
  }

 private:
  /// Of the circle through the height f a way ρ off, level at h here: (R − f)² = (R − h)² + ρ².
  static double curvature_to(double there, double height, double reach) {
    const double squares = height * height + reach * reach - there * there;
    return squares > 0.1 * reach * reach ? 2.0 * (height - there) / squares : 0.0;
  }
  static bool has_slope(double curvature, double slope, double height, double reach) {
    const double s = std::hypot(1.0 - curvature * height, curvature * reach);
    return std::abs(slope + curvature * reach / s) < kRoundSlope;
  }
};

double of_level_set(double wall_curvature, double height) {
  return -wall_curvature / (1.0 - wall_curvature * height);
}

double of_wall(double level_set_curvature, double height) {
  return -level_set_curvature / (1.0 - level_set_curvature * height);
}

/// Principal directions and curvatures of the wall from its profiles across the wire and along it, the more curved one first.
///
///   λ₁₁ = −κ₁₁/(1 − κ₁₁ h), λ₂₂ likewise, λ₁₂ from the gradients: ∇∇φ at the height h;  κ = −λ/(1 − λh) at the wall
struct Principal {
  Eigen::Vector3d first, second;
  double first_per_mm, second_per_mm;
  double twist_per_mm;  ///< λ₁₂: how far the profiles are from the principal directions

  Principal(const Profile& across, const Profile& along, const Eigen::Vector3d& e1, const Eigen::Vector3d& e2,
            double height, double reach) {
    const double a = of_level_set(across.curvature_per_mm, height);
    const double b = of_level_set(along.curvature_per_mm, height);
    twist_per_mm = (e2.dot(across.ahead.gradient - across.behind.gradient) +
                    e1.dot(along.ahead.gradient - along.behind.gradient)) /
                   (4.0 * reach);
    const double angle = 0.5 * std::atan2(2.0 * twist_per_mm, a - b);
    const double mean = 0.5 * (a + b);
    const double radius = std::hypot(0.5 * (a - b), twist_per_mm);
    first = std::cos(angle) * e1 + std::sin(angle) * e2;
    second = std::cos(angle) * e2 - std::sin(angle) * e1;
    first_per_mm = of_wall(mean + radius, height);
    second_per_mm = of_wall(mean - radius, height);
    if (std::abs(second_per_mm) > std::abs(first_per_mm)) {
      std::swap(first, second);
      std::swap(first_per_mm, second_per_mm);
    }
  }
};

/// Turns a convex wall into the two planes on both sides of its ridge, at the sample as high as the field says.
void make_ridge(const Profile& profile, double height, double reach, LocalWall& wall) {
  const Eigen::Vector3d offset = reach * wall.first;
  const double one_height = profile.ahead.distance_mm - profile.ahead.gradient.dot(offset);
  const double other_height = profile.behind.distance_mm + profile.behind.gradient.dot(offset);
  const double twice_blend = 2.0 * height - one_height - other_height;
  const double split = one_height - other_height;
  // Not convex over the whole reach: the plane stays.
  if (!(twice_blend >= std::abs(split)) || profile.ahead.gradient.dot(profile.behind.gradient) < 0.0) return;
  wall.ridge = true;
  wall.normal = profile.ahead.gradient;
  wall.height_mm = one_height;
  wall.other_normal = profile.behind.gradient;
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
  Eigen::Vector3d n = nearest.gradient / slope;
  Eigen::Vector3d e2 = tangent - n * n.dot(tangent);
  e2 = e2.norm() > 0.1 ? e2.normalized() : math::any_normal(n);
  const Eigen::Vector3d e1 = n.cross(e2);
  LocalWall& wall = sample.wall[0];
  wall = LocalWall{n, e1, e2, nearest.distance_mm, 0.0, 0.0};
  sample.walls = 1;

  const double reach = std::min(kProbe_mm, kProbe_radii * sample.lumen_radius_mm);
  const double height = nearest.distance_mm;
  const auto add = [&](const vessel::WallDistance& probe, const Eigen::Vector3d& offset) {
    if (sample.walls == static_cast<int>(kMaxWalls)) return;
    if (probe.distance_mm > predicted_height_mm(sample, offset) - kNewWall_mm) return;
    const double norm = probe.gradient.norm();
    if (!(norm > 0.5)) return;
    const Eigen::Vector3d normal = probe.gradient / norm;
    const Eigen::Vector3d first = math::any_normal(normal);
    // Over a ridge the plane would pass above the sample: no wall is nearer to it than the nearest one.
    sample.wall[static_cast<std::size_t>(sample.walls++)] = LocalWall{
        normal, first, normal.cross(first), std::max(probe.distance_mm - normal.dot(offset), height),
        0.0,    0.0};
  };
  const auto add_sides = [&](const Profile& profile, const Eigen::Vector3d& direction) {
    add(profile.ahead, reach * direction);
    add(profile.behind, -reach * direction);
    if (profile.round) return;
    for (const double side : {0.4 * reach, -0.4 * reach})
      add(field.at(q + side * direction), side * direction);
  };
  const Profile across(field, q, e1, reach, height);
  const Profile along(field, q, e2, reach, height);
  const Principal principal(across, along, e1, e2, height, reach);
  if (across.round && along.round) {
    wall = LocalWall{n,      principal.first,        principal.second,
                     height, principal.first_per_mm, principal.second_per_mm};
    add_sides(across, e1);
    add_sides(along, e2);
    return;
  }
  const bool oblique = std::abs(principal.twist_per_mm) * reach > kRoundSlope;
  const Eigen::Vector3d d1 = oblique ? principal.first : e1;
  const Eigen::Vector3d d2 = oblique ? principal.second : e2;
  const Profile one = oblique ? Profile(field, q, d1, reach, height) : across;
  const Profile other = oblique ? Profile(field, q, d2, reach, height) : along;
  wall.first = d1;
  wall.second = d2;
  if (one.round) {
    wall.first_curvature_per_mm = one.curvature_per_mm;
  } else if (one.curvature_per_mm < -kRidge_per_mm) {
    make_ridge(one, height, reach, wall);
  }
  if (other.round) wall.second_curvature_per_mm = other.curvature_per_mm;
  add_sides(one, d1);
  add_sides(other, d2);
}

}  // namespace endowire::contact

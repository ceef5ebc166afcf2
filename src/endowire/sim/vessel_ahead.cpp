#include "endowire/sim/vessel_ahead.hpp"

#include <algorithm>

#include "endowire/contact/detect.hpp"

namespace endowire::sim {

namespace {

constexpr double kSight_mm = 60.0;
/// A direction that is steeper to the wall tells nothing of where the vessel goes.
constexpr double kLeastAlong = 0.2;

}  // namespace

double vessel_curvature_ahead_per_mm(const vessel::Field& field, const Eigen::Vector3d& point_mm,
                                     const Eigen::Vector3d& direction) {
  const vessel::WallDistance wall = field.at(point_mm);
  const double radius = field.lumen_radius_mm(point_mm);
  const double slope = wall.gradient.norm();
  Eigen::Vector3d middle = point_mm;
  Eigen::Vector3d along = direction;
  if (slope > 0.5) {
    const Eigen::Vector3d inward = wall.gradient / slope;
    middle += std::max(0.0, radius - wall.distance_mm) * inward;
    along -= inward * inward.dot(direction);
  }
  if (along.norm() < kLeastAlong) return 1.0 / radius;
  const Eigen::Vector3d end = middle + kSight_mm * along.normalized();
  const double sight = (contact::reachable_point_mm(field, middle, end) - middle).norm();
  if (sight > kSight_mm * (1.0 - 1e-9)) return 0.0;
  const double squares = sight * sight - radius * radius;
  return squares > 0.0 ? std::min(1.0 / radius, 2.0 * radius / squares) : 1.0 / radius;
}

}  // namespace endowire::sim

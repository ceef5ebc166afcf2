#include "endowire/sim/clearance.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::sim {

namespace {

/// Spacing of the points at which a shape is checked against the field.
constexpr double kClearStep_mm = 0.5;
/// A tip that moves less than this cuts no corner; nor does one whose axis stays this share of its radius off the wall on its way.
constexpr double kShortWay_mm = 0.4;
constexpr double kCorner = 0.5;

}  // namespace

bool lies_clear(const contact::Wire& wire, const vessel::Field& field, double max_deflection_mm) {
  for (std::size_t i = 0; i + 2 < wire.shape.joints_mm.size(); ++i) {
    const double length = wire.material.length_mm[i];
    const int points = std::max(1, static_cast<int>(std::ceil(length / kClearStep_mm)));
    for (int k = 0; k < points; ++k) {
      const double w = static_cast<double>(k) / points;
      const Eigen::Vector3d x = (1.0 - w) * wire.shape.joints_mm[i] + w * wire.shape.joints_mm[i + 1];
      const double radius = wire.line.radius_mm(wire.material.arc_mm[i] + w * length);
      if (field.at(x).distance_mm < radius - max_deflection_mm) return false;
    }
  }
  return true;
}

bool cuts_corner(const vessel::Field& field, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm,
                 double radius_mm, double advance_mm) {
  const Eigen::Vector3d way = to_mm - from_mm;
  const double length = way.norm();
  if (length < kShortWay_mm || length > 2.0 * std::abs(advance_mm) + kShortWay_mm) return false;
  const double least = kCorner * radius_mm;
  for (double gone = 0.0; gone < length;) {
    const double height = field.at(from_mm + gone / length * way).distance_mm;
    if (height < least) return true;
    gone += std::max(height - least, kShortWay_mm / 8.0);
  }
  return false;
}

}  // namespace endowire::sim

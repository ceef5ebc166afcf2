#include "endowire/sim/clearance.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::sim {

namespace {

/// Least spacing of the points at which a shape is checked against the field: a crest between two points this far apart, both clear
/// of it, does not reach the axis.
constexpr double kClearStep_mm = 0.1;
/// Spacing along the wire of the points whose ways are followed, and how near to the wall these may lead, in radii: what is left of
/// the lumen there is more than the error of the field.
constexpr double kLegStep_mm = 0.5;
constexpr double kLegCorner = 0.25;
/// A tip that moves less than this cuts no corner; nor does one whose axis stays this share of its radius off the wall on its way.
constexpr double kShortWay_mm = 0.4;
constexpr double kCorner = 0.5;

}  // namespace

bool lies_clear(const contact::Wire& wire, const vessel::Field& field, double max_deflection_mm) {
  for (std::size_t i = 0; i + 2 < wire.shape.joints_mm.size(); ++i) {
    const double length = wire.material.length_mm[i];
    for (double gone = 0.0; gone < length;) {
      const double w = gone / length;
      const Eigen::Vector3d x = (1.0 - w) * wire.shape.joints_mm[i] + w * wire.shape.joints_mm[i + 1];
      const double least = wire.line.radius_mm(wire.material.arc_mm[i] + gone) - max_deflection_mm;
      const double height = field.at(x).distance_mm;
      if (height < least) return false;
      gone += std::max(height - least, kClearStep_mm);
    }
  }
  return true;
}

namespace {

/// Whether the straight way between two points comes nearer to the wall than `least_mm`.
bool dips(const vessel::Field& field, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm,
          double least_mm) {
  const Eigen::Vector3d way = to_mm - from_mm;
  const double length = way.norm();
  for (double gone = 0.0; gone < length;) {
    const double height = field.at(from_mm + gone / length * way).distance_mm;
    if (height < least_mm) return true;
    gone += std::max(height - least_mm, kShortWay_mm / 8.0);
  }
  return false;
}

/// Walks along an axis towards the hand.
class Walk {
 public:
  explicit Walk(const AxisShape& axis) : axis_(axis) {}
  [[nodiscard]] bool reaches(double arc_mm) const { return arc_mm <= axis_.arc_mm[axis_.joints - 1]; }
  /// @param arc_mm  not less than before, and reached
  Eigen::Vector3d to(double arc_mm) {
    while (axis_.arc_mm[rod_ + 1] < arc_mm) ++rod_;
    const double w = (arc_mm - axis_.arc_mm[rod_]) / (axis_.arc_mm[rod_ + 1] - axis_.arc_mm[rod_]);
    return (1.0 - w) * axis_.joints_mm[rod_] + w * axis_.joints_mm[rod_ + 1];
  }

 private:
  const AxisShape& axis_;
  std::size_t rod_ = 0;
};

}  // namespace

bool leg_cuts_corner(const vessel::Field& field, const rod::MaterialLine& line, const AxisShape& from,
                     const AxisShape& to) {
  if (from.joints < 2 || to.joints < 2) return false;
  Walk before(from);
  Walk after(to);
  for (double arc = 0.0; before.reaches(arc) && after.reaches(arc); arc += kLegStep_mm) {
    const Eigen::Vector3d a = before.to(arc);
    const Eigen::Vector3d b = after.to(arc);
    if ((b - a).norm() < kShortWay_mm) continue;
    const double ends = std::min(field.at(a).distance_mm, field.at(b).distance_mm);
    if (dips(field, a, b, std::min(kLegCorner * line.radius_mm(arc), ends))) return true;
  }
  return false;
}

bool cuts_corner(const vessel::Field& field, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm,
                 double radius_mm, double advance_mm) {
  const double length = (to_mm - from_mm).norm();
  if (length < kShortWay_mm || length > 2.0 * std::abs(advance_mm) + kShortWay_mm) return false;
  return dips(field, from_mm, to_mm, kCorner * radius_mm);
}

}  // namespace endowire::sim

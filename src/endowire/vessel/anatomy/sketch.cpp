#include "endowire/vessel/anatomy/sketch.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

/// Of the angle between axes at an ostium. Vessels that part more slowly would place their carina far behind it.
constexpr double least_sine = 0.25;

std::size_t add(Plan& plan, std::string name, Axis axis, int parent, double parent_arc_mm) {
  Branch branch;
  branch.name = std::move(name);
  branch.axis = std::move(axis);
  branch.parent = parent;
  branch.parent_arc_mm = parent_arc_mm;
  plan.branches.push_back(std::move(branch));
  return plan.branches.size() - 1;
}

/// Brings axis and ostium of a branch to its calibre.
void measure(Plan& plan, std::size_t branch) {
  Branch& b = plan.branches[branch];
  b.axis.set_radius(b.calibre);
  if (b.parent < 0) return;
  const Axis& parent = plan.branches[static_cast<std::size_t>(b.parent)].axis;
  b.ostium_arc_mm = ostium_arc_mm(parent, b.axis);
}

/// How a vessel's wall runs lengthwise next to a point: like its axis, but for the slope of a changing calibre.
Vector3d along_wall(const Axis& axis, const Vector3d& point_mm) {
  const AxisPoint at = axis.at(axis.nearest_arc_mm(point_mm));
  return unit(at.tangent + at.radius_slope * unit(point_mm - at.position_mm));
}

double sine_between(const Vector3d& a, const Vector3d& b) {
  return length(cross(a, b));
}

}  // namespace

double ostium_arc_mm(const Axis& parent, const Axis& axis) {
  const auto outside = [&](double arc) {
    const Vector3d p = axis.at(arc).position_mm;
    const AxisPoint foot = parent.at(parent.nearest_arc_mm(p));
    return length(p - foot.position_mm) - foot.radius_mm;
  };
  double low = 0.0;
  double high = 0.0;
  while (high < axis.length_mm() && outside(high) <= 0.0) {
    low = high;
    high += 1.0;
  }
  high = std::min(high, axis.length_mm());
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (outside(middle) <= 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::size_t add_trunk(Plan& plan, std::string name, const CurveEnd& begin,
                      const std::vector<Vector3d>& through_mm, const CurveEnd& end) {
  return add(plan, std::move(name), Axis::spline(begin, through_mm, end), -1, 0.0);
}

Vector3d wall_point_mm(const Plan& plan, std::size_t parent, double parent_arc_mm,
                       const Vector3d& direction) {
  const AxisPoint at = plan.branches[parent].axis.at(parent_arc_mm);
  const double across = sine_between(direction, at.tangent);
  ENDOWIRE_EXPECTS(across > 0.1, "a side branch leaves its parent");
  return at.position_mm + at.radius_mm / across * direction;
}

Axis axis_of(const Plan& plan, const SideBranch& side) {
  const AxisPoint at = plan.branches[side.parent].axis.at(side.parent_arc_mm);
  const Vector3d wall = wall_point_mm(plan, side.parent, side.parent_arc_mm, side.direction);
  std::vector<Vector3d> through{wall + side.straight_mm * side.direction};
  through.insert(through.end(), side.through_mm.begin(), side.through_mm.end() - 1);
  return Axis::spline({at.position_mm, side.direction, Vector3d::Zero()}, through,
                      {side.through_mm.back(), unit(side.end_direction), Vector3d::Zero()});
}

std::size_t add_side_branch(Plan& plan, const SideBranch& side) {
  return add(plan, side.name, axis_of(plan, side), static_cast<int>(side.parent), side.parent_arc_mm);
}

std::size_t add_second_branch(Plan& plan, const SecondBranch& second) {
  const AxisPoint at = plan.branches[second.parent].axis.at(second.parent_arc_mm);
  const std::vector<Vector3d> through(second.through_mm.begin(), second.through_mm.end() - 1);
  const std::size_t branch =
      add(plan, second.name,
          Axis::spline({at.position_mm, at.tangent, at.curvature_per_mm}, through,
                       {second.through_mm.back(), unit(second.end_direction), Vector3d::Zero()}),
          static_cast<int>(second.parent), second.parent_arc_mm);
  plan.branches[branch].shares_beginning = true;
  return branch;
}

void set_calibre(Plan& plan, std::size_t branch, const std::vector<RadiusProfile::Mark>& marks) {
  plan.branches[branch].calibre = RadiusProfile(marks);
  measure(plan, branch);
}

void add_lesion(Plan& plan, std::size_t branch, const Lesion& lesion) {
  plan.branches[branch].calibre.add(lesion);
  measure(plan, branch);
  for (std::size_t i = 0; i < plan.branches.size(); ++i) {
    const Branch& b = plan.branches[i];
    if (b.parent != static_cast<int>(branch)) continue;
    if (b.shares_beginning) {
      Lesion shared = lesion;
      shared.centre_arc_mm -= b.parent_arc_mm;
      if (shared.centre_arc_mm + 0.5 * shared.length_mm > 0.0) plan.branches[i].calibre.add(shared);
    }
    measure(plan, i);
  }
}

void round_ostium(Plan& plan, std::size_t branch, double carina_radius_mm) {
  Branch& b = plan.branches[branch];
  const Axis& parent = plan.branches[static_cast<std::size_t>(b.parent)].axis;
  const AxisPoint out = b.axis.at(b.ostium_arc_mm);
  const AxisPoint inside = parent.at(parent.nearest_arc_mm(out.position_mm));
  // The carina lies on the acute side, a vessel's breadth away: there the axes have turned.
  const double acute = dot(out.tangent, inside.tangent) < 0.0 ? -1.0 : 1.0;
  const double across = std::max(sine_between(out.tangent, inside.tangent), least_sine);
  const Vector3d carina = out.position_mm + acute * out.radius_mm / across * inside.tangent;
  b.fillet = Fillet(carina_radius_mm, acute * dot(along_wall(parent, carina), along_wall(b.axis, carina)));
}

Vector3d leaving(const AxisPoint& at, double angle_rad, const Vector3d& towards) {
  const Vector3d side = unit(towards - dot(towards, at.tangent) * at.tangent);
  return cosine(angle_rad) * at.tangent + sine(angle_rad) * side;
}

void add_end(Plan& plan, const std::string& name, std::size_t branch, bool at_begin) {
  plan.ends.push_back({name, branch, at_begin});
  add_landmark(plan, name, branch, at_begin ? 0.0 : plan.branches[branch].axis.length_mm());
}

void add_landmark(Plan& plan, const std::string& name, std::size_t branch, double arc_mm) {
  plan.landmarks.push_back({name, branch, arc_mm});
}

}  // namespace endowire::vessel::anatomy

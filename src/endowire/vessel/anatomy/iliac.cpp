#include "endowire/vessel/anatomy/iliac.hpp"

#include <algorithm>

#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Marks = std::vector<RadiusProfile::Mark>;

// The common iliac arteries follow the brim of the pelvis, down and back; the external ones come forward to the
// groin. Estimates from sagittal views of CT angiographies.
constexpr double backward_deg = 14.0;
const Vector3d groin(0.34, -0.50, -0.80);
// The internal iliac artery leaves to the back and inwards; the angle to the course of the others is an estimate.
const Vector3d sacrum(-0.35, 0.90, -0.10);
constexpr double internal_take_off_deg = 45.0;

Vector3d common_direction(const Values& values, Side side) {
  const double half = 0.5 * radians(values["aortic_bifurcation_deg"]);
  const double back = radians(backward_deg);
  return on_side({sine(half), cosine(half) * sine(back), -cosine(half) * cosine(back)}, side);
}

const char* name_of(Side side) {
  return side == Side::right ? "right" : "left";
}

void add_internal(Plan& plan, const Values& values, std::size_t parent, Side side) {
  const std::string name = std::string(name_of(side)) + " internal iliac";
  const Axis& axis = plan.branches[parent].axis;
  SideBranch internal;
  internal.name = name + " artery";
  internal.parent = parent;
  internal.parent_arc_mm = axis.nearest_arc_mm(iliac_division(values, side));
  const AxisPoint at = axis.at(internal.parent_arc_mm);
  internal.direction = leaving(at, radians(internal_take_off_deg), on_side(sacrum, side));
  const Vector3d wall = wall_point_mm(plan, parent, internal.parent_arc_mm, internal.direction);
  internal.end_direction = internal.direction + Vector3d(0.0, 0.0, -0.5);
  const Vector3d down = unit(internal.direction + Vector3d(0.0, 0.0, -0.15));
  const double length_mm = values["internal_iliac_length_mm"];
  const double factor = factor_for(length_mm, [&](double f) {
    internal.through_mm = {wall + f * length_mm * down};
    const Axis course = axis_of(plan, internal);
    return course.length_mm() - ostium_arc_mm(plan.branches[parent].axis, course);
  });
  internal.through_mm = {wall + factor * length_mm * down};
  const std::size_t branch = add_side_branch(plan, internal);
  set_calibre(plan, branch, {{0.0, 0.5 * values["internal_iliac_diameter_mm"]}});
  round_ostium(plan, branch, values["iliac_carina_radius_mm"]);
  const double ostium = plan.branches[branch].ostium_arc_mm;
  add_landmark(plan, name + " ostium", branch, ostium);
  add_landmark(plan, name, branch, 0.5 * (ostium + plan.branches[branch].axis.length_mm()));
  add_end(plan, name + " end", branch);
}

}  // namespace

Vector3d on_side(Vector3d left, Side side) {
  if (side == Side::right) left.x() = -left.x();
  return left;
}

std::vector<Vector3d> iliac_course(const Values& values, Side side) {
  const Vector3d along = common_direction(values, side);
  const Vector3d down = iliac_end_direction(side);
  const double common = values["common_iliac_length_mm"];
  const double external = values["external_iliac_length_mm"];
  const Vector3d division = iliac_division(values, side);
  const double straight = 0.85 * common;
  return {division_mm * along,
          0.5 * (division_mm + straight) * along,
          straight * along,
          division + 0.22 * external * down,
          division + 0.60 * external * down + on_side({0.02 * external, 0.03 * external, 0.0}, side),
          division + 0.98 * external * down};
}

Vector3d iliac_end_direction(Side side) {
  return unit(on_side(groin, side));
}

Vector3d iliac_division(const Values& values, Side side) {
  return values["common_iliac_length_mm"] * common_direction(values, side);
}

Marks with_iliac_calibre(const Values& values, const Axis& axis, Side side, Marks above) {
  const double common = 0.5 * values["common_iliac_diameter_mm"];
  const double external = 0.5 * values["external_iliac_diameter_mm"];
  const double bifurcation = axis.nearest_arc_mm(Vector3d::Zero());
  const double division = axis.nearest_arc_mm(iliac_division(values, side));
  above.push_back({bifurcation + 12.0, common});
  above.push_back({division - 4.0, common});
  above.push_back({division + 14.0, external});
  above.push_back({division + 0.8 * values["external_iliac_length_mm"], external});
  return above;
}

std::size_t add_pelvis(Plan& plan, const Values& values, const Marks& above,
                       const std::vector<Vector3d>& left_course, const Vector3d& left_end_direction) {
  const double divided = plan.branches[0].axis.nearest_arc_mm(division_mm * Vector3d::UnitZ());
  const std::size_t left =
      add_second_branch(plan, {"left iliac artery", 0, divided, left_course, left_end_direction});
  Marks same = above;  // the aorta's, counted from where the left side begins
  for (RadiusProfile::Mark& mark : same) mark.arc_mm -= divided;
  set_calibre(plan, left, with_iliac_calibre(values, plan.branches[left].axis, Side::left, same));
  round_ostium(plan, left, values["aortic_carina_radius_mm"]);
  add_internal(plan, values, 0, Side::right);
  add_internal(plan, values, left, Side::left);

  const Axis& axis = plan.branches[0].axis;
  const double bifurcation = axis.nearest_arc_mm(Vector3d::Zero());
  const double division = axis.nearest_arc_mm(iliac_division(values, Side::right));
  add_landmark(plan, "aortic bifurcation", 0, bifurcation);
  add_landmark(plan, "right common iliac", 0, 0.5 * (bifurcation + 12.0 + division));
  add_landmark(plan, "right external iliac", 0, division + 0.5 * values["external_iliac_length_mm"]);
  return left;
}

void end_in_groins(Plan& plan, const Values& values, std::size_t left) {
  add_end(plan, "right external iliac end", 0);
  add_end(plan, "left external iliac end", left);
  plan.access = {"access", 0, plan.branches[0].axis.length_mm() - values["sheath_depth_mm"]};
  plan.access_backward = true;
}

}  // namespace endowire::vessel::anatomy

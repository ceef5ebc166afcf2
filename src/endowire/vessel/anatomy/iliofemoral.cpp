#include "endowire/vessel/anatomy/iliofemoral.hpp"

#include <array>

#include "endowire/vessel/anatomy/iliac.hpp"
#include "endowire/vessel/anatomy/iliac_parameters.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Marks = std::vector<RadiusProfile::Mark>;

// The thigh: the common femoral artery comes down from the groin, the superficial one goes on inwards, the deep one
// outwards and to the back. Estimates.
const Vector3d thigh(0.10, -0.14, -0.985);
const Vector3d thigh_below(-0.10, 0.08, -0.99);
const Vector3d deep(0.45, 0.85, 0.0);
constexpr double deep_take_off_deg = 35.0;

/// From the division of the aorta to the end of the superficial femoral artery.
std::vector<Vector3d> leg_course(const Values& v, Side side) {
  std::vector<Vector3d> course = iliac_course(v, side);
  const Vector3d groin = course.back();
  const double common = v["common_femoral_length_mm"];
  const double superficial = v["superficial_femoral_length_mm"];
  const Vector3d down = on_side(thigh, side);
  const Vector3d below = on_side(thigh_below, side);
  const Vector3d division = groin + common * down;
  course.emplace_back(groin + 0.6 * common * down);
  course.emplace_back(division + 0.12 * superficial * unit(down + below));
  course.emplace_back(division + 0.50 * superficial * below);
  course.emplace_back(division + superficial * below);
  return course;
}

double femoral_division_arc(const Values& v, const Axis& axis, Side side) {
  return axis.nearest_arc_mm(iliac_course(v, side).back() +
                             v["common_femoral_length_mm"] * on_side(thigh, side));
}

Marks with_leg_calibre(const Values& v, const Axis& axis, Side side, const Marks& above) {
  Marks marks = with_iliac_calibre(v, axis, side, above);
  const double groin = axis.nearest_arc_mm(iliac_course(v, side).back());
  const double division = femoral_division_arc(v, axis, side);
  const double common = 0.5 * v["common_femoral_diameter_mm"];
  const double superficial = 0.5 * v["superficial_femoral_diameter_mm"];
  marks.push_back({groin + 0.3 * (division - groin), common});
  marks.push_back({division - 4.0, common});
  marks.push_back({division + 12.0, superficial});
  marks.push_back({axis.length_mm(), superficial});
  return marks;
}

void add_deep_femoral(Plan& plan, const Values& v, std::size_t parent, Side side) {
  const std::string name = side == Side::right ? "right deep femoral" : "left deep femoral";
  const Axis& axis = plan.branches[parent].axis;
  SideBranch branch;
  branch.name = name + " artery";
  branch.parent = parent;
  branch.parent_arc_mm = femoral_division_arc(v, axis, side);
  branch.direction = leaving(axis.at(branch.parent_arc_mm), radians(deep_take_off_deg), on_side(deep, side));
  const Vector3d wall = wall_point_mm(plan, parent, branch.parent_arc_mm, branch.direction);
  const Vector3d down = on_side({0.25, 0.30, -0.92}, side);
  branch.through_mm = {wall + 0.45 * v["deep_femoral_length_mm"] * unit(branch.direction + down),
                       wall + 0.97 * v["deep_femoral_length_mm"] * unit(0.5 * branch.direction + down)};
  branch.end_direction = down;
  const std::size_t index = add_side_branch(plan, branch);
  set_calibre(plan, index, {{0.0, 0.5 * v["deep_femoral_diameter_mm"]}});
  round_ostium(plan, index, v["femoral_carina_radius_mm"]);
  const double ostium = plan.branches[index].ostium_arc_mm;
  add_landmark(plan, name + " ostium", index, ostium);
  add_landmark(plan, name, index, 0.5 * (ostium + plan.branches[index].axis.length_mm()));
  add_end(plan, name + " end", index);
}

}  // namespace

Plan iliofemoral(const Values& v) {
  Plan plan;
  const double height = v["infrarenal_length_mm"];
  const Vector3d top(2.5, 4.0, height);
  std::vector<Vector3d> through{{0.5, 0.5, 0.5 * (height + division_mm)}, division_mm * Vector3d::UnitZ()};
  const std::vector<Vector3d> right = leg_course(v, Side::right);
  through.insert(through.end(), right.begin(), right.end() - 1);
  add_trunk(plan, "aorta to right femoral artery",
            {top, unit(Vector3d(-0.04, -0.08, -1.0)), Vector3d::Zero()}, through,
            {right.back(), unit(on_side(thigh_below, Side::right)), Vector3d::Zero()});
  const Axis& axis = plan.branches[0].axis;
  const double aorta = 0.5 * v["infrarenal_diameter_mm"];
  const double divided = axis.nearest_arc_mm(division_mm * Vector3d::UnitZ());
  const Marks marks{{0.0, aorta}, {0.5 * divided, aorta}, {divided - 4.0, 0.97 * aorta}};
  set_calibre(plan, 0, with_leg_calibre(v, axis, Side::right, marks));
  add_end(plan, "aortic end", 0, true);
  add_landmark(plan, "infrarenal aorta", 0, 0.4 * divided);

  const std::size_t left =
      add_pelvis(plan, v, marks, leg_course(v, Side::left), unit(on_side(thigh_below, Side::left)));
  Marks same = marks;
  for (RadiusProfile::Mark& mark : same) mark.arc_mm -= divided;
  set_calibre(plan, left, with_leg_calibre(v, plan.branches[left].axis, Side::left, same));
  for (const Side side : {Side::right, Side::left}) {
    const std::size_t leg = side == Side::right ? 0 : left;
    const std::string name = side == Side::right ? "right" : "left";
    const double division = femoral_division_arc(v, plan.branches[leg].axis, side);
    add_landmark(plan, name + " groin", leg,
                 plan.branches[leg].axis.nearest_arc_mm(iliac_course(v, side).back()));
    add_landmark(plan, name + " common femoral", leg, division - 0.4 * v["common_femoral_length_mm"]);
    add_landmark(plan, name + " femoral division", leg, division);
    add_landmark(plan, name + " superficial femoral", leg,
                 division + 0.6 * v["superficial_femoral_length_mm"]);
    add_end(plan, name + " superficial femoral end", leg);
    add_deep_femoral(plan, v, leg, side);
  }
  plan.access = {
      "access", 0,
      femoral_division_arc(v, plan.branches[0].axis, Side::right) - 0.4 * v["common_femoral_length_mm"]};
  plan.access_backward = true;
  return plan;
}

std::string iliofemoral_conflict(const Values& v) {
  static constexpr std::array order{
      Narrower{"common_femoral_diameter_mm", "external_iliac_diameter_mm", 1.15},
      Narrower{"superficial_femoral_diameter_mm", "common_femoral_diameter_mm", 0.95},
      Narrower{"deep_femoral_diameter_mm", "common_femoral_diameter_mm", 0.9},
  };
  if (std::string wider = first_wider(v, iliac_order); !wider.empty()) return wider;
  return first_wider(v, order);
}

std::span<const Parameter> iliofemoral_parameters() {
  using enum Trait;
  static constexpr std::array own_table{
      infrarenal_diameter,
      Parameter{"infrarenal_length_mm", "mm", 80, 60, 110, false, stature,
                "aorta above its bifurcation, as far as it is modelled",
                "estimate: below the renal arteries"},
      Parameter{"common_femoral_diameter_mm", "mm", 7.8, 6.2, 10.0, false, calibre, "common femoral arteries",
                "Mirza2022: 7.3; Lorbeer2018: 10.2 is the 95th percentile of men"},
      Parameter{"common_femoral_length_mm", "mm", 42, 30, 60, false, stature,
                "from the groin to its division",
                "estimate: it divides about 4 cm below the inguinal ligament"},
      Parameter{"superficial_femoral_diameter_mm", "mm", 6.1, 4.8, 7.7, false, calibre,
                "superficial femoral arteries",
                "Mirza2022: 6.1; Lorbeer2018: 7.7 is the 95th percentile of men"},
      Parameter{"superficial_femoral_length_mm", "mm", 110, 60, 200, false, stature,
                "superficial femoral arteries, as far as they are modelled",
                "estimate: its upper third, longer if wanted"},
      Parameter{"deep_femoral_diameter_mm", "mm", 5.4, 4.0, 7.0, false, calibre, "deep femoral arteries",
                "estimate: a little narrower than the superficial ones"},
      Parameter{"deep_femoral_length_mm", "mm", 55, 35, 80, false, stature,
                "deep femoral arteries, as far as they are modelled",
                "estimate: as far as its first branches"},
      Parameter{"femoral_carina_radius_mm", "mm", 1.2, 0.8, 2.0, false, own,
                "of the division of the femoral arteries",
                "estimate, unreported: a third to a half of the branch's radius"},
  };
  static constexpr auto table = joined(own_table, iliac_parameters);
  return table;
}

}  // namespace endowire::vessel::anatomy

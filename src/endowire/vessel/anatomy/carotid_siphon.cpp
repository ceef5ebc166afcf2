#include "endowire/vessel/anatomy/carotid_siphon.hpp"

#include <array>

#include "endowire/vessel/anatomy/course.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

// The artery enters the skull base 24 mm from the middle, runs inwards and to the front through the petrous bone
// and comes up beside the sella. Directions and radii of the bends that are no parameters are estimates.
const Vector3d neck_begin(24.0, 6.0, 0.0);
const Vector3d up = Vector3d::UnitZ();
const Vector3d front(0.0, -1.0, 0.0);
const Vector3d petrous(-0.74, -0.67, 0.08);
const Vector3d outward(0.92, -0.30, 0.25);
constexpr double petrous_bend_mm = 8.0;
constexpr double ascending_bend_mm = 8.0;
constexpr double terminal_bend_mm = 7.0;
constexpr double ascending_mm = 6.0;
constexpr double supraclinoid_mm = 9.0;

/// Where the way so far ends, as arc lengths that are found again on the axis.
struct Waypoints {
  Vector3d skull_base, petrous_begin, petrous_end, posterior_begin, cavernous_begin, cavernous_end,
      supraclinoid, terminus;
};

Course course_of(const Values& v, Waypoints& at) {
  Course course(neck_begin, unit(Vector3d(0.02, -0.03, 1.0)));
  course.straight(v["cervical_length_mm"]);
  at.skull_base = course.position_mm();
  course.straight(9.0).bend(petrous, petrous_bend_mm, radians(84.0));
  at.petrous_begin = course.position_mm();
  course.straight(v["petrous_length_mm"]);
  at.petrous_end = course.position_mm();
  course.bend(up, ascending_bend_mm, radians(80.0)).straight(ascending_mm);
  at.posterior_begin = course.position_mm();
  course.bend(front, v["posterior_bend_radius_mm"], radians(92.0));
  at.cavernous_begin = course.position_mm();
  course.straight(v["cavernous_length_mm"]);
  at.cavernous_end = course.position_mm();
  course.bend(up + 0.12 * Vector3d::UnitX(), v["anterior_bend_radius_mm"],
              radians(180.0 - v["anterior_bend_opening_deg"]));
  at.supraclinoid = course.position_mm();
  course.straight(supraclinoid_mm).bend(up + 0.4 * outward, terminal_bend_mm, radians(50.0)).straight(3.0);
  at.terminus = course.position_mm();
  const double turn = radians(62.0);
  course.bend(outward, terminal_bend_mm, turn);
  course.straight(v["middle_cerebral_length_mm"] - terminal_bend_mm * turn);
  return course;
}

void add_branch(Plan& plan, const char* name, double arc_mm, double angle_deg, const Vector3d& towards,
                const Vector3d& bent, double length_mm, double diameter_mm, double carina_mm) {
  SideBranch branch;
  branch.name = std::string(name) + " artery";
  branch.parent_arc_mm = arc_mm;
  branch.direction = leaving(plan.branches[0].axis.at(arc_mm), radians(angle_deg), towards);
  branch.straight_mm = 1.5;
  const Vector3d wall = wall_point_mm(plan, 0, arc_mm, branch.direction);
  branch.end_direction = branch.direction + 2.5 * bent;
  const auto through = [&](double l) {
    return std::vector<Vector3d>{wall + 0.5 * l * unit(branch.direction + 0.4 * bent),
                                 wall + l * unit(branch.direction + bent)};
  };
  branch.through_mm = through(length_mm * factor_for(length_mm, [&](double f) {
                                branch.through_mm = through(f * length_mm);
                                const Axis axis = axis_of(plan, branch);
                                return axis.length_mm() - ostium_arc_mm(plan.branches[0].axis, axis);
                              }));
  const std::size_t index = add_side_branch(plan, branch);
  set_calibre(plan, index, {{0.0, 0.5 * diameter_mm}});
  round_ostium(plan, index, carina_mm);
  add_landmark(plan, std::string(name) + " ostium", index, plan.branches[index].ostium_arc_mm);
  add_end(plan, std::string(name) + " end", index);
}

}  // namespace

Plan carotid_siphon(const Values& v) {
  Waypoints at;
  const Course course = course_of(v, at);
  const std::vector<Vector3d>& points = course.points_mm();
  Plan plan;
  add_trunk(plan, "internal carotid to middle cerebral artery",
            {neck_begin, unit(Vector3d(0.02, -0.03, 1.0)), Vector3d::Zero()},
            {points.begin(), points.end() - 1}, {points.back(), course.direction(), Vector3d::Zero()});
  const Axis& axis = plan.branches[0].axis;
  const auto arc = [&](const Vector3d& p) { return axis.nearest_arc_mm(p); };
  const double cervical = 0.5 * v["cervical_diameter_mm"];
  const double cavernous = 0.5 * v["cavernous_diameter_mm"];
  const double terminal = 0.5 * v["terminal_diameter_mm"];
  const double middle = 0.5 * v["middle_cerebral_diameter_mm"];
  set_calibre(plan, 0,
              {{0.0, cervical},
               {arc(at.skull_base), cervical},
               {arc(at.cavernous_begin), cavernous},
               {arc(at.cavernous_end), cavernous},
               {arc(at.supraclinoid) + 2.0, 0.5 * (cavernous + terminal)},
               {arc(at.terminus) - 3.0, terminal},
               {arc(at.terminus) + 6.0, middle},
               {axis.length_mm(), middle}});
  add_end(plan, "cervical end", 0, true);
  add_landmark(plan, "cervical carotid", 0, 0.5 * arc(at.skull_base));
  add_landmark(plan, "skull base", 0, arc(at.skull_base));
  add_landmark(plan, "petrous begin", 0, arc(at.petrous_begin));
  add_landmark(plan, "petrous exit", 0, arc(at.petrous_end));
  add_landmark(plan, "posterior bend begin", 0, arc(at.posterior_begin));
  add_landmark(plan, "cavernous begin", 0, arc(at.cavernous_begin));
  add_landmark(plan, "cavernous exit", 0, arc(at.cavernous_end));
  add_landmark(plan, "cavernous carotid", 0, 0.5 * (arc(at.cavernous_begin) + arc(at.cavernous_end)));
  add_landmark(plan, "anterior bend", 0, 0.5 * (arc(at.cavernous_end) + arc(at.supraclinoid)));
  add_landmark(plan, "supraclinoid begin", 0, arc(at.supraclinoid));
  add_landmark(plan, "terminal carotid", 0, arc(at.terminus) - 3.0);
  add_landmark(plan, "middle cerebral", 0, axis.length_mm() - 6.0);
  add_end(plan, "middle cerebral end", 0);
  add_branch(plan, "ophthalmic", arc(at.supraclinoid) + 1.0, 70.0, front + 0.6 * up, front, 14.0,
             v["ophthalmic_diameter_mm"], v["ophthalmic_carina_radius_mm"]);
  add_branch(plan, "anterior cerebral", arc(at.terminus), 80.0, Vector3d(-1.0, -0.35, 0.1),
             unit(Vector3d(-0.2, -0.9, 0.4)), v["anterior_cerebral_length_mm"],
             v["anterior_cerebral_diameter_mm"], v["terminal_carina_radius_mm"]);
  plan.access = {"access", 0, v["sheath_depth_mm"]};
  plan.route_end_arc_mm = axis.length_mm();
  return plan;
}

std::string carotid_siphon_conflict(const Values& v) {
  static constexpr std::array order{
      Narrower{"cavernous_diameter_mm", "cervical_diameter_mm", 1.0},
      Narrower{"terminal_diameter_mm", "cavernous_diameter_mm", 0.9},
      Narrower{"middle_cerebral_diameter_mm", "terminal_diameter_mm", 0.95},
      Narrower{"anterior_cerebral_diameter_mm", "middle_cerebral_diameter_mm", 0.95},
      Narrower{"ophthalmic_diameter_mm", "cavernous_diameter_mm", 0.45},
  };
  return first_wider(v, order);
}

std::span<const Parameter> carotid_siphon_parameters() {
  using enum Trait;
  static constexpr std::array table{
      Parameter{"cervical_length_mm", "mm", 60, 30, 85, false, stature,
                "internal carotid in the neck, as far as it is modelled", "Choudhry2016: 84 +- 14 in all"},
      Parameter{"petrous_length_mm", "mm", 14, 8, 22, false, stature,
                "straight part in the petrous bone, between its bends",
                "estimate: the petrous canal less its two bends"},
      Parameter{"cavernous_length_mm", "mm", 12, 6, 18, false, own,
                "straight part between the two bends of the siphon",
                "estimate: the siphon is 15 to 25 mm deep, less its bends"},
      Parameter{"posterior_bend_radius_mm", "mm", 5.5, 4.2, 8.0, false, own,
                "of the axis in the posterior bend, on average",
                "estimate; Zhang2013 describes siphons by these radii and angles"},
      Parameter{"anterior_bend_radius_mm", "mm", 5.0, 4.2, 7.0, false, own,
                "of the axis in the anterior bend, on average",
                "estimate; Zhang2013 describes siphons by these radii and angles"},
      Parameter{"anterior_bend_opening_deg", "deg", 10, -25, 60, false, own,
                "between the limbs of the anterior bend: 0 parallel, a U; above 20 open, a C",
                "SiphonTypes2022: C from 20, U from -20 to 20, S below"},
      Parameter{"cervical_diameter_mm", "mm", 4.67, 3.7, 5.6, false, calibre,
                "internal carotid below the skull", "Baz2021: 4.67 +- 0.47"},
      Parameter{"cavernous_diameter_mm", "mm", 4.4, 3.5, 5.4, false, calibre, "cavernous carotid",
                "Baz2021: 4.53 +- 0.47 where it enters the skull, narrowing"},
      Parameter{"terminal_diameter_mm", "mm", 3.1, 2.4, 3.9, false, calibre,
                "internal carotid before its division", "Baz2021: narrows by 40 %; default: estimate"},
      Parameter{"middle_cerebral_diameter_mm", "mm", 2.7, 2.0, 3.4, false, calibre, "middle cerebral artery",
                "Baz2021: 2.71 +- 0.37 at its origin"},
      Parameter{"middle_cerebral_length_mm", "mm", 22, 16, 28, false, stature,
                "middle cerebral artery, undivided", "estimate: to where it divides at the insula"},
      Parameter{"anterior_cerebral_diameter_mm", "mm", 2.2, 1.6, 2.8, false, calibre,
                "anterior cerebral artery", "estimate: narrower than the middle one"},
      Parameter{"anterior_cerebral_length_mm", "mm", 15, 11, 20, false, stature,
                "anterior cerebral artery, first part", "estimate: to the anterior communicating artery"},
      Parameter{"ophthalmic_diameter_mm", "mm", 1.4, 1.1, 1.8, false, calibre, "ophthalmic artery",
                "estimate: a third of the carotid artery"},
      Parameter{"terminal_carina_radius_mm", "mm", 0.6, 0.4, 1.0, false, own,
                "of the division of the internal carotid",
                "estimate, unreported: a third to a half of the branch's radius"},
      Parameter{"ophthalmic_carina_radius_mm", "mm", 0.4, 0.3, 0.6, false, own,
                "where the ophthalmic artery leaves", "estimate, unreported: half the branch's radius"},
      Parameter{"sheath_depth_mm", "mm", 12, 5, 20, false, own, "of the access, from the cervical end",
                "estimate: a guiding catheter high in the neck"},
  };
  return table;
}

}  // namespace endowire::vessel::anatomy

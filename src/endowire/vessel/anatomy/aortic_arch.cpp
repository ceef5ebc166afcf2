#include "endowire/vessel/anatomy/aortic_arch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "endowire/vessel/anatomy/arch_frame.hpp"
#include "endowire/vessel/anatomy/iliac.hpp"
#include "endowire/vessel/anatomy/iliac_parameters.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Marks = std::vector<RadiusProfile::Mark>;

const Vector3d up = Vector3d::UnitZ();

// The sinuses: from the annulus, 0.80 of the ascending aorta's calibre, to the sinotubular junction, 0.92, with
// 1.06 between; proportions of [Davis2014], who has 24, 32 and 25 mm for men.
constexpr double root_mm = 22.0;
// How the ascending aorta slants to the left and back on its way down to the heart: an estimate.
const Vector3d to_heart(0.28, 0.10, -0.94);
const Vector3d out_of_heart(-0.42, -0.18, 0.89);

// A left carotid that leaves the trunk does so this far behind the trunk's ostium [Layton2006: within 10 to 25 mm].
constexpr double bovine_mm = 11.0;
constexpr double bovine_take_off_deg = 45.0;
// In the neck the carotids run this far from the middle: an estimate.
constexpr double neck_mm = 28.0;

/// Height of the straight part of the ascending aorta, from the annulus to the beginning of the half circle.
double straight_mm(const Values& v, const ArchFrame& arch) {
  return v["ascending_length_mm"] + root_mm - arch.radius_mm * (0.5 * std::numbers::pi + arch.trunk_phi);
}

Vector3d diaphragm_mm(const Values& v) {
  return {10.0, 15.0, 0.985 * v["abdominal_length_mm"]};
}

void add_aorta(Plan& plan, const Values& v, const ArchFrame& arch, Marks& marks) {
  const Vector3d begin = arch.at_mm(-0.5 * std::numbers::pi);
  const Vector3d end = arch.at_mm(0.5 * std::numbers::pi);
  const Vector3d diaphragm = diaphragm_mm(v);
  const double straight = straight_mm(v, arch);
  const double drop = end.z() - diaphragm.z();
  std::vector<Vector3d> through{begin + 0.45 * straight * unit(Vector3d(0.13, 0.04, -1.0))};
  constexpr int steps = 6;
  for (int i = 0; i <= steps; ++i) through.push_back(arch.at_mm(radians(-75.0 + 165.0 * i / steps)));
  // Along the thoracic spine, bowed to the back, to the middle before the lumbar one.
  through.emplace_back(end + Vector3d(0.0, 5.0, -0.28 * drop));
  through.emplace_back(end + Vector3d(-5.0, 4.0, -0.62 * drop));
  through.emplace_back(diaphragm);
  through.emplace_back(4.0, 8.5, 0.62 * diaphragm.z());
  through.emplace_back(0.5, 1.5, 0.31 * diaphragm.z());
  through.emplace_back(division_mm * up);
  std::vector<Vector3d> iliac = iliac_course(v, Side::right);
  through.insert(through.end(), iliac.begin(), iliac.end() - 1);
  add_trunk(plan, "aorta to right iliac artery",
            {begin + straight * to_heart, unit(out_of_heart), Vector3d::Zero()}, through,
            {iliac.back(), iliac_end_direction(Side::right), Vector3d::Zero()});

  const Axis& axis = plan.branches[0].axis;
  const double ascending = 0.5 * v["ascending_diameter_mm"];
  const double infrarenal = 0.5 * v["infrarenal_diameter_mm"];
  const double trunk = axis.nearest_arc_mm(arch.at_mm(arch.trunk_phi));
  const double carotid = axis.nearest_arc_mm(arch.at_mm(arch.carotid_phi));
  const double subclavian = axis.nearest_arc_mm(arch.at_mm(arch.subclavian_phi));
  const double hiatus = axis.nearest_arc_mm(diaphragm);
  const double divided = axis.nearest_arc_mm(division_mm * up);
  marks = {{0.0, 0.80 * ascending},
           {4.0, 0.84 * ascending},
           {12.0, 1.06 * ascending},
           {root_mm, 0.92 * ascending},
           {root_mm + 14.0, ascending},
           {trunk - 12.0, ascending},
           {carotid, 0.5 * v["arch_diameter_mm"]},
           {subclavian, 0.48 * v["arch_diameter_mm"]},
           {subclavian + 25.0, 0.5 * v["isthmus_diameter_mm"]},
           {hiatus, 0.5 * v["diaphragm_diameter_mm"]},
           {hiatus + 0.45 * (divided - hiatus), infrarenal},
           {divided - 4.0, 0.97 * infrarenal}};
  set_calibre(plan, 0, with_iliac_calibre(v, axis, Side::right, marks));
  add_end(plan, "aortic root", 0, true);
  add_landmark(plan, "sinotubular junction", 0, root_mm);
  add_landmark(plan, "ascending aorta", 0, 0.5 * (root_mm + 14.0 + trunk - 12.0));
  add_landmark(plan, "arch", 0, carotid);
  add_landmark(plan, "isthmus", 0, subclavian + 25.0);
  add_landmark(plan, "descending aorta", 0, 0.5 * (subclavian + hiatus));
  add_landmark(plan, "diaphragm", 0, hiatus);
  add_landmark(plan, "infrarenal aorta", 0, hiatus + 0.6 * (divided - hiatus));
  plan.route_end_arc_mm = trunk;
}

/// Direction of a branch at an angle to the aorta's own axis, which only nearly is the half circle low on its limbs.
Vector3d leaving_arch(const Plan& plan, const ArchFrame& arch, double phi, double angle_deg,
                      double clock_deg) {
  const Axis& axis = plan.branches[0].axis;
  const AxisPoint at = axis.at(axis.nearest_arc_mm(arch.at_mm(phi)));
  return leaving(at, radians(angle_deg), turned(arch.outward(phi), at.tangent, radians(clock_deg)));
}

/// Points of a carotid artery from `from` up to `top_mm`, moving aside to its place in the neck.
std::vector<Vector3d> neck_course(const Vector3d& from, double top_mm, double aside_mm) {
  constexpr double aside_within_mm = 95.0;  // of height
  constexpr int steps = 5;
  std::vector<Vector3d> course;
  for (int i = 1; i <= steps; ++i) {
    const double rise = (top_mm - from.z()) * i / steps;
    const double share = smooth_step(rise / aside_within_mm);
    course.emplace_back(from.x() + share * (aside_mm - from.x()), from.y() + 7.0 * share, from.z() + rise);
  }
  return course;
}

void set_carotid_calibre(Plan& plan, std::size_t branch, const Values& v, Marks marks, double common_mm) {
  const double end = plan.branches[branch].axis.length_mm();
  const double bulb = std::min(common_mm, end - 16.0);
  marks.push_back({bulb - 8.0, 0.5 * v["common_carotid_diameter_mm"]});
  marks.push_back({bulb + 8.0, 0.5 * v["internal_carotid_diameter_mm"]});
  marks.push_back({end, 0.5 * v["internal_carotid_diameter_mm"]});
  set_calibre(plan, branch, marks);
}

void add_right_subclavian(Plan& plan, const Values& v, std::size_t trunk, double division_arc,
                          const Marks& trunk_marks) {
  const double radius = 0.5 * v["subclavian_diameter_mm"];
  const double reach = v["subclavian_length_mm"];
  const Vector3d q = plan.branches[trunk].axis.at(division_arc).position_mm;
  const double begin = division_arc - 16.0;
  const std::size_t branch =
      add_second_branch(plan, {"right subclavian artery",
                               trunk,
                               begin,
                               {q + Vector3d(-7.5, 2.0, 6.0), q + Vector3d(-0.34 * reach, 5.0, 14.0),
                                q + Vector3d(-0.68 * reach, 6.0, 13.0), q + Vector3d(-reach, 2.0, 2.0)},
                               Vector3d(-0.9, -0.15, -0.4)});
  Marks marks = trunk_marks;
  for (RadiusProfile::Mark& mark : marks) mark.arc_mm -= begin;
  marks.push_back({division_arc + 10.0 - begin, radius});
  marks.push_back({plan.branches[branch].axis.length_mm(), radius});
  set_calibre(plan, branch, marks);
  round_ostium(plan, branch, v["trunk_carina_radius_mm"]);
  add_landmark(plan, "right subclavian", branch, 0.6 * plan.branches[branch].axis.length_mm());
  add_end(plan, "right subclavian end", branch);
}

/// The trunk as if it were `length_mm` long, continued by the right carotid; returns also where it divides.
SideBranch trunk_course(const Plan& plan, const Values& v, const ArchFrame& arch, double top_mm,
                        double length_mm, Vector3d& division) {
  SideBranch side;
  side.name = "brachiocephalic to right carotid artery";
  side.parent_arc_mm = plan.branches[0].axis.nearest_arc_mm(arch.at_mm(arch.trunk_phi));
  side.direction =
      leaving_arch(plan, arch, arch.trunk_phi, v["brachiocephalic_take_off_deg"], trunk_clock_deg);
  const Vector3d wall = wall_point_mm(plan, 0, side.parent_arc_mm, side.direction);
  division = wall + length_mm * unit(side.direction + Vector3d(-0.10, 0.05, 0.35));
  const Vector3d behind = division + Vector3d(-2.5, 1.0, 14.0);
  side.through_mm = {wall + 0.6 * length_mm * unit(side.direction + Vector3d(-0.06, 0.03, 0.22)), behind};
  for (const Vector3d& p : neck_course(behind, top_mm, -neck_mm)) side.through_mm.push_back(p);
  side.end_direction = up;
  return side;
}

std::size_t add_brachiocephalic(Plan& plan, const Values& v, const ArchFrame& arch, double top_mm) {
  const double length_mm = v["brachiocephalic_length_mm"];
  Vector3d division;
  const double factor = factor_for(length_mm, [&](double f) {
    const Axis axis = axis_of(plan, trunk_course(plan, v, arch, top_mm, f * length_mm, division));
    return axis.nearest_arc_mm(division) - ostium_arc_mm(plan.branches[0].axis, axis);
  });
  const std::size_t branch =
      add_side_branch(plan, trunk_course(plan, v, arch, top_mm, factor * length_mm, division));

  const double radius = 0.5 * v["brachiocephalic_diameter_mm"];
  const double division_arc = plan.branches[branch].axis.nearest_arc_mm(division);
  const Marks trunk{{0.0, radius}, {division_arc - 8.0, radius}};
  Marks marks = trunk;
  marks.push_back({division_arc + 10.0, 0.5 * v["common_carotid_diameter_mm"]});
  // The right common carotid artery ends where it would by its length from the arch [Choudhry2016].
  const double longer = 12.0;
  set_carotid_calibre(plan, branch, v, marks, v["common_carotid_length_mm"] + longer);
  round_ostium(plan, branch, v["ostium_carina_radius_mm"]);
  const double ostium = plan.branches[branch].ostium_arc_mm;
  add_landmark(plan, "brachiocephalic ostium", branch, ostium);
  add_landmark(plan, "brachiocephalic trunk", branch, 0.5 * (ostium + division_arc - 8.0));
  add_landmark(plan, "brachiocephalic division", branch, division_arc);
  add_right_subclavian(plan, v, branch, division_arc, trunk);
  add_landmark(plan, "right common carotid", branch, division_arc + 35.0);
  add_end(plan, "right carotid end", branch);
  return branch;
}

void add_left_carotid(Plan& plan, const Values& v, const ArchFrame& arch, std::size_t trunk, double top_mm) {
  SideBranch side;
  side.name = "left carotid artery";
  const bool bovine = v["bovine"] > 0.5;
  if (bovine) {
    side.parent = trunk;
    side.parent_arc_mm = plan.branches[trunk].ostium_arc_mm + bovine_mm;
    side.direction = leaving(plan.branches[trunk].axis.at(side.parent_arc_mm), radians(bovine_take_off_deg),
                             Vector3d(0.95, 0.3, 0.0));
  } else {
    side.parent_arc_mm = plan.branches[0].axis.nearest_arc_mm(arch.at_mm(arch.carotid_phi));
    side.direction =
        leaving_arch(plan, arch, arch.carotid_phi, v["left_carotid_take_off_deg"], carotid_clock_deg);
  }
  const Vector3d wall = wall_point_mm(plan, side.parent, side.parent_arc_mm, side.direction);
  side.through_mm = neck_course(wall + 10.0 * side.direction, top_mm, neck_mm);
  side.end_direction = up;
  const std::size_t branch = add_side_branch(plan, side);
  const double calibre = 0.5 * v["common_carotid_diameter_mm"];
  set_calibre(plan, branch, {{0.0, calibre}});
  const double ostium = plan.branches[branch].ostium_arc_mm;
  set_carotid_calibre(plan, branch, v, {{0.0, calibre}}, ostium + v["common_carotid_length_mm"]);
  round_ostium(plan, branch, v["ostium_carina_radius_mm"]);
  add_landmark(plan, "left carotid ostium", branch, ostium);
  add_landmark(plan, "left common carotid", branch, ostium + 35.0);
  add_landmark(plan, "left internal carotid", branch, plan.branches[branch].axis.length_mm() - 10.0);
  add_end(plan, "left carotid end", branch);
}

void add_left_subclavian(Plan& plan, const Values& v, const ArchFrame& arch) {
  SideBranch side;
  side.name = "left subclavian artery";
  side.parent_arc_mm = plan.branches[0].axis.nearest_arc_mm(arch.at_mm(arch.subclavian_phi));
  side.direction =
      leaving_arch(plan, arch, arch.subclavian_phi, v["left_subclavian_take_off_deg"], subclavian_clock_deg);
  const Vector3d wall = wall_point_mm(plan, 0, side.parent_arc_mm, side.direction);
  const double reach = v["subclavian_length_mm"];
  side.through_mm = {wall + Vector3d(4.0, 4.0, 22.0), wall + Vector3d(0.22 * reach, 6.0, 38.0),
                     wall + Vector3d(0.56 * reach, 4.0, 40.0), wall + Vector3d(reach, -2.0, 27.0)};
  side.end_direction = Vector3d(0.85, -0.2, -0.5);
  const std::size_t branch = add_side_branch(plan, side);
  set_calibre(plan, branch, {{0.0, 0.5 * v["subclavian_diameter_mm"]}});
  round_ostium(plan, branch, v["ostium_carina_radius_mm"]);
  add_landmark(plan, "left subclavian ostium", branch, plan.branches[branch].ostium_arc_mm);
  add_landmark(plan, "left subclavian", branch, 0.6 * plan.branches[branch].axis.length_mm());
  add_end(plan, "left subclavian end", branch);
}

}  // namespace

Plan aortic_arch(const Values& v) {
  const ArchFrame arch = arch_frame(v);
  Plan plan;
  Marks marks;
  add_aorta(plan, v, arch, marks);
  // Both carotids end at one height, where the left one has its length.
  const double ostium_z = arch.centre_mm.z() + arch.radius_mm + 0.5 * v["arch_diameter_mm"];
  const double length_mm = v["carotid_length_mm"];
  const auto with_neck = [&](double rise_mm) {
    Plan grown = plan;
    const std::size_t trunk = add_brachiocephalic(grown, v, arch, ostium_z + rise_mm);
    add_left_carotid(grown, v, arch, trunk, ostium_z + rise_mm);
    return grown;
  };
  plan = with_neck(length_mm * factor_for(length_mm, [&](double f) {
                     const Branch carotid = with_neck(f * length_mm).branches.back();
                     return carotid.axis.length_mm() - carotid.ostium_arc_mm;
                   }));
  add_left_subclavian(plan, v, arch);
  const std::size_t left =
      add_pelvis(plan, v, marks, iliac_course(v, Side::left), iliac_end_direction(Side::left));
  end_in_groins(plan, v, left);
  return plan;
}

void adjust_aortic_arch(Values& values, const Settings& given) {
  constexpr double less_per_type_deg = 10.0;
  for (const Parameter& p : values.table())
    if (std::string_view(p.name).ends_with("_take_off_deg") && !given.contains(p.name))
      values.set(p.name, std::max(p.low, values[p.name] - less_per_type_deg * (values["arch_type"] - 1.0)));
}

std::string aortic_arch_conflict(const Values& v) {
  static constexpr std::array order{
      Narrower{"brachiocephalic_diameter_mm", "arch_diameter_mm", 0.6},
      Narrower{"common_carotid_diameter_mm", "brachiocephalic_diameter_mm", 0.7},
      Narrower{"internal_carotid_diameter_mm", "common_carotid_diameter_mm", 0.95},
      Narrower{"subclavian_diameter_mm", "brachiocephalic_diameter_mm", 0.85},
  };
  if (std::string wider = first_wider(v, order); !wider.empty()) return wider;
  if (std::string wider = first_wider(v, iliac_order); !wider.empty()) return wider;
  const ArchFrame arch = arch_frame(v);
  const auto fault = [&](const char* name, const char* relation, double limit, const char* why) {
    return std::string(name) + " is " + text_of(v[name]) + "; must be " + relation + " " +
           text_of(std::ceil(10.0 * limit) / 10.0) + ", " + why;
  };
  if (straight_mm(v, arch) < root_mm)
    return fault("ascending_length_mm", ">=", v["ascending_length_mm"] + root_mm - straight_mm(v, arch),
                 "so that it reaches below this arch");
  const double inner = 0.6 * v["ascending_diameter_mm"];
  if (arch.radius_mm < inner) return fault("arch_radius_mm", ">=", inner, "more than the aorta's own radius");
  return {};
}

}  // namespace endowire::vessel::anatomy

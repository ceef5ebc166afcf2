#include "endowire/vessel/anatomy/renal.hpp"

#include <array>

#include "endowire/vessel/anatomy/iliac.hpp"
#include "endowire/vessel/anatomy/iliac_parameters.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Marks = std::vector<RadiusProfile::Mark>;

constexpr double above_renal_mm = 70.0;   // of aorta: a catheter needs room to be shaped
constexpr double hilar_length_mm = 18.0;  // of the two branches in front of a kidney
constexpr double hilar_calibre = 0.72;    // of the renal artery: two branches of 0.72 have its area, nearly
constexpr double hilar_take_off_deg = 40.0;

void add_hilar_branch(Plan& plan, std::size_t artery, double outward, const std::string& side, double calibre,
                      double carina_mm) {
  const Axis& axis = plan.branches[artery].axis;
  SideBranch branch;
  branch.name = side + " posterior renal branch";
  branch.parent = artery;
  branch.parent_arc_mm = axis.length_mm() - hilar_length_mm;
  branch.direction =
      leaving(axis.at(branch.parent_arc_mm), radians(hilar_take_off_deg), Vector3d(0.0, 0.4, 0.9));
  const Vector3d wall = wall_point_mm(plan, artery, branch.parent_arc_mm, branch.direction);
  branch.end_direction = unit(branch.direction + Vector3d(0.8 * outward, 0.3, -0.2));
  branch.straight_mm = 2.0;
  branch.through_mm = {wall + 0.8 * hilar_length_mm * unit(branch.direction + 0.35 * branch.end_direction)};
  const std::size_t index = add_side_branch(plan, branch);
  set_calibre(plan, index, {{0.0, calibre}});
  round_ostium(plan, index, carina_mm);
  add_end(plan, branch.name + " end", index);
}

/// @param outward  +1 on the left, −1 on the right
void add_renal(Plan& plan, const Values& v, double outward, double height_mm) {
  const std::string side = outward > 0.0 ? "left" : "right";
  const auto of_side = [&](const char* name) { return v[side + name]; };
  const double radius = 0.5 * of_side("_renal_diameter_mm");
  const Axis& aorta = plan.branches[0].axis;
  SideBranch artery;
  artery.name = side + " renal artery";
  artery.parent_arc_mm = aorta.nearest_arc_mm({0.0, 0.0, height_mm});
  const AxisPoint at = aorta.at(artery.parent_arc_mm);
  const double forward = radians(of_side("_renal_axial_deg"));
  const Vector3d aside(outward * cosine(forward), -sine(forward), 0.0);
  artery.direction = leaving(at, radians(v["renal_take_off_deg"]), aside);
  const Vector3d wall = wall_point_mm(plan, 0, artery.parent_arc_mm, artery.direction);
  const double reach = of_side("_renal_length_mm");
  // Behind the ostium the artery turns to the back, along the psoas muscle, to the kidney.
  const Vector3d to_kidney = unit(Vector3d(outward, 0.55, -0.15));
  const auto through = [&](double length_mm) {
    const Vector3d division = wall + length_mm * unit(0.6 * artery.direction + to_kidney);
    return std::vector<Vector3d>{wall + 0.5 * length_mm * unit(artery.direction + 0.6 * to_kidney), division,
                                 division + hilar_length_mm * to_kidney};
  };
  artery.end_direction = to_kidney;
  artery.through_mm =
      through(reach * factor_for(reach, [&](double f) {
                artery.through_mm = through(f * reach);
                const Axis axis = axis_of(plan, artery);
                return axis.length_mm() - hilar_length_mm - ostium_arc_mm(plan.branches[0].axis, axis);
              }));
  const std::size_t index = add_side_branch(plan, artery);
  const double end = plan.branches[index].axis.length_mm();
  set_calibre(plan, index,
              {{0.0, radius},
               {end - hilar_length_mm - 3.0, radius},
               {end - hilar_length_mm + 7.0, hilar_calibre * radius},
               {end, hilar_calibre * radius}});
  round_ostium(plan, index, v["renal_carina_radius_mm"]);
  const double ostium = plan.branches[index].ostium_arc_mm;
  add_landmark(plan, side + " renal ostium", index, ostium);
  add_landmark(plan, side + " renal", index, 0.5 * (ostium + end - hilar_length_mm));
  add_landmark(plan, side + " renal division", index, end - hilar_length_mm);
  add_end(plan, side + " renal end", index);
  add_hilar_branch(plan, index, outward, side, hilar_calibre * radius, v["hilar_carina_radius_mm"]);
}

}  // namespace

Plan renal(const Values& v) {
  Plan plan;
  const double level = v["infrarenal_length_mm"];
  const double top = level + above_renal_mm;
  std::vector<Vector3d> through{
      {5.0, 9.0, 0.75 * top}, {2.5, 4.5, 0.5 * top}, {0.6, 1.0, 0.26 * top}, division_mm * Vector3d::UnitZ()};
  const std::vector<Vector3d> right = iliac_course(v, Side::right);
  through.insert(through.end(), right.begin(), right.end() - 1);
  add_trunk(plan, "aorta to right iliac artery",
            {{7.0, 13.0, top}, unit(Vector3d(-0.06, -0.12, -1.0)), Vector3d::Zero()}, through,
            {right.back(), iliac_end_direction(Side::right), Vector3d::Zero()});
  const Axis& axis = plan.branches[0].axis;
  const double divided = axis.nearest_arc_mm(division_mm * Vector3d::UnitZ());
  const double renal_arc = axis.nearest_arc_mm({0.0, 0.0, level});
  const double infrarenal = 0.5 * v["infrarenal_diameter_mm"];
  const double suprarenal = 0.5 * v["suprarenal_diameter_mm"];
  const Marks marks{{0.0, suprarenal},
                    {renal_arc - 8.0, suprarenal},
                    {renal_arc + 14.0, infrarenal},
                    {divided - 4.0, 0.97 * infrarenal}};
  set_calibre(plan, 0, with_iliac_calibre(v, axis, Side::right, marks));
  add_end(plan, "aortic end", 0, true);
  add_landmark(plan, "suprarenal aorta", 0, 0.5 * renal_arc);
  add_landmark(plan, "infrarenal aorta", 0, renal_arc + 0.45 * (divided - renal_arc));
  add_renal(plan, v, -1.0, level + v["right_renal_higher_mm"]);
  add_renal(plan, v, 1.0, level);
  const std::size_t left =
      add_pelvis(plan, v, marks, iliac_course(v, Side::left), iliac_end_direction(Side::left));
  end_in_groins(plan, v, left);
  plan.route_end_arc_mm = axis.nearest_arc_mm({0.0, 0.0, level});
  return plan;
}

std::string renal_conflict(const Values& v) {
  static constexpr std::array order{
      Narrower{"infrarenal_diameter_mm", "suprarenal_diameter_mm", 1.0},
      Narrower{"right_renal_diameter_mm", "suprarenal_diameter_mm", 0.45},
      Narrower{"left_renal_diameter_mm", "suprarenal_diameter_mm", 0.45},
  };
  if (std::string wider = first_wider(v, iliac_order); !wider.empty()) return wider;
  return first_wider(v, order);
}

std::span<const Parameter> renal_parameters() {
  using enum Trait;
  static constexpr std::array own_table{
      Parameter{"suprarenal_diameter_mm", "mm", 19.5, 14.5, 24.0, false, calibre,
                "aorta above the renal arteries",
                "Jasper2014: 19.0 +- 2.3 (men, India); Joh2013: 22.0 (men, Korea)"},
      infrarenal_diameter,
      Parameter{"infrarenal_length_mm", "mm", 92, 75, 115, false, stature,
                "left renal ostium to aortic bifurcation",
                "estimate: from the second lumbar vertebra to the fourth"},
      Parameter{"right_renal_higher_mm", "mm", 4.0, -6.0, 14.0, false, own,
                "right renal ostium above the left one",
                "Beregi1999: the same level in 50 %, higher in 37 %; the distance is an estimate"},
      Parameter{"right_renal_diameter_mm", "mm", 5.7, 4.2, 7.0, false, calibre, "right renal artery",
                "RenalArea2019: 25.4 mm2 in cross-section; range: estimate"},
      Parameter{"left_renal_diameter_mm", "mm", 6.0, 4.4, 7.4, false, calibre, "left renal artery",
                "RenalArea2019: 28.5 mm2 in cross-section; range: estimate"},
      Parameter{"right_renal_length_mm", "mm", 44, 30, 60, false, stature,
                "right renal artery up to its division",
                "estimate: longer than the left one, behind the caval vein"},
      Parameter{"left_renal_length_mm", "mm", 36, 25, 50, false, stature,
                "left renal artery up to its division",
                "estimate: shorter than the right one, the aorta lies to the left"},
      Parameter{"right_renal_axial_deg", "deg", 24, -10, 55, false, own, "how far it leaves to the front",
                "Beregi1999: mean 24, -10 to 55"},
      Parameter{"left_renal_axial_deg", "deg", -11, -55, 30, false, own, "how far it leaves to the front",
                "Beregi1999: mean -11, -55 to 30"},
      Parameter{"renal_take_off_deg", "deg", 68, 45, 90, false, own, "angle with the aorta downstream",
                "estimate: slightly downward"},
      Parameter{"renal_carina_radius_mm", "mm", 1.4, 0.8, 2.2, false, own,
                "of the acute lip of a renal ostium",
                "estimate, unreported: a third to a half of the branch's radius"},
      Parameter{"hilar_carina_radius_mm", "mm", 0.9, 0.6, 1.4, false, own,
                "of the division of a renal artery", "estimate, unreported: half the branch's radius"},
      sheath_depth,
  };
  static constexpr auto table = joined(own_table, iliac_parameters);
  return table;
}

}  // namespace endowire::vessel::anatomy

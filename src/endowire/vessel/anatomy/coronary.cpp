#include "endowire/vessel/anatomy/coronary.hpp"

#include <array>

#include <algorithm>
#include <cmath>
#include <functional>

#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

// The heart: half an ellipsoid about its long axis, from the base at the origin to the apex, left, in front and
// below. θ counts around the axis from above, positive to the left and back [deg]; s along the axis [mm]. The
// anterior groove lies at 15°, the atrioventricular one at s = 0, the inferior one at −172°. Sizes are estimates for a
// heart of 300 g.
const Vector3d to_apex(0.58, -0.60, -0.55);
constexpr double heart_radius_mm = 42.0;
constexpr double heart_length_mm = 88.0;
const Vector3d out_of_heart(-0.42, -0.18, 0.89);
constexpr double root_height_mm = 55.0;

struct Heart {
  Vector3d axis, above, left;

  Heart() {
    axis = unit(to_apex);
    above = unit(Vector3d::UnitZ() - axis.z() * axis);
    left = cross(above, axis);
  }
  [[nodiscard]] Vector3d around(double theta_deg) const {
    return cosine(radians(theta_deg)) * above + sine(radians(theta_deg)) * left;
  }
  [[nodiscard]] Vector3d surface(double theta_deg, double s_mm) const {
    const double t = s_mm / heart_length_mm;
    return heart_radius_mm * std::sqrt(1.0 - t * t) * around(theta_deg) + s_mm * axis;
  }
};

using Way = std::function<Vector3d(double)>;  // over the heart, from 0 to 1

/// Points along a way, some 10 mm apart, until `length_mm` are walked, counted from a place before its beginning.
std::vector<Vector3d> walk(const Vector3d& from_mm, double length_mm, const Way& way) {
  constexpr double apart_mm = 10.0;
  constexpr double step = 1e-3;
  Vector3d last = way(0.0);
  double walked = length(last - from_mm);
  const double rest = length_mm - walked;
  const double pieces = std::ceil(rest / apart_mm);
  std::vector<Vector3d> points{last};
  for (double t = step; t <= 1.0; t += step) {
    const Vector3d next = way(t);
    walked += length(next - last);
    last = next;
    if (length_mm - walked > rest * (1.0 - static_cast<double>(points.size()) / pieces)) continue;
    points.push_back(next);
    if (static_cast<double>(points.size()) > pieces) break;
  }
  return points;
}

Vector3d direction_at_end(const std::vector<Vector3d>& points) {
  return unit(points.back() - points[points.size() - 2]);
}

/// A branch of a coronary artery that goes on over the heart.
struct SurfaceBranch {
  std::string name;
  std::size_t parent;
  double parent_arc_mm;
  double take_off_deg;
  double length_mm;  ///< from its ostium
  double begin_radius_mm, end_radius_mm;
  Way way;
};

std::size_t add_surface_branch(Plan& plan, const SurfaceBranch& surface, double carina_mm) {
  const AxisPoint at = plan.branches[surface.parent].axis.at(surface.parent_arc_mm);
  SideBranch branch;
  branch.name = surface.name + " artery";
  branch.parent = surface.parent;
  branch.parent_arc_mm = surface.parent_arc_mm;
  branch.direction = leaving(at, radians(surface.take_off_deg), surface.way(0.0) - at.position_mm);
  branch.straight_mm = 1.5;
  const Vector3d wall = wall_point_mm(plan, surface.parent, surface.parent_arc_mm, branch.direction);
  const auto measured_mm = [&](double f) {
    branch.through_mm = walk(wall, f * surface.length_mm, surface.way);
    branch.end_direction = direction_at_end(branch.through_mm);
    const Axis axis = axis_of(plan, branch);
    return axis.length_mm() - ostium_arc_mm(plan.branches[surface.parent].axis, axis);
  };
  static_cast<void>(measured_mm(factor_for(surface.length_mm, measured_mm)));
  const std::size_t index = add_side_branch(plan, branch);
  set_calibre(plan, index,
              {{0.0, surface.begin_radius_mm},
               {12.0, surface.begin_radius_mm},
               {plan.branches[index].axis.length_mm(), surface.end_radius_mm}});
  round_ostium(plan, index, carina_mm);
  const double ostium = plan.branches[index].ostium_arc_mm;
  add_landmark(plan, surface.name + " ostium", index, ostium);
  add_landmark(plan, surface.name, index, ostium + 6.0);
  add_end(plan, surface.name + " end", index);
  return index;
}

void add_root(Plan& plan, const Values& v, const Heart& heart) {
  const Vector3d annulus = 14.0 * heart.around(-30.0) - 8.0 * heart.axis;
  const Vector3d along = unit(out_of_heart);
  const Vector3d top = annulus + root_height_mm * along + Vector3d(-1.0, -2.0, 1.0);
  add_trunk(plan, "aortic root", {annulus, along, Vector3d::Zero()}, {annulus + 0.5 * root_height_mm * along},
            {top, unit(along + Vector3d(0.04, -0.10, 0.05)), Vector3d::Zero()});
  const double ascending = 0.5 * v["ascending_diameter_mm"];
  // Proportions of the sinuses as in the aortic arch [Davis2014].
  set_calibre(plan, 0,
              {{0.0, 0.80 * ascending},
               {4.0, 0.84 * ascending},
               {12.0, 1.06 * ascending},
               {22.0, 0.92 * ascending},
               {34.0, ascending},
               {plan.branches[0].axis.length_mm(), ascending}});
  add_landmark(plan, "ascending aorta", 0, 44.0);
  add_end(plan, "annulus", 0, true);
  add_end(plan, "ascending aorta end", 0);
}

/// A coronary artery from the root to `target_mm` on the heart and on along `points`.
SideBranch from_root(const Plan& plan, const Values& v, const std::string& name, const Vector3d& target_mm,
                     const std::vector<Vector3d>& points) {
  SideBranch branch;
  branch.name = name;
  branch.parent_arc_mm = v["ostium_height_mm"];
  const AxisPoint at = plan.branches[0].axis.at(branch.parent_arc_mm);
  // Straight at the target, but at 70° to the root at least.
  const Vector3d there = unit(target_mm - at.position_mm);
  const double along = std::clamp(dot(there, at.tangent), -0.34, 0.34);
  const Vector3d aside = unit(there - dot(there, at.tangent) * at.tangent);
  branch.direction = along * at.tangent + std::sqrt(1.0 - along * along) * aside;
  branch.straight_mm = 3.0;
  branch.through_mm = {target_mm};
  branch.through_mm.insert(branch.through_mm.end(), points.begin(), points.end());
  branch.end_direction = direction_at_end(points);
  return branch;
}

void add_left_branches(Plan& plan, const Values& v, const Heart& heart, std::size_t lad, double divided_mm) {
  const double carina = v["carina_radius_mm"];
  const double circumflex = 0.5 * v["circumflex_diameter_mm"];
  const std::size_t lcx = add_surface_branch(
      plan,
      {"circumflex", lad, divided_mm, v["left_main_division_deg"], v["circumflex_length_mm"], circumflex,
       0.6 * circumflex,
       [&](double t) { return heart.surface(40.0 + 125.0 * t, 4.0 + 5.0 * t + 1.5 * sine(10.0 * t)); }},
      carina);
  const double marginal_arc = 26.0;
  const double marginal = plan.branches[lcx].axis.at(marginal_arc).radius_mm;
  add_surface_branch(plan,
                     {"marginal", lcx, marginal_arc, 55.0, 55.0, 0.62 * marginal, 0.45 * marginal,
                      [&](double t) { return heart.surface(72.0 + 10.0 * t, 20.0 + 62.0 * t); }},
                     carina);
  const double diagonal_arc = divided_mm + 27.0;
  const double diagonal = plan.branches[lad].axis.at(diagonal_arc).radius_mm;
  add_surface_branch(plan,
                     {"diagonal", lad, diagonal_arc, 45.0, 50.0, 0.60 * diagonal, 0.45 * diagonal,
                      [&](double t) { return heart.surface(24.0 + 26.0 * t, 38.0 + 46.0 * t); }},
                     carina);
}

/// The left main as if it were `length_mm` long, continued by the anterior descending artery; also where it divides.
SideBranch left_course(const Plan& plan, const Values& v, const Heart& heart, double length_mm,
                       Vector3d& division) {
  const AxisPoint root = plan.branches[0].axis.at(v["ostium_height_mm"]);
  const Vector3d aside = unit(heart.surface(24.0, 2.0) - root.position_mm);
  division = root.position_mm + (root.radius_mm + length_mm) * aside;
  return from_root(plan, v, "left main to anterior descending artery", division,
                   walk(division, v["anterior_descending_length_mm"], [&](double t) {
                     return heart.surface(16.0 - 14.0 * t + 2.0 * sine(9.0 * t), 10.0 + 76.0 * t);
                   }));
}

void add_left(Plan& plan, const Values& v, const Heart& heart) {
  const double length_mm = v["left_main_length_mm"];
  Vector3d division;
  const double factor = factor_for(length_mm, [&](double f) {
    const Axis axis = axis_of(plan, left_course(plan, v, heart, f * length_mm, division));
    return axis.nearest_arc_mm(division) - ostium_arc_mm(plan.branches[0].axis, axis);
  });
  const std::size_t lad = add_side_branch(plan, left_course(plan, v, heart, factor * length_mm, division));
  const double main = 0.5 * v["left_main_diameter_mm"];
  const double proximal = 0.5 * v["anterior_descending_diameter_mm"];
  const double divided = plan.branches[lad].axis.nearest_arc_mm(division);
  set_calibre(plan, lad,
              {{0.0, main},
               {divided - 3.0, main},
               {divided + 5.0, proximal},
               {divided + 18.0, proximal},
               {plan.branches[lad].axis.length_mm(), 0.5 * v["distal_descending_diameter_mm"]}});
  round_ostium(plan, lad, v["ostium_carina_radius_mm"]);
  const double ostium = plan.branches[lad].ostium_arc_mm;
  add_landmark(plan, "left main ostium", lad, ostium);
  add_landmark(plan, "left main", lad, 0.5 * (ostium + divided - 3.0));
  add_landmark(plan, "left main division", lad, divided);
  add_landmark(plan, "anterior descending", lad, divided + 11.0);
  add_end(plan, "anterior descending end", lad);
  add_left_branches(plan, v, heart, lad, divided);
}

void add_right(Plan& plan, const Values& v, const Heart& heart) {
  // Round the groove to the crux, then along the inferior groove to the apex, turning within 32 mm.
  constexpr double begin_deg = -75.0;
  constexpr double crux_deg = -168.0;
  constexpr double turn_mm = 32.0;
  const double groove_mm = radians(begin_deg - crux_deg) * heart_radius_mm;
  const double descending_mm = v["posterior_descending_length_mm"];
  const Vector3d target = heart.surface(-62.0, 5.0);
  const Way way = [&](double t) {
    const double walked = 1.2 * (groove_mm + descending_mm) * t;
    const double beyond = walked - groove_mm + 0.5 * turn_mm;
    const double turn = smooth_step(beyond / turn_mm);
    const double theta = begin_deg + (crux_deg - begin_deg) * std::min(1.0, walked / groove_mm);
    return heart.surface((1.0 - turn) * theta + turn * crux_deg, 8.0 + 0.92 * turn * std::max(0.0, beyond));
  };
  const double approach = length(way(0.0) - target);
  const std::vector<Vector3d> around = walk(target, approach + groove_mm + descending_mm, way);
  const std::size_t rca = add_side_branch(
      plan, from_root(plan, v, "right coronary to posterior descending artery", target, around));
  const double radius = 0.5 * v["right_coronary_diameter_mm"];
  const double descending = 0.5 * v["posterior_descending_diameter_mm"];
  const double end = plan.branches[rca].axis.length_mm();
  const double crux = end - descending_mm;
  set_calibre(plan, rca,
              {{0.0, radius},
               {38.0, radius},
               {crux - 6.0, 0.78 * radius},
               {crux + 6.0, descending},
               {crux + 14.0, descending},
               {end, 0.72 * descending}});
  round_ostium(plan, rca, v["ostium_carina_radius_mm"]);
  const double ostium = plan.branches[rca].ostium_arc_mm;
  add_landmark(plan, "right coronary ostium", rca, ostium);
  add_landmark(plan, "right coronary", rca, ostium + 8.0);
  add_landmark(plan, "crux", rca, crux);
  add_landmark(plan, "posterior descending", rca, crux + 10.0);
  add_end(plan, "posterior descending end", rca);
  add_surface_branch(plan,
                     {"posterolateral", rca, crux - 4.0, 50.0, 38.0, 0.85 * descending, 0.65 * descending,
                      [&](double t) { return heart.surface(crux_deg - 14.0 - 60.0 * t, 12.0 + 16.0 * t); }},
                     v["carina_radius_mm"]);
}

}  // namespace

Plan coronary(const Values& v) {
  const Heart heart;
  Plan plan;
  add_root(plan, v, heart);
  add_left(plan, v, heart);
  add_right(plan, v, heart);
  const std::size_t entered = plan.index_of(v["right"] > 0.5 ? "right coronary to posterior descending artery"
                                                             : "left main to anterior descending artery");
  plan.access = {"access", entered, plan.branches[entered].ostium_arc_mm + v["guide_depth_mm"]};
  plan.route_end_arc_mm = plan.branches[entered].axis.length_mm();
  return plan;
}

std::string coronary_conflict(const Values& v) {
  static constexpr std::array order{
      Narrower{"anterior_descending_diameter_mm", "left_main_diameter_mm", 0.95},
      Narrower{"circumflex_diameter_mm", "left_main_diameter_mm", 0.9},
      Narrower{"circumflex_diameter_mm", "anterior_descending_diameter_mm", 1.0},
      Narrower{"distal_descending_diameter_mm", "anterior_descending_diameter_mm", 0.8},
      Narrower{"posterior_descending_diameter_mm", "right_coronary_diameter_mm", 0.75},
  };
  return first_wider(v, order);
}

std::span<const Parameter> coronary_parameters() {
  using enum Trait;
  static constexpr std::array table{
      Parameter{"right", "-", 0, 0, 1, true, own, "1: the access is in the right coronary artery",
                "a choice"},
      Parameter{"ascending_diameter_mm", "mm", 30.9, 26.0, 36.0, false, calibre,
                "ascending aorta above the sinuses", "Hager2002: 30.9 +- 4.1"},
      Parameter{"ostium_height_mm", "mm", 13.5, 11.0, 16.0, false, own,
                "of both coronary ostia above the annulus", "estimate: below the sinotubular junction"},
      Parameter{"left_main_diameter_mm", "mm", 4.5, 3.5, 5.5, false, calibre, "left main",
                "Dodge1992: 4.5 +- 0.5"},
      Parameter{"left_main_length_mm", "mm", 10.5, 6.0, 18.0, false, own, "from its ostium to its division",
                "MedranoGracia2016: 10.5 +- 5.3; 6 at least, for a fillet"},
      Parameter{"left_main_division_deg", "deg", 75, 45, 115, false, own,
                "angle of the circumflex with the left main",
                "MedranoGracia2016: 75 +- 23 between circumflex and anterior descending"},
      Parameter{"anterior_descending_diameter_mm", "mm", 3.7, 2.9, 4.5, false, calibre,
                "anterior descending, near its origin", "Dodge1992: 3.7 +- 0.4"},
      Parameter{"distal_descending_diameter_mm", "mm", 1.9, 1.5, 2.7, false, calibre,
                "anterior descending, at its end", "Dodge1992: 1.9 +- 0.4; 1.5 at least: estimate"},
      Parameter{"anterior_descending_length_mm", "mm", 82, 70, 92, false, stature,
                "anterior descending, as far as it is modelled",
                "estimate: short of the apex, where it is still over 1 mm wide"},
      Parameter{"circumflex_diameter_mm", "mm", 3.4, 2.4, 4.4, false, calibre, "circumflex, near its origin",
                "Dodge1992: 3.4 +- 0.5"},
      Parameter{"circumflex_length_mm", "mm", 60, 45, 75, false, stature, "circumflex in its groove",
                "estimate: a third of the way around the heart"},
      Parameter{"right_coronary_diameter_mm", "mm", 3.9, 2.8, 5.1, false, calibre,
                "right coronary, near its origin", "Dodge1992: 3.9 +- 0.6"},
      Parameter{"posterior_descending_diameter_mm", "mm", 2.2, 1.7, 2.8, false, calibre,
                "posterior descending", "estimate: narrower than the right coronary before it"},
      Parameter{"posterior_descending_length_mm", "mm", 45, 30, 60, false, stature,
                "posterior descending, as far as it is modelled",
                "estimate: two thirds of the way to the apex"},
      Parameter{"ostium_carina_radius_mm", "mm", 0.9, 0.6, 1.4, false, own,
                "of the acute lip of the ostia in the root",
                "estimate, unreported: half the artery's radius"},
      Parameter{"carina_radius_mm", "mm", 0.5, 0.4, 0.8, false, own, "of all other divisions",
                "estimate, unreported: a third to a half of the branch's radius"},
      Parameter{"guide_depth_mm", "mm", 2.0, 1.0, 4.0, false, own, "of the guiding catheter in the ostium",
                "estimate: a guiding catheter just engaged"},
  };
  return table;
}

}  // namespace endowire::vessel::anatomy

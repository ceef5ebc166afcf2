#include "endowire/sim/target.hpp"

#include <cmath>
#include <sstream>

#include "endowire/base/error.hpp"

namespace endowire::sim {

namespace {

using vessel::CentrelineBranch;
using vessel::CentrelinePlace;
using vessel::CentrelineTree;

constexpr double near_radii = 2.0;  // a point given by hand may miss the lumen a little
constexpr double rounding_mm = 1e-9;

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw base::InputError(text.str());
}

const CentrelineBranch& branch_of(const CentrelineTree& tree, std::int32_t index) {
  return tree.branches()[static_cast<std::size_t>(index)];
}

/// A branch of this name, or the first stretch of a vessel of this name: whether others leave a vessel, and so cut it into
/// stretches, may differ from one patient to the next.
std::int32_t named(const CentrelineTree& tree, const std::string& name) {
  for (const std::string& one : {name, name + ":1"})
    if (const std::int32_t branch = tree.branch_named(one); branch >= 0) return branch;
  std::ostringstream known;
  constexpr std::size_t most = 12;
  const std::size_t count = tree.branches().size();
  for (std::size_t b = 0; b < std::min(count, most); ++b)
    known << (b == 0 ? "" : ", ") << tree.branches()[b].name;
  if (count > most) known << ", … (" << count << " in all; endowire inspect lists them)";
  refuse("target.branch is \"", name, "\"; must be one of ", known.str());
}

CentrelinePlace near(const CentrelineTree& tree, const Eigen::Vector3d& point_mm) {
  const vessel::NearestCentreline nearest = tree.nearest(point_mm);
  if (nearest.offset_mm > near_radii * nearest.radius_mm)
    refuse("target.near_mm is ", nearest.offset_mm,
           " mm from the nearest centreline; must be <= ", near_radii * nearest.radius_mm, ", ", near_radii,
           " radii of the lumen there");
  return nearest.place;
}

/// The stretch that goes on as the same vessel; -1: it ends.
std::int32_t next_stretch(const CentrelineTree& tree, std::int32_t branch) {
  const CentrelineBranch& b = branch_of(tree, branch);
  if (b.children.empty() || branch_of(tree, b.children.front()).vessel != b.vessel) return -1;
  return b.children.front();
}

/// So far beyond the ostium of a branch, through the stretches of its vessel.
CentrelinePlace beyond_ostium(const CentrelineTree& tree, std::int32_t branch, double beyond_mm) {
  CentrelinePlace goal{branch, branch_of(tree, branch).ostium_arc_mm + beyond_mm};
  while (goal.arc_mm > branch_of(tree, goal.branch).length_mm) {
    const double length_mm = branch_of(tree, goal.branch).length_mm;
    const std::int32_t next = next_stretch(tree, goal.branch);
    if (next < 0)
      refuse("target.beyond_ostium_mm is ", beyond_mm, "; must be <= ", beyond_mm - (goal.arc_mm - length_mm),
             ", where the vessel of branch ", branch_of(tree, branch).name, " ends");
    goal = {next, goal.arc_mm - length_mm};
  }
  return goal;
}

}  // namespace

Target find_target(const CentrelineTree& tree, const TargetSpec& spec) {
  if (tree.branches().empty()) refuse("target is given; must be left out: the vessel has no centrelines");
  Target target;
  target.within_radii = spec.within_radii;
  target.beyond_ostium_mm = spec.beyond_ostium_mm.value_or(0.0);
  if (spec.branch.empty()) {
    const CentrelinePlace place = near(tree, spec.near_mm);
    target.branch = tree.lumen_branch(place);
    const CentrelineBranch& branch = branch_of(tree, target.branch);
    // Before the ostium of a branch: at the end of the parent's, in whose lumen the point lies.
    const double arc_mm = target.branch == place.branch ? place.arc_mm : branch.length_mm;
    if (!spec.beyond_ostium_mm) target.beyond_ostium_mm = arc_mm - branch.ostium_arc_mm;
  } else {
    target.branch = named(tree, spec.branch);
  }
  target.goal = beyond_ostium(tree, target.branch, target.beyond_ostium_mm);
  const vessel::CentrelineState state = tree.state_at(target.goal);
  target.position_mm = state.position_mm;
  target.radius_mm = state.radius_mm;
  return target;
}

TargetDistance distance_to(const Target& target, const CentrelineTree& tree, const Eigen::Vector3d& tip_mm) {
  const vessel::NearestCentreline tip = tree.nearest(tip_mm);
  const double way_mm = tree.distance_mm(tip.place, target.goal);
  const double further_mm = tree.from_root_mm(tip.place) - tree.from_root_mm(target.goal);
  TargetDistance distance;
  distance.offset_radii = tip.offset_mm / tip.radius_mm;
  // Behind the goal the way back to it leads straight towards the root.
  const bool behind = further_mm >= way_mm - rounding_mm;
  distance.to_go_mm = behind ? 0.0 : way_mm;
  distance.reached = behind && distance.offset_radii <= target.within_radii;
  return distance;
}

}  // namespace endowire::sim

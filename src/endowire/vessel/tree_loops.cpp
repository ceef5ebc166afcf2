// Loops of the lumen: where two parts of a grown tree meet again around tissue.
//
//            ┌────── limb A ──────┐            The tree reaches both limbs from the fork. Their covers meet in an edge
//   root ── fork     tissue     edge           of the graph, the bridge. It closes a loop when the way along the tree
//            └────── limb B ──────┘            is much longer than the way across, and when rungs between the two
//                                              limbs pass the wall: what has no tissue inside is one lumen.
#include <algorithm>
#include <cmath>

#include "endowire/vessel/tree_growth.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

/// The way along the tree is this many times the way across a bridge. At a carina of 40° between two branches
/// it is 3 at most, and rungs see no tissue there; around a pillar of tissue it is more than π.
constexpr double min_detour = 3.0;
/// A bridge leads through lumen of at least this part of the narrower limb's radius.
constexpr double min_width_part = 0.3;
/// Rungs are set over this part of the limbs, from the bridge towards the fork: at its ends they always see
/// each other, or look across a carina.
constexpr double first_rung = 0.3;
constexpr double last_rung = 0.9;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

/// The limb of each point: a stretch of the tree between forks, named by its first point.
std::vector<Index> TreeGrowth::limbs() const {
  std::vector<Index> children(points_.size(), 0);
  for (const Point& p : points_)
    if (p.parent >= 0) ++children[at(p.parent)];
  std::vector<Index> limb(points_.size(), 0);
  for (std::size_t p = 1; p < points_.size(); ++p) {
    const Index parent = points_[p].parent;
    limb[p] = parent != 0 && children[at(parent)] == 1 ? limb[at(parent)] : static_cast<Index>(p);
  }
  return limb;
}

/// Where the ways from two points to the root meet.
Index TreeGrowth::fork_of(Index a, Index b) const {
  while (a != b) {
    const bool further = from_root_mm_[at(a)] > from_root_mm_[at(b)] ||
                         (from_root_mm_[at(a)] == from_root_mm_[at(b)] && a > b);
    (further ? a : b) = points_[at(further ? a : b)].parent;
  }
  return a;
}

std::vector<Index> TreeGrowth::points_down_to(Index point, Index fork) const {
  std::vector<Index> way;
  for (; point != fork; point = points_[at(point)].parent) way.push_back(point);
  way.push_back(fork);
  return way;
}

/// The widest bridge between each two limbs, in the order of limbs.
std::vector<TreeGrowth::Bridge> TreeGrowth::bridges() const {
  const std::vector<Index> limb = limbs();
  std::vector<Bridge> found;
  for (Index u = 0; at(u) < graph_.size(); ++u) {
    const Index a = owner_[at(u)];
    if (a < 0) continue;
    for (Index w : graph_.neighbours(u)) {
      const Index b = owner_[at(w)];
      if (w <= u || b == a) continue;
      const double radius_a = points_[at(a)].radius_mm;
      const double radius_b = points_[at(b)].radius_mm;
      const double width = std::min(radius_mm(u), radius_mm(w));
      if (width < min_width_part * std::min(radius_a, radius_b)) continue;
      const double across = beyond_mm_[at(u)] + radius_a + way_mm(u, w) + beyond_mm_[at(w)] + radius_b;
      // The way along the tree is at least the difference of the ways from the root: most pairs end here.
      const Index fork = fork_of(a, b);
      const double along = from_root_mm_[at(a)] + from_root_mm_[at(b)] - 2.0 * from_root_mm_[at(fork)];
      if (along < min_detour * across) continue;
      const auto names = std::minmax(limb[at(a)], limb[at(b)]);
      found.push_back({a, b, u, w, {names.first, names.second}, width});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Bridge& x, const Bridge& y) {
    return x.limbs < y.limbs || (x.limbs == y.limbs && x.width_mm > y.width_mm);
  });
  return found;
}

bool TreeGrowth::around_tissue(const Bridge& bridge) const {
  const Index fork = fork_of(bridge.from, bridge.to);
  const std::vector<Index> a = points_down_to(bridge.from, fork);
  const std::vector<Index> b = points_down_to(bridge.to, fork);
  const auto place = [&](const std::vector<Index>& way, double part) -> const Vector3d& {
    const double arc =
        from_root_mm_[at(fork)] + (1.0 - part) * (from_root_mm_[at(way.front())] - from_root_mm_[at(fork)]);
    const auto below =
        std::find_if(way.begin(), way.end(), [&](Index p) { return from_root_mm_[at(p)] <= arc; });
    return points_[at(below == way.end() ? way.back() : *below)].centre_mm;
  };
  const std::size_t rungs = std::clamp<std::size_t>(std::max(a.size(), b.size()), 4, 64);
  for (std::size_t k = 0; k < rungs; ++k) {
    const double part =
        first_rung + (last_rung - first_rung) * static_cast<double>(k) / static_cast<double>(rungs - 1);
    if (!lumen_.sees(place(a, part), place(b, part))) return true;
  }
  return false;
}

/// A limb that ends at the bridge is prolonged; else a new one leads across. It ends in the other limb.
void TreeGrowth::add_bridge(const Bridge& bridge) {
  const auto tip_of = [&](Index point) {
    return std::find_if(tips_.begin(), tips_.end(), [&](const Tip& tip) {
      return tip.point == point && tip.opening == 0 && tip.rejoins < 0;
    });
  };
  Index from = bridge.from;
  Index to = bridge.to;
  Index from_node = bridge.from_node;
  Index to_node = bridge.to_node;
  if (tip_of(from) == tips_.end() && tip_of(to) != tips_.end()) {
    std::swap(from, to);
    std::swap(from_node, to_node);
  }
  std::vector<Index> path;
  for (Index n = from_node; n >= 0 && beyond_mm_[at(n)] > 0.0; n = from_[at(n)]) path.push_back(n);
  std::reverse(path.begin(), path.end());
  for (Index n = to_node; n >= 0 && beyond_mm_[at(n)] > 0.0; n = from_[at(n)]) path.push_back(n);
  path.push_back(points_[at(to)].node);
  const auto far_tip = tip_of(to);
  if (far_tip != tips_.end()) far_tip->rejoins = from;
  const auto tip = tip_of(from);
  Index parent = from;
  for (Index n : path) {
    if (n == points_[at(parent)].node) continue;
    add_point(n, parent, points_[at(parent)].node, n);
    parent = static_cast<Index>(points_.size() - 1);
  }
  if (tip != tips_.end())
    *tip = {parent, 0, to};
  else
    tips_.push_back({parent, 0, to});
}

void TreeGrowth::close_loops() {
  std::pair<Index, Index> closed{-1, -1};
  for (const Bridge& bridge : bridges()) {
    if (bridge.limbs == closed || !around_tissue(bridge)) continue;
    closed = bridge.limbs;  // one cut for each pair of limbs
    add_bridge(bridge);
  }
}

}  // namespace endowire::vessel

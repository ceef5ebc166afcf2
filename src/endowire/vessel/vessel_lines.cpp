#include "endowire/vessel/vessel_lines.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

/// Directions at a bifurcation are taken this many radii away from it, outside its own ball.
constexpr double look_radii = 2.0;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Which branch goes on at each fork, for a whole grown tree.
class Splitter {
 public:
  explicit Splitter(const TreeGrowth& growth)
      : points_(growth.points()),
        tips_(growth.tips()),
        children_(points_.size()),
        tip_of_(points_.size(), -1),
        line_of_(points_.size(), -1),
        place_on_line_(points_.size(), 0),
        far_mm_(points_.size(), 0.0),
        far_child_(points_.size(), -1) {
    for (std::size_t t = 0; t < tips_.size(); ++t) tip_of_[at(tips_[t].point)] = static_cast<Index>(t);
    for (std::size_t p = 1; p < points_.size(); ++p)
      children_[at(points_[p].parent)].push_back(static_cast<Index>(p));
    for (std::size_t p = points_.size(); p-- > 1;) {  // children stand behind their parents
      const auto parent = at(points_[p].parent);
      const double far = far_mm_[p] + (position(static_cast<Index>(p)) - position(points_[p].parent)).norm();
      if (far_child_[parent] >= 0 && far < far_mm_[parent]) continue;
      far_mm_[parent] = far;
      far_child_[parent] = static_cast<Index>(p);
    }
  }

  std::vector<VesselLine> split() {
    if (points_.size() < 2) return {};
    const Index main = continuation(0, 0);
    line_of_[0] = 0;
    starts_.push_back({0, main, -1});
    for (Index child : children_[0])
      if (child != main) starts_.push_back({0, child, 0});
    for (std::size_t next = 0; next < starts_.size();) follow(starts_[next++]);  // each may add more
    for (VesselLine& line : lines_) {
      if (!line.cut || line.rejoins < 0) continue;
      line.rejoins = line_of_[at(line.rejoins)];
    }
    return std::move(lines_);
  }

 private:
  struct Start {
    Index fork;   ///< the point that the line leaves
    Index first;  ///< its own first point
    Index parent_line;
  };

  [[nodiscard]] const Vector3d& position(Index p) const { return points_[at(p)].centre_mm; }
  [[nodiscard]] double radius(Index p) const { return points_[at(p)].radius_mm; }

  /// A point of a branch about `way_mm` behind a fork, along its longest continuation.
  [[nodiscard]] Index behind(Index first, const Vector3d& fork, double way_mm) const {
    Index p = first;
    while (far_child_[at(p)] >= 0 && (position(p) - fork).norm() < way_mm) p = far_child_[at(p)];
    return p;
  }

  /// The child that goes on: cosine of the turn and width decide together.
  [[nodiscard]] Index continuation(Index fork, Index first_of_line) const {
    const double way_mm = look_radii * radius(fork);
    Index back = fork;
    while (back != first_of_line && points_[at(back)].parent >= 0 &&
           (position(back) - position(fork)).norm() < way_mm)
      back = points_[at(back)].parent;
    const Vector3d along = (position(fork) - position(back)).stableNormalized();
    Index best = -1;
    double best_score = -1.0;
    for (Index child : children_[at(fork)]) {
      const Index there = behind(child, position(fork), way_mm);
      const double cosine = along.dot((position(there) - position(fork)).stableNormalized());
      // A sac is wider than the vessel it sits on, but no continuation: more than the same width does not count.
      const double width = std::min(radius(there), radius(fork)) + 0.1 * radius(there);
      const double score = width * (1.0 + cosine);
      if (score <= best_score) continue;
      best_score = score;
      best = child;
    }
    return best;
  }

  void follow(const Start start) {
    const auto index = static_cast<Index>(lines_.size());
    VesselLine line;
    line.parent = start.parent_line;
    line.leaves_at = place_on_line_[at(start.fork)];
    line.path_mm.push_back(position(start.fork));
    Index p = start.first;
    for (;;) {
      line_of_[at(p)] = index;
      place_on_line_[at(p)] = line.path_mm.size();
      line.path_mm.push_back(position(p));
      if (children_[at(p)].empty()) break;
      const Index next = continuation(p, start.fork);
      for (Index child : children_[at(p)])
        if (child != next) starts_.push_back({p, child, index});
      p = next;
    }
    if (tip_of_[at(p)] >= 0) {
      const TreeGrowth::Tip& tip = tips_[at(tip_of_[at(p)])];
      line.opening = tip.opening;
      line.cut = tip.rejoins >= 0;
      line.rejoins = tip.rejoins;
    }
    lines_.push_back(std::move(line));
  }

  const std::vector<TreeGrowth::Point>& points_;
  const std::vector<TreeGrowth::Tip>& tips_;
  std::vector<std::vector<Index>> children_;
  std::vector<Index> tip_of_;
  std::vector<Index> line_of_;  ///< of each point
  std::vector<std::size_t> place_on_line_;
  std::vector<double> far_mm_;    ///< from a point to the furthest tip behind it
  std::vector<Index> far_child_;  ///< towards that tip
  std::vector<Start> starts_;
  std::vector<VesselLine> lines_;
};

}  // namespace

std::vector<VesselLine> vessel_lines(const TreeGrowth& growth) {
  return Splitter(growth).split();
}

}  // namespace endowire::vessel

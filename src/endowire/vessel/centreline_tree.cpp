#include "endowire/vessel/centreline_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr double unreachable_mm = std::numeric_limits<double>::infinity();
constexpr std::size_t stack_size = 128;  // depth of a median-split tree of 2³¹ segments is below 64

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

double box_distance_mm(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(Vector3d::Zero()).norm();
}

}  // namespace

CentrelineTree::CentrelineTree(std::vector<CentrelineBranch> branches, std::vector<CentrelinePoint> points,
                               std::vector<CentrelineBifurcation> bifurcations,
                               std::vector<CentrelineEnd> ends, const std::string& label)
    : branches_(std::move(branches)),
      points_(std::move(points)),
      bifurcations_(std::move(bifurcations)),
      ends_(std::move(ends)) {
  validate(label);
  branch_of_.resize(points_.size());
  depth_.resize(branches_.size(), 0);
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const CentrelineBranch& branch = branches_[b];
    if (branch.parent >= 0) depth_[b] = depth_[at(branch.parent)] + 1;
    for (std::size_t i = 0; i < branch.points; ++i)
      branch_of_[branch.first_point + i] = static_cast<Index>(b);
    for (std::size_t i = 0; i + 1 < branch.points; ++i)
      order_.push_back(static_cast<Index>(branch.first_point + i));
  }
  build_boxes();
}

std::span<const CentrelinePoint> CentrelineTree::points_of(Index branch) const {
  const CentrelineBranch& b = branches_[at(branch)];
  return std::span(points_).subspan(b.first_point, b.points);
}

Index CentrelineTree::branch_named(const std::string& name) const {
  const auto found = std::find_if(branches_.begin(), branches_.end(),
                                  [&](const CentrelineBranch& branch) { return branch.name == name; });
  return found == branches_.end() ? -1 : static_cast<Index>(found - branches_.begin());
}

// --- the nearest place

void CentrelineTree::build_boxes() {
  boxes_.reserve(order_.size());
  if (!order_.empty()) build_boxes(0, static_cast<Index>(order_.size()));
}

Index CentrelineTree::build_boxes(Index begin, Index end) {
  Box box{Vector3d::Constant(std::numeric_limits<double>::infinity()),
          Vector3d::Constant(-std::numeric_limits<double>::infinity()), 0.0, begin, end - begin};
  for (Index i = begin; i < end; ++i) {
    for (std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      const CentrelinePoint& p = points_[at(order_[at(i)]) + k];
      box.low = box.low.cwiseMin(p.position_mm);
      box.high = box.high.cwiseMax(p.position_mm);
      box.radius_mm = std::max(box.radius_mm, p.radius_mm);
    }
  }
  const auto index = static_cast<Index>(boxes_.size());
  boxes_.push_back(box);
  if (end - begin <= 4) return index;
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  const auto place = [&](Index i) {
    return points_[at(i)].position_mm[axis] + points_[at(i) + 1].position_mm[axis];
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](Index a, Index b) { return place(a) < place(b) || (place(a) == place(b) && a < b); });
  build_boxes(begin, middle);
  const Index right = build_boxes(middle, end);
  boxes_[at(index)].first = right;
  boxes_[at(index)].count = 0;
  return index;
}

CentrelineTree::Foot CentrelineTree::foot_on(Index segment, const Vector3d& point_mm) const {
  const CentrelinePoint& a = points_[at(segment)];
  const CentrelinePoint& b = points_[at(segment) + 1];
  const Vector3d chord = b.position_mm - a.position_mm;
  Foot foot;
  foot.part = std::clamp((point_mm - a.position_mm).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
  foot.distance_mm = (point_mm - a.position_mm - foot.part * chord).norm();
  foot.score_mm = foot.distance_mm - ((1.0 - foot.part) * a.radius_mm + foot.part * b.radius_mm);
  foot.segment = segment;
  return foot;
}

/// Along the branch to where the point is nearest: balls that grow along a branch do not pull the foot.
CentrelineTree::Foot CentrelineTree::descend(Foot foot, const Vector3d& point_mm) const {
  const CentrelineBranch& branch = branches_[at(branch_of_[at(foot.segment)])];
  const auto first = static_cast<Index>(branch.first_point);
  const Index last = first + static_cast<Index>(branch.points) - 2;
  for (Index step : {-1, 1}) {
    while (foot.segment + step >= first && foot.segment + step <= last) {
      const Foot next = foot_on(foot.segment + step, point_mm);
      if (next.distance_mm >= foot.distance_mm) break;
      foot = next;
    }
  }
  return foot;
}

NearestCentreline CentrelineTree::nearest(const Vector3d& point_mm, const CentrelinePlace& hint) const {
  NearestCentreline result;
  if (boxes_.empty()) return result;
  Foot best;
  const auto visit = [&](Index segment) {
    const Foot foot = foot_on(segment, point_mm);
    if (foot.score_mm < best.score_mm || (foot.score_mm == best.score_mm && segment < best.segment))
      best = foot;
  };
  if (hint.branch >= 0 && at(hint.branch) < branches_.size()) visit(static_cast<Index>(segment_at(hint)));
  struct Entry {
    Index box;
    double bound_mm;
  };
  const auto bound = [&](Index box) {
    return box_distance_mm(point_mm, boxes_[at(box)].low, boxes_[at(box)].high) - boxes_[at(box)].radius_mm;
  };
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = {0, bound(0)};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.bound_mm > best.score_mm) continue;
    const Box& box = boxes_[at(entry.box)];
    if (box.count > 0) {
      for (Index i = box.first; i < box.first + box.count; ++i) visit(order_[at(i)]);
      continue;
    }
    const Entry left{entry.box + 1, bound(entry.box + 1)};
    const Entry right{box.first, bound(box.first)};
    const bool left_first = left.bound_mm <= right.bound_mm;
    stack[top++] = left_first ? right : left;
    stack[top++] = left_first ? left : right;
  }
  best = descend(best, point_mm);
  const CentrelinePoint& a = points_[at(best.segment)];
  const CentrelinePoint& b = points_[at(best.segment) + 1];
  result.place = {branch_of_[at(best.segment)], a.arc_mm + best.part * (b.arc_mm - a.arc_mm)};
  result.radius_mm = (1.0 - best.part) * a.radius_mm + best.part * b.radius_mm;
  result.offset_mm = best.distance_mm;
  return result;
}

// --- along branches

/// First point of the segment that holds a place.
std::size_t CentrelineTree::segment_at(const CentrelinePlace& place) const {
  const CentrelineBranch& branch = branches_[at(place.branch)];
  const auto first = points_.begin() + static_cast<std::ptrdiff_t>(branch.first_point);
  const auto above =
      std::upper_bound(first + 1, first + static_cast<std::ptrdiff_t>(branch.points) - 1, place.arc_mm,
                       [](double arc, const CentrelinePoint& p) { return arc < p.arc_mm; });
  return static_cast<std::size_t>(above - points_.begin()) - 1;
}

CentrelineState CentrelineTree::state_at(const CentrelinePlace& place) const {
  const std::size_t segment = segment_at(place);
  const CentrelinePoint& a = points_[segment];
  const CentrelinePoint& b = points_[segment + 1];
  const double length = b.arc_mm - a.arc_mm;
  const double f = std::clamp((place.arc_mm - a.arc_mm) / length, 0.0, 1.0);
  const double g = 1.0 - f;
  CentrelineState state;
  // Hermite: p = a (1 + 2f) g² + b (1 + 2g) f² + l f g (t_a g − t_b f)
  state.position_mm = (1.0 + 2.0 * f) * g * g * a.position_mm + (1.0 + 2.0 * g) * f * f * b.position_mm +
                      length * f * g * (g * a.tangent - f * b.tangent);
  state.tangent = (6.0 * f * g * (b.position_mm - a.position_mm) +
                   length * (g * (1.0 - 3.0 * f) * a.tangent + f * (3.0 * f - 2.0) * b.tangent))
                      .stableNormalized();
  state.curvature_per_mm = g * a.curvature_per_mm + f * b.curvature_per_mm;
  state.radius_mm = g * a.radius_mm + f * b.radius_mm;
  return state;
}

Index CentrelineTree::lumen_branch(const CentrelinePlace& place) const {
  Index branch = place.branch;
  double arc = place.arc_mm;
  while (branches_[at(branch)].parent >= 0 && arc < branches_[at(branch)].ostium_arc_mm) {
    branch = branches_[at(branch)].parent;
    arc = branches_[at(branch)].length_mm;
  }
  return branch;
}

Index CentrelineTree::branch_at(const Vector3d& point_mm) const {
  return branches_.empty() ? -1 : lumen_branch(nearest(point_mm).place);
}

double CentrelineTree::from_root_mm(const CentrelinePlace& place) const {
  const CentrelineBranch& branch = branches_[at(place.branch)];
  return branch.from_root_mm + std::clamp(place.arc_mm, 0.0, branch.length_mm);
}

// --- along ways

/// The last branch on the ways from the root to both; -1: they have none in common.
Index CentrelineTree::fork_of(Index a, Index b) const {
  while (a != b && a >= 0 && b >= 0) {
    if (depth_[at(a)] >= depth_[at(b)])
      a = branches_[at(a)].parent;
    else
      b = branches_[at(b)].parent;
  }
  return a == b ? a : -1;
}

double CentrelineTree::distance_mm(const CentrelinePlace& from, const CentrelinePlace& to) const {
  const double a = from_root_mm(from);
  const double b = from_root_mm(to);
  const Index fork = fork_of(from.branch, to.branch);
  if (fork == from.branch || fork == to.branch) return fork < 0 ? unreachable_mm : std::abs(a - b);
  if (fork < 0) return unreachable_mm;
  return a + b - 2.0 * (branches_[at(fork)].from_root_mm + branches_[at(fork)].length_mm);
}

CentrelineTurn CentrelineTree::next_turn(const CentrelinePlace& from, const CentrelinePlace& to) const {
  const Index fork = fork_of(from.branch, to.branch);
  if (fork < 0) return {-1, unreachable_mm};
  if (from.branch == to.branch) return {-1, distance_mm(from, to)};
  const CentrelineBranch& branch = branches_[at(from.branch)];
  const double arc = std::clamp(from.arc_mm, 0.0, branch.length_mm);
  // Down towards the root until the fork; there, and from then on, up towards the goal.
  if (fork != from.branch && branch.parent != fork) return {branch.parent, arc};
  if (fork != from.branch && fork == to.branch) return {fork, arc};
  Index next = to.branch;
  while (branches_[at(next)].parent != fork) next = branches_[at(next)].parent;
  return {next, fork == from.branch ? branch.length_mm - arc : arc};
}

std::vector<Index> CentrelineTree::route(const CentrelinePlace& from, const CentrelinePlace& to) const {
  std::vector<Index> way;
  const Index fork = fork_of(from.branch, to.branch);
  if (fork < 0) return way;
  for (Index b = from.branch; b != fork; b = branches_[at(b)].parent) way.push_back(b);
  if (fork == from.branch || fork == to.branch) way.push_back(fork);
  const auto middle = static_cast<std::ptrdiff_t>(way.size());
  for (Index b = to.branch; b != fork; b = branches_[at(b)].parent) way.push_back(b);
  std::reverse(way.begin() + middle, way.end());
  return way;
}

void CentrelineTree::look(Index branch, double from_mm, double to_mm, CentrelineAhead& ahead) const {
  const double low = std::min(from_mm, to_mm);
  const double high = std::max(from_mm, to_mm);
  const auto meet = [&](const Vector3d& curvature_per_mm, double radius_mm) {
    ahead.max_curvature_per_mm = std::max(ahead.max_curvature_per_mm, curvature_per_mm.norm());
    ahead.min_radius_mm = std::min(ahead.min_radius_mm, radius_mm);
  };
  for (double arc : {low, high}) {
    const CentrelineState state = state_at({branch, arc});
    meet(state.curvature_per_mm, state.radius_mm);
  }
  const std::size_t end = branches_[at(branch)].first_point + branches_[at(branch)].points;
  for (std::size_t i = segment_at({branch, low}) + 1; i < end && points_[i].arc_mm < high; ++i)
    meet(points_[i].curvature_per_mm, points_[i].radius_mm);
  ahead.length_mm += high - low;
}

CentrelineAhead CentrelineTree::ahead(const CentrelinePlace& from, const CentrelinePlace& to,
                                      double length_mm) const {
  CentrelineAhead ahead;
  CentrelinePlace here = from;
  double left_mm = distance_mm(from, to);
  if (left_mm == unreachable_mm) return ahead;
  left_mm = std::min(left_mm, length_mm);
  for (std::size_t guard = 0; guard <= 2 * branches_.size(); ++guard) {
    const CentrelineBranch& branch = branches_[at(here.branch)];
    here.arc_mm = std::clamp(here.arc_mm, 0.0, branch.length_mm);
    const CentrelineTurn turn = next_turn(here, to);
    const double way_mm = std::min(left_mm, turn.distance_mm);
    const bool outward =
        here.branch == to.branch ? to.arc_mm >= here.arc_mm : fork_of(here.branch, to.branch) == here.branch;
    look(here.branch, here.arc_mm, here.arc_mm + (outward ? way_mm : -way_mm), ahead);
    left_mm -= way_mm;
    if (turn.branch < 0 || left_mm <= 0.0) break;
    const bool enters_at_end = turn.branch == branch.parent;
    here = {turn.branch, enters_at_end ? branches_[at(turn.branch)].length_mm : 0.0};
  }
  return ahead;
}

}  // namespace endowire::vessel

#include "endowire/vessel/tree_growth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "endowire/vessel/ridge.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A path joins the tree this near to a tree point, in its radii: paths that run side by side become one.
/// Larger values join branches before their lumens meet, smaller ones leave parallel twins.
constexpr double core_part = 0.5;

// What sticks out of the tree is a branch, not a bump of the wall, by its length L beyond the tree, its own radius
// r, and that of the lumen it leaves, R. It must be closed all round: a tube or a sac, not the rim of a slit.
//   a vessel           L ≥ 3 r, closed over 2.2 r; r where it is closed: its ostium may flare
//   a sac, a short one L ≥ 1.8 r and L ≥ 0.8 R, closed where it is widest
//   a wide stump       L ≥ 1.3 r and L ≥ 0.95 R and r ≥ 0.65 R, round where it is widest: a vessel cut off
//                      soon behind a bifurcation
// The rim of an oval 2 : 1 reaches L = 1.2 r, the rim of a cut tube 0.4 r; a pointed bump of half angle α reaches
// r / sin α but little of R. Lower values turn facets of coarse meshes into twigs, higher ones lose stumps.
constexpr double vessel_length = 3.0;
constexpr double closed_length = 2.2;
constexpr double sac_length = 1.8;
constexpr double sac_length_of_parent = 0.8;
constexpr double stump_length = 1.3;
constexpr double stump_length_of_parent = 0.95;
constexpr double stump_radius_of_parent = 0.65;

/// Across a branch no ray runs further than this many radii; along a flat, slit-like lumen they do.
constexpr double max_ray_per_radius = 3.0;
constexpr double round_ray_per_radius = 1.7;  // across a stump: in the rim of an oval 2 : 1 1.8

/// The ball that fills the end of a lumen is looked for within this many of its radii from the point of the wall
/// that sticks out furthest; of equal ones, the nearest. From the rim of a flat cap it is 1.4 radii away, from that of
/// an oval 2 : 1 2.2. Too far in does no harm, the ridge is followed outward from there; too far out is off the axis.
constexpr double end_radii = 3.0;
constexpr double closing_slope = 0.05;

/// From there a tip goes on along the ridge: in the direction of its last three radii, at most some 20 radii.
constexpr double direction_radii = 3.0;
constexpr int max_steps_to_cap = 40;
constexpr double closing_part = 0.5;  // of the radius: a lumen that tapers to this is at its end
constexpr double way_ahead = 1.1;     // radii: nearer, the ball touches the cap though a side wall is as near
constexpr double wall_ahead = 0.5;    // cosine: the nearest wall is a cap when it lies within 60° of the way

/// How far beside a node the ridge is looked for, in the node's radii.
constexpr double climb_part = 0.5;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

TreeGrowth::TreeGrowth(const LumenSpace& lumen, const LumenGraph& graph, const End& root)
    : lumen_(lumen),
      graph_(graph),
      toward_(graph.size(), -2),
      beyond_mm_(graph.size(), unbounded),
      owner_(graph.size(), -1),
      from_(graph.size(), -1),
      ball_(graph.size(), -1) {
  find_paths(root.node);
  points_.push_back({root.node, -1, root.centre_mm, root.radius_mm});
  from_root_mm_.push_back(0.0);
  cover(0);
}

/// @param before, after  nodes that tell the direction of the path: the ridge is looked for across it
void TreeGrowth::add_point(Index node, Index parent, Index before, Index after) {
  const Vector3d& place = graph_[node].position_mm;
  const Vector3d along = (graph_[after].position_mm - graph_[before].position_mm).stableNormalized();
  RidgePoint ridge{place, radius_mm(node), false};
  if (!along.isZero()) ridge = climb_to_ridge(lumen_, place, along, climb_part * radius_mm(node));
  from_root_mm_.push_back(from_root_mm_[at(parent)] + way_mm(node, points_[at(parent)].node));
  points_.push_back({node, parent, ridge.position_mm, ridge.radius_mm});
}

void TreeGrowth::find_paths(Index root) {
  std::vector<double> cost(graph_.size(), unbounded);
  std::priority_queue<Nearer> front;
  cost[at(root)] = 0.0;
  toward_[at(root)] = -1;
  front.push({0.0, root});
  while (!front.empty()) {
    const Nearer next = front.top();
    front.pop();
    if (next.value > cost[at(next.node)]) continue;
    for (Index n : graph_.neighbours(next.node)) {
      const double value = next.value + way_mm(next.node, n) / (radius_mm(next.node) * radius_mm(n));
      if (value >= cost[at(n)]) continue;
      cost[at(n)] = value;
      toward_[at(n)] = next.node;
      front.push({value, n});
    }
  }
}

bool TreeGrowth::lower(Index node, double beyond_mm, Index owner, Index from) {
  if (beyond_mm >= beyond_mm_[at(node)]) return false;
  beyond_mm_[at(node)] = beyond_mm;
  owner_[at(node)] = owner;
  from_[at(node)] = from;
  return true;
}

/// E inside the ball of a point: nodes in one inscribed ball see each other, so straight distances count.
void TreeGrowth::cover_ball(Index point, std::priority_queue<Nearer>& front) {
  const Point& p = points_[at(point)];
  const auto beyond = [&](Index node) {
    return (graph_[node].position_mm - p.centre_mm).norm() - p.radius_mm;
  };
  std::vector<Index> open{p.node};
  ball_[at(p.node)] = point;
  while (!open.empty()) {
    const Index node = open.back();
    open.pop_back();
    const double value = beyond(node);
    if (lower(node, value, point, -1)) front.push({value, node});
    for (Index n : graph_.neighbours(node)) {
      if (ball_[at(n)] == point || beyond(n) > 0.0) continue;
      ball_[at(n)] = point;
      open.push_back(n);
    }
  }
}

/// Lowers E around the points from `first_point` on.
void TreeGrowth::cover(Index first_point) {
  std::priority_queue<Nearer> front;
  for (Index p = first_point; at(p) < points_.size(); ++p) cover_ball(p, front);
  while (!front.empty()) {
    const Nearer next = front.top();
    front.pop();
    if (next.value > beyond_mm_[at(next.node)]) continue;
    if (next.value > 0.0) outer_.push({next.value, next.node});
    for (Index n : graph_.neighbours(next.node)) {
      const double value = next.value + way_mm(next.node, n);
      if (lower(n, value, owner_[at(next.node)], next.node)) front.push({value, n});
    }
  }
}

/// The tree point in whose core a node lies; -1: in none.
Index TreeGrowth::core_at(Index node) const {
  if (beyond_mm_[at(node)] > -core_part * radius_mm(node) / (1.0 + core_part)) return -1;  // too far from any
  Index best = -1;
  double best_part = core_part;
  for (Index p = 0; at(p) < points_.size(); ++p) {
    const double part =
        (points_[at(p)].centre_mm - graph_[node].position_mm).norm() / points_[at(p)].radius_mm;
    if (part >= best_part) continue;
    best_part = part;
    best = p;
  }
  return best;
}

/// Nodes from `node` on until the tree begins at its point `joins`.
std::vector<Index> TreeGrowth::path_to_tree(Index node, Index& joins) const {
  std::vector<Index> path;
  joins = -1;
  for (Index n = node; n >= 0; n = toward_[at(n)]) {
    joins = core_at(n);
    if (joins >= 0) break;
    path.push_back(n);
  }
  if (joins < 0) joins = 0;  // it came to the root itself
  return path;
}

bool TreeGrowth::add(const End& end) {
  Index joins = -1;
  const std::vector<Index> path = path_to_tree(end.node, joins);
  if (path.empty()) return false;
  add_path(path, joins, end.opening);
  return true;
}

void TreeGrowth::add_path(const std::vector<Index>& path, Index joins, int opening) {
  const auto first_point = static_cast<Index>(points_.size());
  Index parent = joins;
  for (std::size_t i = path.size(); i-- > 0;) {
    const Index before = i + 1 < path.size() ? path[i + 1] : points_[at(joins)].node;
    add_point(path[i], parent, before, path[i > 0 ? i - 1 : i]);
    parent = static_cast<Index>(points_.size() - 1);
  }
  if (opening == 0) parent = follow_ridge(parent);
  tips_.push_back({parent, opening, -1});
  cover(first_point);
}

/// Node nearest to a place, downhill from another.
Index TreeGrowth::walk_to(Index node, const Vector3d& place_mm) const {
  double least = (graph_[node].position_mm - place_mm).squaredNorm();
  for (bool nearer = true; nearer;) {
    nearer = false;
    const Index from = node;
    for (Index n : graph_.neighbours(from)) {
      const double distance = (graph_[n].position_mm - place_mm).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      node = n;
      nearer = true;
    }
  }
  return node;
}

/// Direction of the tree towards a point, over direction_radii of its radius; zero at the root.
Vector3d TreeGrowth::direction_at(Index point) const {
  const Point& p = points_[at(point)];
  Index back = point;
  while (points_[at(back)].parent >= 0 &&
         (points_[at(back)].centre_mm - p.centre_mm).norm() < direction_radii * p.radius_mm)
    back = points_[at(back)].parent;
  return (p.centre_mm - points_[at(back)].centre_mm).stableNormalized();
}

/// A tip to the middle of its lumen, then on along the ridge until the inscribed ball touches the cap: the nearest
/// wall lies ahead. Not into what the tree covers already. Returns the last point.
Index TreeGrowth::follow_ridge(Index tip) {
  for (int climb = 0; climb < 3; ++climb) {
    const Vector3d direction = direction_at(tip);
    if (direction.isZero()) return tip;
    Point& p = points_[at(tip)];
    const RidgePoint ridge = climb_to_ridge(lumen_, p.centre_mm, direction, climb_part * p.radius_mm);
    p.centre_mm = ridge.position_mm;
    p.radius_mm = ridge.radius_mm;
    p.node = walk_to(p.node, p.centre_mm);
    if (ridge.settled) break;
  }
  const double least_mm = closing_part * points_[at(tip)].radius_mm;
  for (int guard = 0; guard < max_steps_to_cap; ++guard) {
    const Point from = points_[at(tip)];
    const Vector3d direction = direction_at(tip);
    RidgePoint next;
    double step_mm = 0.5 * from.radius_mm;
    for (; step_mm > 0.1 * from.radius_mm; step_mm *= 0.5) {
      next = climb_to_ridge(lumen_, from.centre_mm + step_mm * direction, direction,
                            climb_part * from.radius_mm);
      if (!next.settled || next.radius_mm < least_mm || !lumen_.sees(from.centre_mm, next.position_mm))
        continue;
      const Vector3d to_wall = lumen_.at(next.position_mm).nearest_mm - next.position_mm;
      if (to_wall.dot(direction) <= wall_ahead * next.radius_mm &&
          lumen_.free_way_mm(next.position_mm, direction) >= way_ahead * next.radius_mm)
        break;
    }
    if (step_mm <= 0.1 * from.radius_mm) return tip;
    const Index node = walk_to(from.node, next.position_mm);
    if (beyond_mm_[at(node)] < 0.0 || (graph_[node].position_mm - next.position_mm).norm() > next.radius_mm)
      return tip;
    from_root_mm_.push_back(from_root_mm_[at(tip)] + (next.position_mm - from.centre_mm).norm());
    points_.push_back({node, tip, next.position_mm, next.radius_mm});
    tip = static_cast<Index>(points_.size() - 1);
  }
  return tip;
}

void TreeGrowth::search() {
  while (!outer_.empty()) {
    const Outer outer = outer_.top();
    outer_.pop();
    if (outer.beyond_mm != beyond_mm_[at(outer.node)] || !reached(outer.node) || !sticks_out_most(outer.node))
      continue;
    std::vector<Index> sticking_out;  // the part of its path beyond the tree
    for (Index n = outer.node; n >= 0 && beyond_mm_[at(n)] > 0.0; n = toward_[at(n)])
      sticking_out.push_back(n);
    if (!is_branch(sticking_out, outer.beyond_mm, points_[at(owner_[at(outer.node)])].radius_mm)) continue;
    Index joins = -1;
    std::vector<Index> path = path_to_tree(end_ball(outer.node), joins);
    // Beside a cap the middle of the lumen is hard to tell: the last radius is left to the walk along the ridge.
    const Index ball = path.empty() ? -1 : path.front();
    const auto clear = std::find_if(path.begin(), path.end(), [&](Index n) {
      return way_mm(n, ball) >= radius_mm(ball) || beyond_mm_[at(n)] <= 0.0;
    });
    if (clear != path.end() && beyond_mm_[at(*clear)] > 0.0) path.erase(path.begin(), clear);
    if (!path.empty()) add_path(path, joins, 0);
  }
}

/// True where no neighbour sticks out further, by more than a cell: less the graph does not resolve.
bool TreeGrowth::sticks_out_most(Index node) const {
  const double beyond = beyond_mm_[at(node)];
  const std::span<const Index> around = graph_.neighbours(node);
  return beyond > graph_[node].cell_mm && std::none_of(around.begin(), around.end(), [&](Index n) {
           return beyond_mm_[at(n)] > beyond || (beyond_mm_[at(n)] == beyond && n < node);
         });
}

/// The node of the ball that fills the end behind a node at the wall: of what sticks out near by, the largest
/// radius less closing_slope of the way from there. The way to the tree itself would lead into a corner of the cap.
Index TreeGrowth::end_ball(Index extreme) {
  const Vector3d& from = graph_[extreme].position_mm;
  std::priority_queue<Nearer> front;  // by distance from the extreme
  front.push({0.0, extreme});
  ball_[at(extreme)] = -2;
  std::vector<Index> seen{extreme};
  double widest_mm =
      std::max(radius_mm(extreme), graph_[extreme].cell_mm);  // a lumen is wider than its cells
  double best = radius_mm(extreme);
  Index ball = extreme;
  while (!front.empty()) {
    const Nearer next = front.top();
    front.pop();
    if (next.value > end_radii * widest_mm) break;
    widest_mm = std::max(widest_mm, radius_mm(next.node));
    const double score = radius_mm(next.node) - closing_slope * next.value;
    if (score > best) {
      best = score;
      ball = next.node;
    }
    for (Index n : graph_.neighbours(next.node)) {
      if (ball_[at(n)] == -2 || beyond_mm_[at(n)] <= 0.0) continue;
      ball_[at(n)] = -2;
      seen.push_back(n);
      front.push({(graph_[n].position_mm - from).norm(), n});
    }
  }
  for (Index n : seen) ball_[at(n)] = -1;
  return ball;
}

/// Of the ridge along what sticks out: the radius where it is closed all round, and where it is widest.
bool TreeGrowth::is_branch(const std::vector<Index>& path, double length_mm, double parent_radius_mm) const {
  constexpr std::size_t places = 10;
  const std::size_t count = path.size();
  double widest_mm = 0.0;
  bool widest_is_round = false;
  double closed_mm = 0.0;
  double closed_length_mm = 0.0;  // from the end to where it is closed last
  for (std::size_t i = 0; i < count; i += std::max<std::size_t>(1, count / places)) {
    const Vector3d along =
        (graph_[path[std::min(i + 2, count - 1)]].position_mm - graph_[path[i < 2 ? 0 : i - 2]].position_mm)
            .stableNormalized();
    if (along.isZero()) continue;
    const RidgePoint ridge =
        climb_to_ridge(lumen_, graph_[path[i]].position_mm, along, climb_part * radius_mm(path[i]));
    const double within_mm = max_ray_per_radius * ridge.radius_mm;
    if (ridge.radius_mm > widest_mm) {
      widest_mm = ridge.radius_mm;
      widest_is_round = closed_around(ridge.position_mm, along, round_ray_per_radius * ridge.radius_mm);
    }
    if (!closed_around(ridge.position_mm, along, within_mm)) continue;
    closed_mm = std::max(closed_mm, ridge.radius_mm);
    closed_length_mm = way_mm(path[0], path[i]);
  }
  if (closed_mm == 0.0) return false;
  if (length_mm >= vessel_length * closed_mm && closed_length_mm >= closed_length * closed_mm) return true;
  if (closed_mm == widest_mm && length_mm >= sac_length * widest_mm &&
      length_mm >= sac_length_of_parent * parent_radius_mm)
    return true;
  return widest_is_round && length_mm >= stump_length * widest_mm &&
         length_mm >= stump_length_of_parent * parent_radius_mm &&
         widest_mm >= stump_radius_of_parent * parent_radius_mm;
}

/// True where rays across a direction all end near by.
bool TreeGrowth::closed_around(const Vector3d& centre_mm, const Vector3d& along, double within_mm) const {
  constexpr int rays = 8;
  const Vector3d across = along.unitOrthogonal();
  for (int k = 0; k < rays; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / rays;
    const Vector3d direction = std::cos(angle) * across + std::sin(angle) * along.cross(across);
    if (lumen_.free_way_mm(centre_mm, direction) > within_mm) return false;
  }
  return true;
}

}  // namespace endowire::vessel

#pragma once

#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "endowire/vessel/lumen_graph.hpp"

namespace endowire::vessel {

/// A tree of graph nodes that grows from a root by least-cost paths: where branches are and how they join.
///
///   path     argmin ∫ ds/φ²,   along an edge |c₁ − c₂| / (φ₁ φ₂)    runs along the ridge of φ
///   beyond   E(v) = |v − c_i| − φ_i within a ball of the tree, else E = min (E of a neighbour + way from it)
///
/// A path ends where it enters the core of the tree: within core_part of a tree point's radius of it.
/// What sticks out of the tree far enough, and is closed all round like a tube, leads to an end; the point that
/// sticks out furthest is taken first. Ways are measured in the graph, so tissue between two vessels is never
/// passed.
///
/// Source     the cost and the walk from the ends to a root after [Antiga 2003]; the search for what the tree
///            leaves uncovered after [Sato 2000].
/// Departure  [Sato 2000] takes the point furthest from the root and a cover of fixed scale; here it is
///            the point furthest out of the inscribed balls, judged by its own radius, so that oval vessels
///            and corners of a mesh grow no twigs while fine vessels on wide ones count.
class TreeGrowth {
 public:
  /// Where the lumen ends.
  struct End {
    std::int32_t node;          ///< beside the last place on the ridge
    int opening;                ///< its number; 0: the lumen is closed there
    Eigen::Vector3d centre_mm;  ///< that place
    double radius_mm;           ///< and the radius there
  };
  struct Point {
    std::int32_t node;
    std::int32_t parent;        ///< index of a point; -1: the root
    Eigen::Vector3d centre_mm;  ///< on the ridge beside the node ...
    double radius_mm;           ///< ... and the radius there
  };
  struct Tip {
    std::int32_t point;
    int opening;           ///< as in End
    std::int32_t rejoins;  ///< point of the tree where a loop was cut here; -1: it is an end, if it is a leaf
  };

  TreeGrowth(const LumenSpace& lumen, const LumenGraph& graph, const End& root);

  /// Adds the path from a node. False when nothing of it is new.
  bool add(const End& end);

  /// Finds ends until nothing sticks out, adding each.
  void search();

  /// Adds what closes a loop around tissue, as tips that rejoin the tree.
  void close_loops();

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const std::vector<Tip>& tips() const { return tips_; }

  /// True when a way leads from the root to the node.
  [[nodiscard]] bool reached(std::int32_t node) const {
    return toward_[static_cast<std::size_t>(node)] >= -1;
  }

 private:
  /// An edge of the graph between two parts of the tree: there a loop of the lumen closes.
  struct Bridge {
    std::int32_t from, to;                        ///< points of the tree
    std::int32_t from_node, to_node;              ///< the edge
    std::pair<std::int32_t, std::int32_t> limbs;  ///< the parts of the tree it joins, one number each
    double width_mm;                              ///< radius of the lumen at the edge
  };
  struct Outer {
    double beyond_mm;
    std::int32_t node;
    bool operator<(const Outer& o) const {
      return beyond_mm < o.beyond_mm || (beyond_mm == o.beyond_mm && node > o.node);
    }
  };
  struct Nearer {
    double value;
    std::int32_t node;
    bool operator<(const Nearer& o) const { return value > o.value || (value == o.value && node > o.node); }
  };

  [[nodiscard]] double radius_mm(std::int32_t node) const { return graph_[node].radius_mm; }
  [[nodiscard]] double way_mm(std::int32_t a, std::int32_t b) const {
    return (graph_[a].position_mm - graph_[b].position_mm).norm();
  }
  void find_paths(std::int32_t root);
  void add_point(std::int32_t node, std::int32_t parent, std::int32_t before, std::int32_t after);
  void cover(std::int32_t first_point);
  void cover_ball(std::int32_t point, std::priority_queue<Nearer>& front);
  bool lower(std::int32_t node, double beyond_mm, std::int32_t owner, std::int32_t from);
  [[nodiscard]] std::int32_t core_at(std::int32_t node) const;
  [[nodiscard]] std::vector<std::int32_t> path_to_tree(std::int32_t node, std::int32_t& joins) const;
  [[nodiscard]] bool sticks_out_most(std::int32_t node) const;
  [[nodiscard]] std::int32_t end_ball(std::int32_t extreme);
  [[nodiscard]] bool is_branch(const std::vector<std::int32_t>& path, double length_mm,
                               double parent_radius_mm) const;
  [[nodiscard]] bool closed_around(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& along,
                                   double within_mm) const;
  [[nodiscard]] std::int32_t walk_to(std::int32_t node, const Eigen::Vector3d& place_mm) const;
  [[nodiscard]] Eigen::Vector3d direction_at(std::int32_t point) const;
  [[nodiscard]] std::int32_t follow_ridge(std::int32_t tip);
  void add_path(const std::vector<std::int32_t>& path, std::int32_t joins, int opening);
  [[nodiscard]] std::vector<std::int32_t> limbs() const;
  [[nodiscard]] std::vector<Bridge> bridges() const;
  [[nodiscard]] std::int32_t fork_of(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] std::vector<std::int32_t> points_down_to(std::int32_t point, std::int32_t fork) const;
  [[nodiscard]] bool around_tissue(const Bridge& bridge) const;
  void add_bridge(const Bridge& bridge);

  const LumenSpace& lumen_;
  const LumenGraph& graph_;
  std::vector<std::int32_t> toward_;  ///< next node on the path to the root; -1 at the root, -2 not reached
  std::vector<double> beyond_mm_;     ///< E
  std::vector<std::int32_t> owner_;   ///< tree point that E counts from
  std::vector<std::int32_t> from_;    ///< node before on the way from the owner's ball; -1 inside it
  std::vector<Point> points_;
  std::vector<double> from_root_mm_;  ///< of each point, along the tree
  std::vector<Tip> tips_;
  std::priority_queue<Outer> outer_;  ///< candidates of the search
  std::vector<std::int32_t> ball_;    ///< point in whose ball a node was last found; scratch of end_ball
};

}  // namespace endowire::vessel

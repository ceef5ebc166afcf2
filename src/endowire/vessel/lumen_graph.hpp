#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "endowire/vessel/lumen_space.hpp"

namespace endowire::vessel {

/// Points inside the lumen, as dense as its width asks for, joined where no wall is between them.
///
/// An octree over the vessel is split until its cells are cells_per_radius times smaller than the lumen around
/// them; the centres of the cells that lie inside are the nodes. Two neighbouring cells are joined when their
/// centres' inscribed balls overlap,
///
///   |c₁ − c₂| ≤ ρ₁ + ρ₂ ,
///
/// so that the segment between them lies in the lumen whatever the signs of distances say: tissue is never
/// passed, however thin. The width of the lumen is half the chord along the inward normal of a triangle, the
/// median over its neighbours, so that a fine vessel beside a wide one is seen.
///
/// Nodes are ordered by place: the graph does not depend on the order of triangles.
class LumenGraph {
 public:
  struct Node {
    Eigen::Vector3d position_mm;
    double radius_mm;  ///< of the inscribed ball
    double reach_mm;   ///< the same, where the closure of openings counts as wall
    double cell_mm;    ///< edge of the cell
  };

  /// @param max_nodes  cells grow until no more than these are needed
  LumenGraph(const LumenSpace& lumen, double cells_per_radius, std::size_t max_nodes);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const Node& operator[](std::int32_t node) const {
    return nodes_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] std::span<const std::int32_t> neighbours(std::int32_t node) const {
    const auto n = static_cast<std::size_t>(node);
    return std::span(links_).subspan(first_link_[n], first_link_[n + 1] - first_link_[n]);
  }

 private:
  friend class LumenGraphBuilder;
  std::vector<Node> nodes_;
  std::vector<std::size_t> first_link_;
  std::vector<std::int32_t> links_;
};

}  // namespace endowire::vessel

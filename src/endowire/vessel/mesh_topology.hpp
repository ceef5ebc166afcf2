#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// One side of a triangle.
struct HalfEdge {
  std::int32_t low, high;  ///< vertices
  std::int32_t triangle;
  bool forward;  ///< runs from low to high in its triangle
};

/// All half-edges, those of one edge side by side.
[[nodiscard]] std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh);

/// @param visit  visit(first, last) for every edge
template <typename Visit>
void for_each_edge(const std::vector<HalfEdge>& edges, Visit visit) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    visit(&edges[i], &edges[i] + (j - i));
    i = j;
  }
}

/// A closed row of edges at which the mesh ends.
struct BoundaryLoop {
  std::vector<std::int32_t>
      vertices;           ///< along the boundary half-edges: the mesh lies to the left seen from outside
  std::int32_t triangle;  ///< one at the boundary
};

/// Boundary loops in the order of their smallest vertex, each beginning with it.
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh);

/// Middle of a loop, weighted by length: uneven points do not shift it.
[[nodiscard]] Eigen::Vector3d loop_centre(const TriangleMesh& mesh, const std::vector<std::int32_t>& loop);

/// Vector area of the loop's fan [mm²]; with the mesh facing outward it points into the vessel.
[[nodiscard]] Eigen::Vector3d loop_area(const TriangleMesh& mesh, const std::vector<std::int32_t>& loop,
                                        const Eigen::Vector3d& centre_mm);

/// The triangles at each vertex.
[[nodiscard]] std::vector<std::vector<std::int32_t>> triangles_around(const TriangleMesh& mesh);

void drop_unused_vertices(TriangleMesh& mesh);

/// Keeps the triangles for which `keep(t)` holds, in their order, puts others behind them, and drops vertices that no
/// triangle uses.
template <typename Keep>
void keep_triangles(TriangleMesh& mesh, Keep keep,
                    const std::vector<std::array<std::int32_t, 3>>& added = {}) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep(t)) mesh.triangles[kept++] = mesh.triangles[t];
  mesh.triangles.resize(kept);
  mesh.triangles.insert(mesh.triangles.end(), added.begin(), added.end());
  drop_unused_vertices(mesh);
}

/// Joins numbers into groups.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::int32_t>(i);
  }
  [[nodiscard]] std::int32_t root(std::int32_t i) {
    const auto at = [this](std::int32_t k) -> std::int32_t& { return parent_[static_cast<std::size_t>(k)]; };
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  }
  /// The smaller root stands for both.
  void join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  /// Groups numbered from 0 in the order of their first member; returns the group of each number.
  [[nodiscard]] std::vector<std::int32_t> groups(std::size_t& count);

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace endowire::vessel

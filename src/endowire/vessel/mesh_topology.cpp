#include "endowire/vessel/mesh_topology.hpp"

#include <cmath>
#include <cstdlib>
#include <unordered_map>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k];
      const Index b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  return edges;
}

std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh) {
  struct Border {
    Index to;
    Index triangle;
  };
  std::unordered_map<Index, std::vector<Border>> leaving;
  std::vector<Index> starts;
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    // What neighbours do not balance is border: also at edges of three triangles, so that loops always close.
    std::ptrdiff_t balance = 0;
    for (const HalfEdge* e = first; e < last; ++e) balance += e->forward ? 1 : -1;
    const Index from = balance > 0 ? first->low : first->high;
    const Index to = balance > 0 ? first->high : first->low;
    for (std::ptrdiff_t k = 0; k < std::abs(balance); ++k) {
      leaving[from].push_back({to, first->triangle});
      starts.push_back(from);
    }
  });
  std::sort(starts.begin(), starts.end());
  std::vector<BoundaryLoop> loops;
  for (Index start : starts) {
    while (!leaving[start].empty()) {
      // A walk that comes back to a vertex it has passed closes a loop there: pinched loops fall apart.
      std::vector<Index> walk{start};
      Index triangle = leaving[start].front().triangle;
      while (!walk.empty()) {
        std::vector<Border>& out = leaving[walk.back()];
        if (out.empty()) {  // an open end at a non-manifold edge: no loop
          walk.clear();
          break;
        }
        const Border next = out.front();
        out.erase(out.begin());
        triangle = next.triangle;
        const auto seen = std::find(walk.begin(), walk.end(), next.to);
        if (seen == walk.end()) {
          walk.push_back(next.to);
          continue;
        }
        BoundaryLoop loop{{seen, walk.end()}, triangle};
        std::rotate(loop.vertices.begin(), std::min_element(loop.vertices.begin(), loop.vertices.end()),
                    loop.vertices.end());
        const Index again = *seen;
        walk.erase(seen, walk.end());
        if (loop.vertices.size() >= 3) loops.push_back(std::move(loop));
        if (!walk.empty()) walk.push_back(again);
      }
    }
  }
  std::sort(loops.begin(), loops.end(),
            [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.vertices < b.vertices; });
  return loops;
}

Vector3d loop_centre(const TriangleMesh& mesh, const std::vector<Index>& loop) {
  Vector3d sum = Vector3d::Zero();
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& a = mesh.vertices_mm[at(loop[i])];
    const Vector3d& b = mesh.vertices_mm[at(loop[(i + 1) % loop.size()])];
    sum += (b - a).norm() * 0.5 * (a + b);
    length += (b - a).norm();
  }
  return length > 0.0 ? Vector3d(sum / length) : mesh.vertices_mm[at(loop[0])];
}

Vector3d loop_area(const TriangleMesh& mesh, const std::vector<Index>& loop, const Vector3d& centre_mm) {
  Vector3d twice = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    twice += (mesh.vertices_mm[at(loop[i])] - centre_mm)
                 .cross(mesh.vertices_mm[at(loop[(i + 1) % loop.size()])] - centre_mm);
  return 0.5 * twice;
}

std::vector<std::vector<Index>> triangles_around(const TriangleMesh& mesh) {
  std::vector<std::vector<Index>> around(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (Index v : mesh.triangles[t]) around[at(v)].push_back(static_cast<Index>(t));
  return around;
}

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<Index> new_index(mesh.vertices_mm.size(), -1);
  for (const auto& t : mesh.triangles)
    for (Index v : t) new_index[at(v)] = 0;
  std::vector<Vector3d> used;
  for (std::size_t v = 0; v < new_index.size(); ++v)
    if (new_index[v] == 0) {
      new_index[v] = static_cast<Index>(used.size());
      used.push_back(mesh.vertices_mm[v]);
    }
  for (auto& t : mesh.triangles)
    for (Index& v : t) v = new_index[at(v)];
  mesh.vertices_mm = std::move(used);
}

std::vector<Index> UnionFind::groups(std::size_t& count) {
  std::vector<Index> group(parent_.size());
  std::vector<Index> number(parent_.size(), -1);
  count = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    Index& known = number[at(root(static_cast<Index>(i)))];
    if (known < 0) known = static_cast<Index>(count++);
    group[i] = known;
  }
  return group;
}

}  // namespace endowire::vessel

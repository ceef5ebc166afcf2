#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::test {

/// What a mesh is, counted from its triangles alone.
struct MeshFacts {
  std::size_t bad_edges = 0;  ///< of more than two triangles, or of two that disagree in orientation
  std::size_t pinched = 0;    ///< vertices whose triangles form more than one fan
  std::size_t borders = 0;    ///< closed loops of edges with one triangle
  std::size_t components = 0;
  long euler = 0;  ///< vertices − edges + triangles
  double least_angle_deg = 180.0;
  double first_percent_angle_deg = 180.0;  ///< 1 % of the triangles have a smaller angle than this
};

namespace detail {

/// Sets that are joined.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

inline double least_angle_deg(const vessel::TriangleMesh& mesh, std::size_t t) {
  double least = 180.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d u = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    const Eigen::Vector3d v = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
    least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi);
  }
  return least;
}

}  // namespace detail

inline MeshFacts facts_of(const vessel::TriangleMesh& mesh) {
  MeshFacts facts;
  using Edge = std::pair<std::int32_t, std::int32_t>;
  std::map<Edge, int> half_edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++half_edges[{t[k], t[(k + 1) % 3]}];
  std::map<std::int32_t, std::vector<std::int32_t>> border;
  std::size_t edges = 0;
  for (const auto& [edge, count] : half_edges) {
    if (count != 1) ++facts.bad_edges;
    const bool twin = half_edges.contains({edge.second, edge.first});
    if (!twin) border[edge.first].push_back(edge.second);
    if (!twin || edge.first < edge.second) ++edges;
  }
  detail::Groups pieces(mesh.vertices_mm.size());
  for (const auto& t : mesh.triangles) {
    pieces.join(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]));
    pieces.join(static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2]));
  }
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) facts.components += pieces.root(v) == v ? 1U : 0U;

  // Triangles around a vertex that share an edge there belong to one fan.
  std::vector<std::vector<std::size_t>> around(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t]) around[static_cast<std::size_t>(v)].push_back(t);
  for (std::size_t v = 0; v < around.size(); ++v) {
    detail::Groups fans(around[v].size());
    std::map<std::int32_t, std::size_t> seen;
    for (std::size_t i = 0; i < around[v].size(); ++i)
      for (const std::int32_t w : mesh.triangles[around[v][i]]) {
        if (w == static_cast<std::int32_t>(v)) continue;
        const auto [other, fresh] = seen.try_emplace(w, i);
        if (!fresh) fans.join(other->second, i);
      }
    std::size_t count = 0;
    for (std::size_t i = 0; i < around[v].size(); ++i) count += fans.root(i) == i ? 1U : 0U;
    facts.pinched += count > 1 ? 1U : 0U;
  }

  while (!border.empty()) {
    ++facts.borders;
    std::int32_t v = border.begin()->first;
    while (border.contains(v)) {
      const std::int32_t next = border[v].back();
      border[v].pop_back();
      if (border[v].empty()) border.erase(v);
      v = next;
    }
  }
  facts.euler = static_cast<long>(mesh.vertices_mm.size()) - static_cast<long>(edges) +
                static_cast<long>(mesh.triangles.size());
  std::vector<double> angles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) angles.push_back(detail::least_angle_deg(mesh, t));
  std::sort(angles.begin(), angles.end());
  if (!angles.empty()) {
    facts.least_angle_deg = angles.front();
    facts.first_percent_angle_deg = angles[angles.size() / 100];
  }
  return facts;
}

}  // namespace endowire::test

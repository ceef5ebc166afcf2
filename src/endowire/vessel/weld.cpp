#include "endowire/vessel/weld.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "endowire/vessel/mesh_topology.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

bool lexicographic(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

std::array<Index, 3> sorted(std::array<Index, 3> t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

void rotate_smallest_first(std::array<Index, 3>& triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
}

TriangleMesh merge_points(const TriangleMesh& soup, double tolerance_mm) {
  const std::size_t corners = 3 * soup.triangles.size();
  std::vector<Index> by_place(corners);
  std::iota(by_place.begin(), by_place.end(), 0);
  const auto corner = [&](Index i) -> const Vector3d& { return soup.corner(at(i) / 3, at(i) % 3); };
  std::sort(by_place.begin(), by_place.end(),
            [&](Index a, Index b) { return lexicographic(corner(a), corner(b)); });

  struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      auto h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ULL;
      h = (h ^ static_cast<std::uint64_t>(c.y)) * 0xC2B2AE3D27D4EB4FULL;
      h = (h ^ static_cast<std::uint64_t>(c.z)) * 0x165667B19E3779F9ULL;
      return static_cast<std::size_t>(h ^ (h >> 32));
    }
  };
  std::unordered_map<Cell, Index, CellHash> grid;
  const auto cell_of = [&](const Vector3d& p) {
    return Cell{static_cast<std::int64_t>(std::floor(p.x() / tolerance_mm)),
                static_cast<std::int64_t>(std::floor(p.y() / tolerance_mm)),
                static_cast<std::int64_t>(std::floor(p.z() / tolerance_mm))};
  };
  TriangleMesh mesh;
  mesh.triangles.resize(soup.triangles.size());
  const Vector3d* previous = nullptr;
  Index vertex = -1;
  for (Index c : by_place) {
    const Vector3d& p = corner(c);
    if (previous == nullptr || *previous != p) {
      const Cell home = cell_of(p);
      vertex = -1;
      for (std::int64_t dx = -1; dx <= 1 && vertex < 0; ++dx)
        for (std::int64_t dy = -1; dy <= 1 && vertex < 0; ++dy)
          for (std::int64_t dz = -1; dz <= 1 && vertex < 0; ++dz) {
            const auto found = grid.find({home.x + dx, home.y + dy, home.z + dz});
            if (found != grid.end() && (mesh.vertices_mm[at(found->second)] - p).norm() <= tolerance_mm)
              vertex = found->second;
          }
      if (vertex < 0) {
        vertex = static_cast<Index>(mesh.vertices_mm.size());
        mesh.vertices_mm.push_back(p);
        grid.emplace(home, vertex);
      }
      previous = &p;
    }
    mesh.triangles[at(c) / 3][at(c) % 3] = vertex;
  }
  return mesh;
}

void drop_bad_triangles(TriangleMesh& mesh, MeshReport& report) {
  std::vector<std::array<Index, 3>> kept;
  kept.reserve(mesh.triangles.size());
  for (std::array<Index, 3> t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++report.degenerate_triangles;
      continue;
    }
    rotate_smallest_first(t);
    kept.push_back(t);
  }
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    const auto sa = sorted(a);
    const auto sb = sorted(b);
    return sa < sb || (sa == sb && a < b);
  });
  const auto last = std::unique(kept.begin(), kept.end(),
                                [](const auto& a, const auto& b) { return sorted(a) == sorted(b); });
  report.duplicate_triangles = static_cast<std::size_t>(kept.end() - last);
  kept.erase(last, kept.end());
  mesh.triangles = std::move(kept);

  drop_unused_vertices(mesh);  // vertices of dropped triangles only go too
}

}  // namespace endowire::vessel

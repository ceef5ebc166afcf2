#include "endowire/vessel/openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/mesh_topology.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Diameter of the lumen beside a loop: the median of rays across it from the triangles that touch the loop.
double lumen_beside_mm(const TriangleMesh& mesh, const TriangleBvh& bvh, const std::vector<Index>& loop,
                       const std::vector<std::vector<Index>>& around) {
  std::vector<Index> near;
  for (Index v : loop)
    for (Index t : around[at(v)])
      for (Index w : mesh.triangles[at(t)])
        near.insert(near.end(), around[at(w)].begin(), around[at(w)].end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<double> across;
  for (Index t : near) {
    const Vector3d normal = mesh.area_normal(at(t)).stableNormalized();
    if (normal.squaredNorm() < 0.5) continue;
    const Vector3d centre = (mesh.corner(at(t), 0) + mesh.corner(at(t), 1) + mesh.corner(at(t), 2)) / 3.0;
    const TriangleBvh::Hit hit = bvh.cast(centre, -normal, 1e-6, std::numeric_limits<double>::infinity());
    if (hit.triangle >= 0) across.push_back(hit.distance_mm);
  }
  if (across.empty()) return 0.0;
  std::nth_element(across.begin(), across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2),
                   across.end());
  return across[across.size() / 2];
}

}  // namespace

Borders find_borders(const TriangleMesh& mesh) {
  Borders borders;
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  if (loops.empty()) return borders;
  const TriangleBvh bvh(mesh);
  const std::vector<std::vector<Index>> around = triangles_around(mesh);
  for (const BoundaryLoop& loop : loops) {
    const Vector3d centre = loop_centre(mesh, loop.vertices);
    const Vector3d area = loop_area(mesh, loop.vertices, centre);
    const double diameter = 2.0 * std::sqrt(area.norm() / std::numbers::pi);
    const double lumen = lumen_beside_mm(mesh, bvh, loop.vertices, around);
    const bool ring = loop.vertices.size() >= opening_min_vertices && diameter >= opening_min_diameter_mm;
    if (ring && diameter >= opening_min_lumen_fraction * lumen) {
      Opening opening;
      opening.number = static_cast<int>(borders.openings.size()) + 1;
      opening.centre_mm = centre;
      opening.direction = -area.normalized();
      opening.diameter_mm = diameter;
      opening.loop = loop.vertices;
      borders.openings.push_back(std::move(opening));
    } else {
      borders.pin_holes.push_back({centre, diameter, loop.vertices});
    }
  }
  return borders;
}

}  // namespace endowire::vessel

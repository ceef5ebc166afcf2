#include "endowire/vessel/lumen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr double unbounded = std::numeric_limits<double>::infinity();

Vector3d centroid(const TriangleMesh& mesh, std::size_t t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
}

double radius_before(const ExactSurface& surface, std::size_t t) {
  const Vector3d& normal = surface.normal(t);
  if (normal.isZero()) return 0.0;
  const Vector3d centre = centroid(surface.mesh(), t);
  const TriangleBvh::Hit hit = surface.bvh().cast(centre, -normal, 1e-6, unbounded);
  if (hit.triangle < 0) return 0.0;
  double radius = 0.0;
  Vector3d middle = centre;
  Vector3d touched = centre;
  for (double part : {0.5, 0.375, 0.625, 0.25}) {
    if (std::min(part, 1.0 - part) * hit.distance_mm * (1.0 + 1e-9) <= radius)
      continue;  // both walls are nearer
    const double along = part * hit.distance_mm;
    const NearestPoint ball = surface.bvh().nearest(centre - along * normal, along * (1.0 + 1e-9), radius);
    if (ball.triangle < 0 || ball.distance_mm <= radius) continue;
    radius = ball.distance_mm;
    middle = centre - along * normal;
    touched = ball.point_mm;
  }
  // A facet's normal misses the axis by a part of the facet's width: recentre once on the chord through the
  // ball.
  const Vector3d away = (middle - touched).stableNormalized();
  if (away.isZero()) return radius;
  const TriangleBvh::Hit opposite = surface.bvh().cast(middle, away, 1e-6, 2.0 * radius);
  if (opposite.triangle >= 0) {
    const double half = 0.5 * (radius + opposite.distance_mm);
    const NearestPoint ball = surface.bvh().nearest(touched + half * away, half * (1.0 + 1e-9), radius);
    if (ball.triangle >= 0) radius = std::max(radius, ball.distance_mm);
  }
  return std::isfinite(radius) ? radius : 0.0;
}

double tissue_behind(const ExactSurface& surface, std::size_t t, std::size_t wall_triangles) {
  const Vector3d& normal = surface.normal(t);
  if (normal.isZero()) return unbounded;
  const TriangleMesh& mesh = surface.mesh();
  const Vector3d centre = centroid(mesh, t);
  double tissue = unbounded;
  for (std::size_t k = 0; k <= 3; ++k) {  // from the centre and from near each corner
    const Vector3d from = k == 3 ? centre : Vector3d(centre + 0.8 * (mesh.corner(t, k) - centre));
    const TriangleBvh::Hit hit = surface.bvh().cast(from, normal, 1e-6, max_tissue_mm);
    if (hit.triangle < 0 || static_cast<std::size_t>(hit.triangle) >= wall_triangles) continue;
    if (surface.normal(static_cast<std::size_t>(hit.triangle)).dot(normal) < 0.0)
      tissue = std::min(tissue, hit.distance_mm);
  }
  return tissue;
}

}  // namespace

LumenOfTriangles measure_lumen(const ExactSurface& surface, std::size_t wall_triangles) {
  const TriangleMesh& mesh = surface.mesh();
  const std::size_t count = mesh.triangles.size();
  LumenOfTriangles lumen{std::vector<double>(count), std::vector<double>(count, unbounded)};
  double largest = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    lumen.radius_mm[t] = radius_before(surface, t);
    largest = std::max(largest, lumen.radius_mm[t]);
    if (t < wall_triangles) lumen.tissue_mm[t] = tissue_behind(surface, t, wall_triangles);
  }
  std::vector<std::vector<std::int32_t>> around(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < count; ++t)
    for (std::int32_t v : mesh.triangles[t])
      around[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(t));
  std::vector<double> smooth(count);
  std::vector<double> ring;
  for (std::size_t t = 0; t < count; ++t) {
    ring.clear();
    for (std::int32_t v : mesh.triangles[t])
      for (std::int32_t n : around[static_cast<std::size_t>(v)])
        if (lumen.radius_mm[static_cast<std::size_t>(n)] > 0.0)
          ring.push_back(lumen.radius_mm[static_cast<std::size_t>(n)]);
    if (ring.empty()) ring.push_back(largest > 0.0 ? largest : 1.0);
    const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
    std::nth_element(ring.begin(), middle, ring.end());
    smooth[t] = *middle;
  }
  lumen.radius_mm = std::move(smooth);
  return lumen;
}

}  // namespace endowire::vessel

#include "endowire/vessel/surface.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

ExactSurface::ExactSurface(const TriangleMesh& closed)
    : mesh_(closed),
      bvh_(closed),
      face_normals_(closed.triangles.size(), Vector3d::Zero()),
      edge_normals_(closed.triangles.size()),
      vertex_normals_(closed.vertices_mm.size(), Vector3d::Zero()) {
  struct Edge {
    std::int32_t low, high;
    std::size_t triangle, k;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh_.triangles.size());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Vector3d area = mesh_.area_normal(t);
    double longest2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest2 = std::max(longest2, (mesh_.corner(t, (k + 1) % 3) - mesh_.corner(t, k)).squaredNorm());
    if (area.norm() > 1e-9 * longest2) face_normals_[t] = area.normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& a = mesh_.corner(t, k);
      const double angle = angle_between(mesh_.corner(t, (k + 1) % 3) - a, mesh_.corner(t, (k + 2) % 3) - a);
      const std::int32_t v = mesh_.triangles[t][k];
      const std::int32_t w = mesh_.triangles[t][(k + 1) % 3];
      vertex_normals_[static_cast<std::size_t>(v)] += angle * face_normals_[t];
      edges.push_back({std::min(v, w), std::max(v, w), t, k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    Vector3d sum = Vector3d::Zero();
    for (; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high; ++j)
      sum += face_normals_[edges[j].triangle];
    for (; i < j; ++i) edge_normals_[edges[i].triangle][edges[i].k] = sum;
  }
}

double ExactSurface::sign(const Vector3d& point, const NearestPoint& nearest) const {
  const auto t = static_cast<std::size_t>(nearest.triangle);
  const auto f = static_cast<std::size_t>(nearest.feature);
  const Vector3d& normal = f == 0   ? face_normals_[t]
                           : f <= 3 ? edge_normals_[t][f - 1]
                                    : vertex_normals_[static_cast<std::size_t>(mesh_.triangles[t][f - 4])];
  return normal.dot(point - nearest.point_mm) <= 0.0 ? 1.0 : -1.0;
}

ExactSurface::Sample ExactSurface::at(const Vector3d& point, double within_mm) const {
  return signed_at(point, bvh_.nearest(point, within_mm));
}

ExactSurface::Sample ExactSurface::at(const Vector3d& point, std::span<const std::int32_t> triangles) const {
  NearestPoint best;
  double best2 = std::numeric_limits<double>::infinity();
  for (std::int32_t triangle : triangles) {
    const auto t = static_cast<std::size_t>(triangle);
    Vector3d q;
    std::uint8_t feature = 0;
    const double d2 =
        nearest_on_triangle(point, mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), q, feature);
    if (d2 > best2 || (d2 == best2 && triangle >= best.triangle)) continue;
    best2 = d2;
    best = {std::sqrt(d2), q, triangle, feature};
  }
  return signed_at(point, best);
}

}  // namespace endowire::vessel

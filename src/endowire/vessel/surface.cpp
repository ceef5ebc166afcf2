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
  const NearestPoint nearest = bvh_.nearest(point, within_mm);
  return {sign(point, nearest) * nearest.distance_mm, nearest.point_mm, nearest.triangle};
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
  return {sign(point, best) * best.distance_mm, best.point_mm, best.triangle};
}

void ExactSurface::pack(const Vector3d& centre_mm, const std::vector<TriangleBvh::Candidate>& found,
                        Candidates& out) const {
  out.centre_mm = centre_mm;
  out.entries.clear();
  for (const TriangleBvh::Candidate& c : found) {
    const auto t = static_cast<std::size_t>(c.triangle);
    const Vector3d middle = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0;
    double radius2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      radius2 = std::max(radius2, (mesh_.corner(t, k) - middle).squaredNorm());
    out.entries.push_back({c.distance_mm,
                           middle,
                           std::sqrt(radius2) * (1.0 + 1e-12),
                           face_normals_[t],
                           face_normals_[t].dot(mesh_.corner(t, 0)),
                           c.triangle,
                           {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)}});
  }
}

ExactSurface::Sample ExactSurface::at(const Vector3d& point, const Candidates& candidates,
                                      std::int32_t& hint) const {
  constexpr double slack_mm = 1e-9;  // rounding of the bounds; they only save work
  const double shift = (point - candidates.centre_mm).norm() + slack_mm;
  NearestPoint best;
  double best2 = std::numeric_limits<double>::infinity();
  double reach = best2;  // √best2 and the slack
  const auto visit = [&](std::size_t i) {
    const Candidates::Entry& entry = candidates.entries[i];
    const std::int32_t triangle = entry.triangle;
    Vector3d q;
    std::uint8_t feature = 0;
    const double d2 =
        nearest_on_triangle(point, entry.corner_mm[0], entry.corner_mm[1], entry.corner_mm[2], q, feature);
    if (d2 > best2 || (d2 == best2 && triangle >= best.triangle)) return;
    best2 = d2;
    reach = std::sqrt(best2) + slack_mm;
    best.point_mm = q;
    best.triangle = triangle;
    best.feature = feature;
    hint = static_cast<std::int32_t>(i);
  };
  const auto first = static_cast<std::size_t>(hint);
  visit(first);
  for (std::size_t i = 0; i < candidates.entries.size(); ++i) {
    const Candidates::Entry& entry = candidates.entries[i];
    if (entry.distance_mm - shift > reach) break;  // neither this nor a later triangle is nearer
    const double height = entry.normal.dot(point) - entry.offset_mm;
    const double aside2 = reach * reach - height * height;  // what the plane's distance leaves within it
    if (aside2 < 0.0) continue;
    const double ball = std::sqrt(aside2) + entry.radius_mm;
    if ((point - entry.centre_mm).squaredNorm() - height * height > ball * ball) continue;
    if (i != first) visit(i);
  }
  best.distance_mm = std::sqrt(best2);
  return {sign(point, best) * best.distance_mm, best.point_mm, best.triangle};
}

}  // namespace endowire::vessel

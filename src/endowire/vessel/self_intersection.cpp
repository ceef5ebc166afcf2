#include "endowire/vessel/self_intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>

#include "endowire/vessel/bvh.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

double volume6(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Where the segment p q crosses the inside of a triangle.
std::optional<Vector3d> crossing(const Vector3d& p, const Vector3d& q, const TriangleMesh& mesh,
                                 std::size_t t) {
  const Vector3d& a = mesh.corner(t, 0);
  const Vector3d& b = mesh.corner(t, 1);
  const Vector3d& c = mesh.corner(t, 2);
  const double before = volume6(a, b, c, p);
  const double after = volume6(a, b, c, q);
  if (!(before * after < 0.0)) return {};
  const double ab = volume6(p, q, a, b);
  const double bc = volume6(p, q, b, c);
  const double ca = volume6(p, q, c, a);
  if (!((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0))) return {};
  return p + before / (before - after) * (q - p);
}

/// Edges of s against t; those that end in a corner of t only touch.
std::optional<Vector3d> edge_crossing(const TriangleMesh& mesh, std::size_t s, std::size_t t) {
  const std::array<std::int32_t, 3>& corners = mesh.triangles[t];
  const auto shared = [&](std::int32_t v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (shared(mesh.triangles[s][k]) || shared(mesh.triangles[s][next])) continue;
    if (const auto place = crossing(mesh.corner(s, k), mesh.corner(s, next), mesh, t)) return place;
  }
  return {};
}

}  // namespace

FlawPlaces self_intersections(const TriangleMesh& mesh) {
  FlawPlaces found;
  const TriangleBvh bvh(mesh);
  std::vector<std::int32_t> near;
  for (std::size_t s = 0; s < mesh.triangles.size(); ++s) {
    Eigen::AlignedBox3d box;
    for (std::size_t k = 0; k < 3; ++k) box.extend(mesh.corner(s, k));
    bvh.touching(box, near);
    std::sort(near.begin(), near.end());
    for (const std::int32_t other : near) {
      const auto t = static_cast<std::size_t>(other);
      if (t <= s) continue;
      std::optional<Vector3d> place = edge_crossing(mesh, s, t);
      if (!place) place = edge_crossing(mesh, t, s);
      if (place) found.add(*place);
    }
  }
  return found;
}

}  // namespace endowire::vessel

#include "endowire/vessel/end_cut.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "endowire/vessel/mesh_topology.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr double even_part = 0.1;          // of the diameter: rims of CAD models are even to a hundredth
constexpr double behind_part = 0.02;       // of the diameter: how far behind the border the plane lies
constexpr double axis_reach_part = 1.5;    // diameters of vessel that tell its axis
constexpr double max_end_diameters = 2.5;  // of vessel wall that may be taken off

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Triangles that are joined to a loop by way of others for which `wanted` holds.
template <typename Wanted>
std::vector<Index> joined_to(const TriangleMesh& mesh, const std::vector<std::vector<Index>>& around,
                             const std::vector<Index>& loop, Wanted wanted) {
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<Index> found;
  const auto visit = [&](Index vertex) {
    for (Index t : around[at(vertex)]) {
      if (seen[at(t)] || !wanted(at(t))) continue;
      seen[at(t)] = true;
      found.push_back(t);
    }
  };
  for (Index v : loop) visit(v);
  for (std::size_t next = 0; next < found.size();) {  // it grows on the way
    const std::array<Index, 3> corners = mesh.triangles[at(found[next++])];
    for (Index v : corners) visit(v);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The plane to cut an end at: outward axis, and offset of the plane along it from the loop's centre.
struct Plane {
  Vector3d centre_mm;
  Vector3d axis;
  double offset_mm = 0.0;
  double unevenness_mm = 0.0;  ///< of the border along the axis
  double diameter_mm = 0.0;

  [[nodiscard]] double beyond_mm(const Vector3d& p) const { return axis.dot(p - centre_mm) - offset_mm; }
};

Plane plane_of(const TriangleMesh& mesh, const std::vector<std::vector<Index>>& around,
               const std::vector<Index>& loop) {
  Plane plane;
  plane.centre_mm = loop_centre(mesh, loop);
  const Vector3d area = loop_area(mesh, loop, plane.centre_mm);
  plane.diameter_mm = 2.0 * std::sqrt(area.norm() / std::numbers::pi);
  const double reach = axis_reach_part * plane.diameter_mm;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (Index t : joined_to(mesh, around, loop, [&](std::size_t t) {
         return (mesh.corner(t, 0) - plane.centre_mm).norm() < reach;
       })) {
    const Vector3d normal = mesh.area_normal(at(t));
    normals += normal * normal.transpose() / std::max(normal.norm(), 1e-300);
  }
  plane.axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normals).eigenvectors().col(0);
  if (plane.axis.dot(area) > 0.0) plane.axis = -plane.axis;
  double low = 0.0;
  double high = 0.0;
  for (Index v : loop) {
    const double along = plane.axis.dot(mesh.vertices_mm[at(v)] - plane.centre_mm);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  plane.unevenness_mm = high - low;
  plane.offset_mm = low - behind_part * plane.diameter_mm;
  return plane;
}

/// Takes off what lies beyond the plane and is joined to the loop.
bool cut(TriangleMesh& mesh, const std::vector<std::vector<Index>>& around, const std::vector<Index>& loop,
         const Plane& plane) {
  const auto beyond = [&](Index v) { return plane.beyond_mm(mesh.vertices_mm[at(v)]) > 0.0; };
  const std::vector<Index> end = joined_to(mesh, around, loop, [&](std::size_t t) {
    return std::any_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), beyond);
  });
  double area = 0.0;
  for (Index t : end) area += 0.5 * mesh.area_normal(at(t)).norm();
  if (end.empty() || area > max_end_diameters * std::numbers::pi * plane.diameter_mm * plane.diameter_mm)
    return false;
  std::vector<bool> drop(mesh.triangles.size(), false);
  std::vector<std::array<Index, 3>> pieces;
  std::map<std::pair<Index, Index>, Index> crossings;
  const auto crossing = [&](Index a, Index b) {
    const auto [known, is_new] = crossings.try_emplace({std::min(a, b), std::max(a, b)}, Index{0});
    if (is_new) {
      const Vector3d& p = mesh.vertices_mm[at(known->first.first)];
      const Vector3d& q = mesh.vertices_mm[at(known->first.second)];
      const double before = plane.beyond_mm(p);
      const Vector3d place = p + before / (before - plane.beyond_mm(q)) * (q - p);
      known->second = static_cast<Index>(mesh.vertices_mm.size());
      mesh.vertices_mm.push_back(place);
    }
    return known->second;
  };
  for (Index t : end) {
    drop[at(t)] = true;
    const std::array<Index, 3> corners = mesh.triangles[at(t)];
    std::vector<Index> kept;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k];
      const Index b = corners[(k + 1) % 3];
      if (!beyond(a)) kept.push_back(a);
      if (beyond(a) != beyond(b)) kept.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < kept.size(); ++k) pieces.push_back({kept[0], kept[k - 1], kept[k]});
  }
  keep_triangles(
      mesh, [&](std::size_t t) { return !drop[t]; }, pieces);
  return true;
}

}  // namespace

std::size_t cut_ragged_ends(TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t tried = 0; tried < boundary_loops(mesh).size(); ++tried) {
    // The mesh changes with each cut: the loops are looked for anew.
    const std::vector<std::vector<Index>> around = triangles_around(mesh);
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
      const Plane plane = plane_of(mesh, around, loop.vertices);
      if (plane.unevenness_mm <= even_part * plane.diameter_mm) continue;
      if (!cut(mesh, around, loop.vertices, plane)) continue;
      ++count;
      break;
    }
  }
  return count;
}

}  // namespace endowire::vessel

#include "endowire/vessel/closure.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/vessel/bvh.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr double clearance_mm = 2.5;  // between a virtual tube and real walls: the band in which φ is exact
constexpr double probe_step_mm = 1.0;
constexpr double ring_spacing_mm = 10.0;  // rings along a tube: keeps its triangles compact

Index add_vertex(TriangleMesh& mesh, const Vector3d& p) {
  mesh.vertices_mm.push_back(p);
  return static_cast<Index>(mesh.vertices_mm.size() - 1);
}

/// Triangles from the loop's edges to one point, facing as the mesh around does.
void fan(TriangleMesh& mesh, const std::vector<Index>& loop, const Vector3d& apex) {
  const Index centre = add_vertex(mesh, apex);
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
}

/// How far the tube may go before it meets a wall or an earlier tube.
double free_length_mm(const std::vector<Vector3d>& profile, const VirtualTube& tube, double wanted_mm,
                      const TriangleBvh& walls, const std::vector<VirtualTube>& earlier) {
  double length = 0.0;
  while (length < wanted_mm) {
    const double next = std::min(wanted_mm, length + probe_step_mm);
    const double gap = std::min(clearance_mm, 0.4 * next);
    for (const Vector3d& offset : profile) {
      const Vector3d p = tube.centre_mm + offset + (tube.begin_mm + next) * tube.direction;
      if (walls.nearest(p, gap).triangle >= 0) return length;
      for (const VirtualTube& other : earlier) {
        const Vector3d r = p - other.centre_mm;
        const double along = r.dot(other.direction);
        const double across = (r - along * other.direction).norm();
        if (along > 0.0 && along < other.end_mm + gap && across < other.radius_mm + gap) return length;
      }
    }
    length = next;
  }
  return length;
}

void extrude(ClosedSurface& closed, const Opening& opening, const TriangleBvh& walls, double tube_mm) {
  TriangleMesh& mesh = closed.mesh;
  VirtualTube tube;
  tube.centre_mm = opening.centre_mm;
  tube.direction = opening.direction;
  std::vector<Vector3d> profile;  // the loop projected on the opening's plane
  for (Index v : opening.loop) {
    const Vector3d r = mesh.vertices_mm[static_cast<std::size_t>(v)] - tube.centre_mm;
    const double along = r.dot(tube.direction);
    profile.emplace_back(r - along * tube.direction);
    tube.begin_mm = std::max(tube.begin_mm, along);
    tube.radius_mm = std::max(tube.radius_mm, profile.back().norm());
  }
  std::vector<Vector3d> probes = profile;
  probes.emplace_back(Vector3d::Zero());
  const double length = std::max(probe_step_mm, free_length_mm(probes, tube, tube_mm, walls, closed.tubes));
  tube.end_mm = tube.begin_mm + length;
  const auto rings = static_cast<int>(std::ceil(length / ring_spacing_mm));
  std::vector<Index> ring = opening.loop;
  for (int k = 1; k <= rings; ++k) {
    const double along = tube.begin_mm + length * k / rings;
    std::vector<Index> next;
    next.reserve(profile.size());
    for (const Vector3d& offset : profile)
      next.push_back(add_vertex(mesh, tube.centre_mm + offset + along * tube.direction));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t j = (i + 1) % ring.size();
      mesh.triangles.push_back({ring[j], ring[i], next[i]});
      mesh.triangles.push_back({ring[j], next[i], next[j]});
    }
    ring = std::move(next);
  }
  fan(mesh, ring, tube.centre_mm + tube.end_mm * tube.direction);
  closed.tubes.push_back(tube);
}

}  // namespace

ClosedSurface close_surface(const RepairedMesh& repaired, double tube_mm) {
  ClosedSurface closed;
  closed.mesh = repaired.mesh;
  for (const PinHole& hole : repaired.pin_holes) fan(closed.mesh, hole.loop, hole.centre_mm);
  closed.wall_triangles = closed.mesh.triangles.size();
  if (!repaired.openings.empty()) {
    const TriangleBvh walls(repaired.mesh);
    for (const Opening& opening : repaired.openings) extrude(closed, opening, walls, tube_mm);
  }
  return closed;
}

}  // namespace endowire::vessel

#include "endowire/vessel/lumen_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Virtual tubes as long as the widest opening: no ball whose centre lies in the vessel touches their ends.
double tube_length_mm(const RepairedMesh& repaired) {
  double length_mm = 1.0;
  for (const Opening& opening : repaired.openings) length_mm = std::max(length_mm, opening.diameter_mm);
  return length_mm;
}

TriangleMesh wall_of(const ClosedSurface& closed) {
  TriangleMesh wall;
  if (closed.tubes.empty()) return wall;
  wall.vertices_mm = closed.mesh.vertices_mm;
  wall.triangles.assign(closed.mesh.triangles.begin(),
                        closed.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(closed.wall_triangles));
  return wall;
}

}  // namespace

LumenSpace::LumenSpace(const RepairedMesh& repaired)
    : closed_(close_surface(repaired, tube_length_mm(repaired))),
      wall_(wall_of(closed_)),
      surface_(closed_.mesh),
      wall_bvh_(wall_) {}

/// Where the closure of an opening is nearest, the wall is further.
LumenSpace::Sample LumenSpace::open(const Vector3d& point_mm, const ExactSurface::Sample& closed) const {
  Sample sample{closed.distance_mm, closed.distance_mm, closed.nearest_mm, closed.triangle};
  if (static_cast<std::size_t>(closed.triangle) < closed_.wall_triangles) return sample;
  const NearestPoint wall = wall_bvh_.nearest(point_mm);
  sample.radius_mm = std::copysign(wall.distance_mm, closed.distance_mm);
  sample.nearest_mm = wall.point_mm;
  sample.triangle = wall.triangle;
  return sample;
}

LumenSpace::Sample LumenSpace::at(const Vector3d& point_mm, double within_mm) const {
  return open(point_mm, surface_.at(point_mm, within_mm));
}

LumenSpace::Sample LumenSpace::at(const Vector3d& point_mm, std::span<const std::int32_t> triangles,
                                  double trusted_mm) const {
  const ExactSurface::Sample tried = surface_.at(point_mm, triangles);
  const double distance_mm = std::abs(tried.distance_mm);
  if (distance_mm <= trusted_mm) return open(point_mm, tried);
  return at(point_mm, distance_mm * (1.0 + 1e-9) + 1e-9);
}

bool LumenSpace::beyond_opening(const Vector3d& point_mm) const {
  return std::any_of(closed_.tubes.begin(), closed_.tubes.end(), [&](const VirtualTube& tube) {
    const Vector3d r = point_mm - tube.centre_mm;
    const double along = r.dot(tube.direction);
    return along > 0.0 && along <= tube.end_mm &&
           (r - along * tube.direction).squaredNorm() <= tube.radius_mm * tube.radius_mm;
  });
}

bool LumenSpace::sees(const Vector3d& from_mm, const Vector3d& to_mm) const {
  const double length_mm = (to_mm - from_mm).norm();
  if (length_mm == 0.0) return true;
  return surface_.bvh().cast(from_mm, (to_mm - from_mm) / length_mm, 0.0, length_mm).triangle < 0;
}

double LumenSpace::free_way_mm(const Vector3d& from_mm, const Vector3d& direction) const {
  // A ray that meets an edge or a corner exactly may slip through: it is turned a little, and tried again.
  constexpr double turn_rad = 1e-5;
  Vector3d turned = direction;
  for (int attempt = 0; attempt < 4; ++attempt) {
    const TriangleBvh::Hit hit =
        surface_.bvh().cast(from_mm, turned, 0.0, std::numeric_limits<double>::infinity());
    if (hit.triangle >= 0) return hit.distance_mm;
    turned = (direction + turn_rad * (attempt + 1) * direction.unitOrthogonal()).normalized();
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace endowire::vessel

#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/repair.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire::vessel {

/// The lumen of a vessel for geometry: inside and outside by the closed surface, radii by the wall alone.
///
/// Openings are closed by virtual tubes, so that inside is defined; an inscribed ball may still reach through
/// an opening, since nothing is there to stop it. The vessel ends at the plane of each opening.
class LumenSpace {
 public:
  explicit LumenSpace(const RepairedMesh& repaired);
  LumenSpace(const LumenSpace&) = delete;  // the trees refer to the meshes
  LumenSpace& operator=(const LumenSpace&) = delete;

  struct Sample {
    double radius_mm = 0.0;  ///< to the wall, > 0 inside; the closure of openings is no wall
    double reach_mm = 0.0;   ///< to wall or closure: a ball of this radius stays inside the closed surface
    Eigen::Vector3d nearest_mm = Eigen::Vector3d::Zero();  ///< point of the wall
    std::int32_t triangle = -1;                            ///< of the wall
  };
  /// @param within_mm  a distance within which the closed surface is known to come: makes the search shorter
  [[nodiscard]] Sample at(const Eigen::Vector3d& point_mm,
                          double within_mm = std::numeric_limits<double>::infinity()) const;

  /// The same where all triangles within `trusted_mm` are among some: these few are tried first.
  [[nodiscard]] Sample at(const Eigen::Vector3d& point_mm, std::span<const std::int32_t> triangles,
                          double trusted_mm) const;

  /// True beyond the plane of an opening, within its virtual tube.
  [[nodiscard]] bool beyond_opening(const Eigen::Vector3d& point_mm) const;

  /// True when the segment does not pass the closed surface. Exact against its triangles.
  [[nodiscard]] bool sees(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm) const;

  /// Distance to the closed surface along a direction of length one, from inside.
  [[nodiscard]] double free_way_mm(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& direction) const;

  /// The closed surface, the wall's triangles first.
  [[nodiscard]] const ExactSurface& surface() const { return surface_; }
  [[nodiscard]] std::size_t wall_triangles() const { return closed_.wall_triangles; }

 private:
  [[nodiscard]] Sample open(const Eigen::Vector3d& point_mm, const ExactSurface::Sample& closed) const;

  ClosedSurface closed_;
  TriangleMesh wall_;  ///< without the closure of openings; empty for a closed vessel
  ExactSurface surface_;
  TriangleBvh wall_bvh_;
};

}  // namespace endowire::vessel

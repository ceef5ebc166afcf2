#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "endowire/vessel/brick_kernels.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire::vessel {

/// Exact distances for the many points of a brick, which few triangles serve.
///
/// In a cube in which the surface comes as near as `within_mm` to the middle, no point is further from the surface than
/// within_mm and half a diagonal: triangles further than that from the cube are left out. Where few remain, each is tried for four
/// points at a time; where many do, the tree is asked for each point, from the triangle that the last one found on.
/// Answers are those of TriangleBvh::nearest, bit for bit, on every processor (docs/decisions/0015).
class NearTriangles {
 public:
  explicit NearTriangles(const ExactSurface& surface) : surface_(&surface) {}

  struct Cube {
    Eigen::Vector3d middle_mm;
    double half_mm;  ///< of an edge
  };
  /// Turns to a cube.
  /// @param middle  the surface nearest to its middle
  void turn_to(const Cube& cube, const ExactSurface::Sample& middle);

  /// The surface nearest to the points of a block, which lie in the cube. `feature`, `needle` and `height_mm` are of no use afterwards.
  void nearest(PointBlock& block);

 private:
  [[nodiscard]] KernelTriangle bounded(std::int32_t triangle) const;
  /// Answers for point n of a block.
  void ask_tree(const Eigen::Vector3d& point_mm, std::size_t n, PointBlock& block);

  const ExactSurface* surface_;
  std::vector<KernelTriangle> triangles_;  ///< the first is nearest to the middle; empty where there are many
  std::vector<std::int32_t> touching_;
  std::vector<std::pair<double, std::int32_t>> places_;  ///< of triangles: distance to the middle
  std::int32_t last_ = 0;                                ///< triangle nearest to the last point
};

}  // namespace endowire::vessel

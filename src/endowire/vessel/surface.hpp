#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// Exact signed distance to a closed mesh that faces outward: positive inside.
///
/// The sign is that of the angle-weighted pseudonormal of the nearest feature.
/// Source  J. A. Bærentzen & H. Aanæs, IEEE Trans. Vis. Comput. Graph. 11(3):243, 2005.
/// Domain  exact for closed manifold meshes; where triangles pass through each other the sign holds near the
///         sheet that is nearest. `winding_number` tells otherwise.
class ExactSurface {
 public:
  explicit ExactSurface(const TriangleMesh& closed);

  struct Sample {
    double distance_mm = 0.0;  ///< positive inside
    Eigen::Vector3d nearest_mm = Eigen::Vector3d::Zero();
    std::int32_t triangle = -1;
  };
  /// @param within_mm  a distance within which the surface is known to come: makes the search shorter
  [[nodiscard]] Sample at(const Eigen::Vector3d& point_mm,
                          double within_mm = std::numeric_limits<double>::infinity()) const;

  /// The same by trying some triangles only: right when the nearest is among them.
  [[nodiscard]] Sample at(const Eigen::Vector3d& point_mm, std::span<const std::int32_t> triangles) const;

  /// A point's nearest place on the surface with its sign.
  [[nodiscard]] Sample signed_at(const Eigen::Vector3d& point_mm, const NearestPoint& nearest) const {
    return {sign(point_mm, nearest) * nearest.distance_mm, nearest.point_mm, nearest.triangle};
  }

  [[nodiscard]] const TriangleBvh& bvh() const { return bvh_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// Normal of a triangle, length one, or zero for a sliver.
  [[nodiscard]] const Eigen::Vector3d& normal(std::size_t triangle) const { return face_normals_[triangle]; }

 private:
  [[nodiscard]] double sign(const Eigen::Vector3d& point, const NearestPoint& nearest) const;

  const TriangleMesh& mesh_;
  TriangleBvh bvh_;
  std::vector<Eigen::Vector3d> face_normals_;
  std::vector<std::array<Eigen::Vector3d, 3>> edge_normals_;
  std::vector<Eigen::Vector3d> vertex_normals_;
};

}  // namespace endowire::vessel

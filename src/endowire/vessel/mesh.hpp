#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace endowire::vessel {

/// Triangles that share their vertices. Counter-clockwise seen from outside the lumen once repaired.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices_mm;
  std::vector<std::array<std::int32_t, 3>> triangles;

  [[nodiscard]] const Eigen::Vector3d& corner(std::size_t triangle, std::size_t k) const {
    return vertices_mm[static_cast<std::size_t>(triangles[triangle][k])];
  }
  /// Normal of a triangle, its length twice the area [mm²].
  [[nodiscard]] Eigen::Vector3d area_normal(std::size_t triangle) const {
    return (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
  }
};

/// Smallest box around the vertices that triangles use; empty for a mesh without triangles.
[[nodiscard]] Eigen::AlignedBox3d bounds_mm(const TriangleMesh& mesh);

/// Σ a·(b×c)/6, positive when the triangles of a closed mesh face outward [mm³].
[[nodiscard]] double signed_volume_mm3(const TriangleMesh& mesh);

/// Sum of the triangles' areas [mm²].
[[nodiscard]] double area_mm2(const TriangleMesh& mesh);

/// Hash of coordinates and triangles as they stand (FNV-1a over 64-bit words).
[[nodiscard]] std::uint64_t content_hash(const TriangleMesh& mesh);

}  // namespace endowire::vessel

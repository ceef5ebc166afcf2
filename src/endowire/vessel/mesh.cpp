#include "endowire/vessel/mesh.hpp"

#include "endowire/vessel/hash.hpp"

namespace endowire::vessel {

Eigen::AlignedBox3d bounds_mm(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) box.extend(mesh.corner(t, k));
  return box;
}

double signed_volume_mm3(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0.0;
  const Eigen::Vector3d origin = bounds_mm(mesh).center();  // keeps the sum small far from the origin
  double six_volumes = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    six_volumes +=
        (mesh.corner(t, 0) - origin).dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  return six_volumes / 6.0;
}

double area_mm2(const TriangleMesh& mesh) {
  double twice_area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) twice_area += mesh.area_normal(t).norm();
  return 0.5 * twice_area;
}

std::uint64_t content_hash(const TriangleMesh& mesh) {
  ContentHash hash;
  hash.add(static_cast<std::uint64_t>(mesh.vertices_mm.size()));
  for (const Eigen::Vector3d& v : mesh.vertices_mm)
    for (int k = 0; k < 3; ++k) hash.add(v[k]);
  for (const auto& t : mesh.triangles)
    for (std::int32_t index : t) hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(index)));
  return hash.value();
}

}  // namespace endowire::vessel

#include "endowire/io/mesh_bytes.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "endowire/base/error.hpp"

namespace endowire::io {

using base::InputError;

std::string pack_mesh(const vessel::TriangleMesh& mesh) {
  const std::uint64_t vertices = mesh.vertices_mm.size();
  std::string bytes(reinterpret_cast<const char*>(&vertices), sizeof vertices);
  bytes.append(reinterpret_cast<const char*>(mesh.vertices_mm.data()), vertices * sizeof(Eigen::Vector3d));
  bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
               mesh.triangles.size() * sizeof mesh.triangles[0]);
  return bytes;
}

vessel::TriangleMesh unpack_mesh(const std::string& bytes, const std::string& file_label) {
  vessel::TriangleMesh mesh;
  std::uint64_t vertices = 0;
  constexpr std::size_t head = sizeof vertices;
  constexpr std::size_t triangle = sizeof mesh.triangles[0];
  if (bytes.size() >= head) std::memcpy(&vertices, bytes.data(), head);
  if (bytes.size() < head || vertices > (bytes.size() - head) / sizeof(Eigen::Vector3d) ||
      (bytes.size() - head - vertices * sizeof(Eigen::Vector3d)) % triangle != 0)
    throw InputError(fmt::format("{}: is damaged: its reader gave {} bytes for {} points", file_label,
                                 bytes.size(), vertices));
  const std::size_t corner_bytes = vertices * sizeof(Eigen::Vector3d);
  mesh.vertices_mm.resize(vertices);
  std::memcpy(static_cast<void*>(mesh.vertices_mm.data()), bytes.data() + head, corner_bytes);
  mesh.triangles.resize((bytes.size() - head - corner_bytes) / triangle);
  std::memcpy(mesh.triangles.data(), bytes.data() + head + corner_bytes, mesh.triangles.size() * triangle);
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    if (!mesh.vertices_mm[v].allFinite())
      throw InputError(
          fmt::format("{}: point {} is not finite; must be three finite numbers", file_label, v));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t corner : mesh.triangles[t])
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= vertices)
        throw InputError(fmt::format("{}: triangle {} has corner {}; must be 0 … {}", file_label, t, corner,
                                     static_cast<std::int64_t>(vertices) - 1));
  return mesh;
}

}  // namespace endowire::io

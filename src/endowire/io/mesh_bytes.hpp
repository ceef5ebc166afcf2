#pragma once

#include <string>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// A mesh as bytes, from one process to another on the same machine: the number of vertices, their places, the triangles.
[[nodiscard]] std::string pack_mesh(const vessel::TriangleMesh& mesh);

/// The mesh that pack_mesh made bytes of. The process that made them read a stranger's file: nothing in them is believed.
/// @throws base::InputError when the sizes do not fit, a place is not finite, or a corner is no vertex
[[nodiscard]] vessel::TriangleMesh unpack_mesh(const std::string& bytes, const std::string& file_label);

}  // namespace endowire::io

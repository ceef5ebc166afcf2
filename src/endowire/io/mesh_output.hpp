#pragma once

#include <filesystem>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// @throws base::InputError when a mesh cannot be written under that name: it must end in .vtp (with VTK) or .stl
void check_mesh_output(const std::filesystem::path& path);

/// Writes a surface in millimetres, VTP with double precision or STL with single.
/// @throws base::InputError as above, and when the place cannot be written to
void write_mesh(const std::filesystem::path& path, const vessel::TriangleMesh& mesh);

}  // namespace endowire::io

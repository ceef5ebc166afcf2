#pragma once

#include <filesystem>
#include <string>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// The triangles of a surface file in units of the file: STL, PLY, OBJ; with VTK also its XML files (.vtp, .vtu) and its
/// legacy format (.vtk). Polygons and strips become triangles; of cells that fill space the outside is taken.
///
/// What the file begins with decides; OBJ, which begins with anything, by its name.
/// @param path  where the bytes are from
/// @throws base::InputError one line that names the file and what is wrong with it
[[nodiscard]] vessel::TriangleMesh parse_surface(const std::string& bytes, const std::filesystem::path& path);

}  // namespace endowire::io

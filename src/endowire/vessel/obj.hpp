#pragma once

#include <string>
#include <string_view>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// The faces of a Wavefront OBJ file, in units of the file; polygons become fans of triangles.
///
/// Of the format `v` and `f` are read, in all forms of a corner (7, 7/1, 7//3, 7/1/3, -1); lines may go on behind a
/// backslash. Everything else is passed over: normals, textures, groups, materials, curves.
/// @throws base::InputError for a vertex that is not finite, a corner that no vertex before it has, and a file without
///                          faces
[[nodiscard]] TriangleMesh parse_obj(std::string_view text, const std::string& file_label);

}  // namespace endowire::vessel

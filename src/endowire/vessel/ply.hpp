#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// The faces of a PLY file, in units of the file; polygons become fans of triangles.
///
/// Text and binary of either byte order; any elements and properties, of which x, y and z of `vertex` and the list
/// `vertex_indices` (or `vertex_index`) of `face` are used. Nothing is allocated by a count that the bytes do not hold.
/// @throws base::InputError for a header that is none, a file that ends too soon, a coordinate that is not finite, a
///                          corner that is no vertex, and a file without faces
[[nodiscard]] TriangleMesh parse_ply(std::span<const std::byte> bytes, const std::string& file_label);

}  // namespace endowire::vessel

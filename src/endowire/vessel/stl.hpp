#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// Unit of length in which a mesh file was saved.
enum class LengthUnit : std::uint8_t { millimetre, centimetre, metre };

/// Millimetres in one unit.
[[nodiscard]] double millimetres_in(LengthUnit unit);

/// "mm", "cm" or "m".
[[nodiscard]] std::string_view name_of(LengthUnit unit);

/// The unit called "mm", "cm" or "m".
/// @param label  file and field to name in the message, e.g. `scene.toml: vessel.unit`
/// @throws       InputError for any other name
[[nodiscard]] LengthUnit parse_length_unit(std::string_view name, const std::string& label);

/// The triangles of an STL file, binary or ASCII, scaled to millimetres; vertices are not merged yet.
///
/// A file is binary when its length is exactly what its triangle count says (also when it begins with
/// "solid"); else ASCII when it begins with "solid" and holds a facet; anything else is refused. Nothing is
/// allocated by a count that the bytes do not hold. The normals of the file are ignored.
/// @param bytes       the whole file
/// @param file_label  its name for messages
/// @throws            InputError when empty, truncated, lying about its count, not finite, or without
/// triangles
[[nodiscard]] TriangleMesh parse_stl(std::span<const std::byte> bytes, const std::string& file_label,
                                     LengthUnit unit = LengthUnit::millimetre);

/// The mesh as a binary STL file in millimetres (single precision, as the format has it).
[[nodiscard]] std::vector<std::byte> write_binary_stl(const TriangleMesh& mesh);

/// The mesh as an ASCII STL file in millimetres.
[[nodiscard]] std::string write_ascii_stl(const TriangleMesh& mesh, std::string_view name = "vessel");

}  // namespace endowire::vessel

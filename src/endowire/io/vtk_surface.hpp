#pragma once

#include <string>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

// Files that VTK reads. What a header claims is held against the length of the file before VTK sees it.

/// The surface in a VTK file of the legacy format: polygons, strips, or the outside of cells.
/// @throws base::InputError when VTK finds no surface in it, and in a build without VTK
[[nodiscard]] vessel::TriangleMesh parse_legacy_vtk(const std::string& bytes, const std::string& file_label);

/// The surface in a VTK XML file of type PolyData or UnstructuredGrid.
/// @throws base::InputError as above
[[nodiscard]] vessel::TriangleMesh parse_vtk_xml(const std::string& bytes, const std::string& file_label);

}  // namespace endowire::io

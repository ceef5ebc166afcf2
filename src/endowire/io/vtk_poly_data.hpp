#pragma once

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstddef>
#include <filesystem>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

// What VTP files are written with; included only where there is VTK.

/// Adds an array of single numbers to the data of points, of cells or of the whole.
/// @param value  called with 0 … count − 1
template <class Array, class Value>
void add_array(vtkFieldData& data, const char* name, std::size_t count, Value value) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) array->SetValue(static_cast<vtkIdType>(i), value(i));
  data.AddArray(array);
}

/// A mesh as VTK has it, and back; cells that are no triangles are left out.
[[nodiscard]] vtkNew<vtkPolyData> to_vtk(const vessel::TriangleMesh& mesh);
[[nodiscard]] vessel::TriangleMesh from_vtk(vtkPolyData& poly);

/// Writes a VTP file whose numbers stand raw behind the XML: exact, and the same bytes for the same data.
void write_vtp(const std::filesystem::path& path, vtkPolyData& poly);

}  // namespace endowire::io

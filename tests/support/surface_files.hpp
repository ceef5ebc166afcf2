#pragma once

#include <string>

#include "support/generated_meshes.hpp"

namespace endowire::test {

/// What the files below hold.
inline vessel::TriangleMesh tube() {
  return closed_tube(4.0, 40.0, 12, 6);
}

inline std::string points_text(const vessel::TriangleMesh& mesh) {
  std::string text;
  for (const Eigen::Vector3d& v : mesh.vertices_mm)
    text += std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
  return text;
}

inline std::string triangles_text(const vessel::TriangleMesh& mesh, const char* begin) {
  std::string text;
  for (const auto& t : mesh.triangles)
    text += begin + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return text;
}

inline std::string legacy_vtk_file() {
  const vessel::TriangleMesh mesh = tube();
  return "# vtk DataFile Version 3.0\ntube\nASCII\nDATASET POLYDATA\nPOINTS " +
         std::to_string(mesh.vertices_mm.size()) + " double\n" + points_text(mesh) + "POLYGONS " +
         std::to_string(mesh.triangles.size()) + " " + std::to_string(4 * mesh.triangles.size()) + "\n" +
         triangles_text(mesh, "3 ");
}

inline std::string vtu_file() {
  const vessel::TriangleMesh mesh = tube();
  std::string offsets;
  std::string types;
  for (std::size_t t = 1; t <= mesh.triangles.size(); ++t) {
    offsets += std::to_string(3 * t) + " ";
    types += "5 ";
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n"
         "<UnstructuredGrid><Piece NumberOfPoints=\"" +
         std::to_string(mesh.vertices_mm.size()) + "\" NumberOfCells=\"" +
         std::to_string(mesh.triangles.size()) +
         "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
         points_text(mesh) +
         "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         triangles_text(mesh, "") +
         "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
         "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

}  // namespace endowire::test

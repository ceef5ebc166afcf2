#include "tube_files.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>

namespace endowire::tests {

using Eigen::Vector3d;

double TubeMesh::flat_radius_mm() const {
  return radius_mm * std::cos(std::numbers::pi / sides);
}

Triangles TubeMesh::triangles() const {
  const auto corner = [this](int ring, int side) {
    const double angle = 2.0 * std::numbers::pi * (side % sides + 0.5) / sides;
    return Vector3d(start_mm + Vector3d(length_mm * ring / rings, radius_mm * std::cos(angle),
                                        radius_mm * std::sin(angle)));
  };
  Triangles result;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      result.push_back({corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
      result.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
    }
  }
  const Vector3d end = start_mm + Vector3d(length_mm, 0.0, 0.0);
  for (int j = 0; j < sides; ++j) {
    if (cap_start) result.push_back({start_mm, corner(0, j + 1), corner(0, j)});
    if (cap_end) result.push_back({end, corner(rings, j), corner(rings, j + 1)});
  }
  return result;
}

RecordedAxis straight_wire(const Vector3d& tip_mm, const Vector3d& sheath_mm, int rods) {
  RecordedAxis wire;
  for (int i = 0; i <= rods; ++i) wire.points_mm.push_back(tip_mm + (sheath_mm - tip_mm) * i / rods);
  return wire;
}

void write_stl(const std::filesystem::path& path, const Triangles& triangles) {
  std::ofstream out(path);
  out << std::setprecision(9) << "solid vessel\n";
  for (const auto& triangle : triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Vector3d& p : triangle) out << "vertex " << p.x() << " " << p.y() << " " << p.z() << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid vessel\n";
}

namespace {

void write_vtp(const std::filesystem::path& path, const RecordedAxis& wire) {
  std::ofstream out(path);
  out << std::setprecision(17);
  const std::size_t n = wire.points_mm.size();
  out << "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      << "<FieldData><DataArray type=\"Float64\" Name=\"inserted_length_mm\" NumberOfTuples=\"1\" "
         "format=\"ascii\">"
      << wire.inserted_mm << "</DataArray></FieldData>\n"
      << "<Piece NumberOfPoints=\"" << n << "\" NumberOfLines=\"1\">\n<PointData>\n"
      << "<DataArray type=\"Float64\" Name=\"arc_mm\" format=\"ascii\">";
  double arc = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) arc += (wire.points_mm[i] - wire.points_mm[i - 1]).norm();
    out << arc << " ";
  }
  out << "</DataArray>\n<DataArray type=\"Float64\" Name=\"radius_mm\" format=\"ascii\">";
  for (std::size_t i = 0; i < n; ++i) out << wire.radius_mm << " ";
  out << "</DataArray>\n</PointData>\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">";
  for (const Vector3d& p : wire.points_mm) out << p.x() << " " << p.y() << " " << p.z() << " ";
  out << "</DataArray></Points>\n<Lines><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">";
  for (std::size_t i = 0; i < n; ++i) out << i << " ";
  out << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" << n
      << "</DataArray></Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace

std::filesystem::path write_recording(const std::filesystem::path& folder,
                                      const std::vector<RecordedAxis>& steps) {
  const auto path = folder / "wire.pvd";
  std::ofstream out(path);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string name = "wire_" + std::to_string(i) + ".vtp";
    write_vtp(folder / name, steps[i]);
    out << "<DataSet timestep=\"" << i << "\" group=\"\" part=\"0\" file=\"" << name << "\"/>\n";
  }
  out << "</Collection>\n</VTKFile>\n";
  return path;
}

}  // namespace endowire::tests

#include "endowire/io/vtp.hpp"

#include <fmt/format.h>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "endowire/io/vtk_poly_data.hpp"
#endif

namespace endowire::io {

using base::InputError;

#ifdef ENDOWIRE_WITH_VTK

namespace {

void add_field(vtkPolyData& poly, const char* name, const Eigen::Vector3d& value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->InsertNextTuple(value.data());
  poly.GetFieldData()->AddArray(array);
}

}  // namespace

bool vtp_available() {
  return true;
}

void write_wire_vtp(const std::filesystem::path& path, const sim::Snapshot& snapshot,
                    const sim::Access& access) {
  using Point = sim::SnapshotPoint;
  const auto count = static_cast<vtkIdType>(snapshot.points.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(count));
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("wall_force_direction");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const Point& point = snapshot.points[static_cast<std::size_t>(i)];
    points->SetPoint(i, point.position_mm.data());
    directions->SetTuple(i, point.wall_force_direction.data());
    lines->InsertCellPoint(i);
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetLines(lines);
  const auto add_points = [&](const char* name, auto value) {
    add_array<vtkDoubleArray>(*poly->GetPointData(), name, snapshot.points.size(),
                              [&](std::size_t i) { return value(snapshot.points[i]); });
  };
  const auto add_value = [&](const char* name, double value) {
    add_array<vtkDoubleArray>(*poly->GetFieldData(), name, 1, [&](std::size_t /*i*/) { return value; });
  };
  add_points("arc_mm", [](const Point& point) { return point.arc_mm; });
  add_points("radius_mm", [](const Point& point) { return point.radius_mm; });
  add_points("curvature_per_mm", [](const Point& point) { return point.curvature_per_mm; });
  add_points("twist_rad", [](const Point& point) { return point.twist_rad; });
  add_points("wall_force_n_per_mm", [](const Point& point) { return point.wall_force_n_per_mm; });
  add_points("friction_n_per_mm", [](const Point& point) { return point.friction_n_per_mm; });
  poly->GetPointData()->AddArray(directions);
  add_value("inserted_length_mm", snapshot.inserted_length_mm);
  add_value("push_force_n", snapshot.push_force_n);
  add_value("torque_n_mm", snapshot.torque_n_mm);
  add_field(*poly, "access_position_mm", access.position_mm);
  add_field(*poly, "access_direction", access.direction);

  write_vtp(path, *poly);
}

#else

bool vtp_available() {
  return false;
}

void write_wire_vtp(const std::filesystem::path& path, const sim::Snapshot&, const sim::Access&) {
  throw InputError(
      fmt::format("{}: cannot be written; this build has no VTK (ENDOWIRE_WITH_VTK is off)", path.string()));
}

#endif

void write_pvd(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const SeriesEntry& entry : entries)
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", entry.time_s,
                        entry.file);
  text += "  </Collection>\n</VTKFile>\n";
  write_file_atomically(path, text);
}

}  // namespace endowire::io

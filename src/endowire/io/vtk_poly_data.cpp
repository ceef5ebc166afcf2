#ifdef ENDOWIRE_WITH_VTK

#include "endowire/io/vtk_poly_data.hpp"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkXMLPolyDataWriter.h>

#include "endowire/io/file.hpp"

namespace endowire::io {

void write_vtp(const std::filesystem::path& path, vtkPolyData& poly) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&poly);
  writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(false);
  writer->SetCompressorTypeToNone();
  writer->SetWriteToOutputString(true);
  writer->Write();
  write_file_atomically(path, writer->GetOutputString());
}

vtkNew<vtkPolyData> to_vtk(const vessel::TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.vertices_mm.size()));
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), mesh.vertices_mm[i].data());
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : mesh.triangles) {
    cells->InsertNextCell(3);
    for (const std::int32_t corner : triangle) cells->InsertCellPoint(corner);
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetPolys(cells);
  return poly;
}

vessel::TriangleMesh from_vtk(vtkPolyData& poly) {
  vessel::TriangleMesh mesh;
  mesh.vertices_mm.resize(static_cast<std::size_t>(poly.GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    poly.GetPoint(static_cast<vtkIdType>(i), mesh.vertices_mm[i].data());
  vtkNew<vtkIdList> corners;
  poly.GetPolys()->InitTraversal();
  while (poly.GetPolys()->GetNextCell(corners) != 0) {
    if (corners->GetNumberOfIds() != 3) continue;
    mesh.triangles.push_back({static_cast<std::int32_t>(corners->GetId(0)),
                              static_cast<std::int32_t>(corners->GetId(1)),
                              static_cast<std::int32_t>(corners->GetId(2))});
  }
  return mesh;
}

}  // namespace endowire::io

#endif

#include "endowire/io/decimate.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#endif

namespace endowire::io {

#ifdef ENDOWIRE_WITH_VTK

namespace {

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

}  // namespace

vessel::TriangleMesh decimated(const vessel::TriangleMesh& mesh, std::size_t max_triangles) {
  if (mesh.triangles.size() <= max_triangles) return mesh;
  const vtkNew<vtkPolyData> whole = to_vtk(mesh);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(whole);
  decimation->SetTargetReduction(1.0 - static_cast<double>(max_triangles) /
                                           static_cast<double>(mesh.triangles.size()));
  decimation->Update();
  vessel::TriangleMesh small = from_vtk(*decimation->GetOutput());
  // Edges that must not collapse can leave too many.
  return small.triangles.size() <= max_triangles + max_triangles / 10 ? small : vessel::TriangleMesh{};
}

#else

vessel::TriangleMesh decimated(const vessel::TriangleMesh& mesh, std::size_t max_triangles) {
  return mesh.triangles.size() <= max_triangles ? mesh : vessel::TriangleMesh{};
}

#endif

}  // namespace endowire::io

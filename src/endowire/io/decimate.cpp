#include "endowire/io/decimate.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <vtkQuadricDecimation.h>

#include "endowire/io/vtk_poly_data.hpp"
#endif

namespace endowire::io {

#ifdef ENDOWIRE_WITH_VTK

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

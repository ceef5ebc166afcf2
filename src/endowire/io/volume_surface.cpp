#include "endowire/io/volume_surface.hpp"

#include "endowire/base/error.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "endowire/io/decimate.hpp"
#include "endowire/io/vtk_poly_data.hpp"
#endif

namespace endowire::io {

#ifdef ENDOWIRE_WITH_VTK

namespace {

constexpr std::size_t max_triangles = 300'000;
/// Steps of a label map are half a voxel high and take more passes than the waves of grey levels.
constexpr int passes_of_labels = 20;
constexpr int passes_of_grey_levels = 10;
constexpr double pass_band =
    0.08;  // of the highest frequency a mesh has: waves longer than some ten edges stay

/// In the grid's own directions, in millimetres from voxel (0, 0, 0) of the volume.
vtkNew<vtkPolyData> flying_edges(const LumenImage& image, const Eigen::Vector3d& spacing_mm) {
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(static_cast<int>(image.size[0]), static_cast<int>(image.size[1]),
                      static_cast<int>(image.size[2]));
  grid->SetSpacing(spacing_mm.data());
  const Eigen::Vector3d origin = spacing_mm.cwiseProduct(
      Eigen::Vector3d(static_cast<double>(image.first[0]), static_cast<double>(image.first[1]),
                      static_cast<double>(image.first[2])));
  grid->SetOrigin(origin.data());
  vtkNew<vtkFloatArray> values;
  // VTK reads the values and does not keep them.
  values->SetArray(const_cast<float*>(image.inside.data()), static_cast<vtkIdType>(image.inside.size()), 1);
  grid->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(grid);
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeScalarsOff();
  edges->Update();
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(edges->GetOutput());
  return surface;
}

void smooth(vtkPolyData& surface, int passes) {
  vtkNew<vtkWindowedSincPolyDataFilter> filter;
  filter->SetInputData(&surface);
  filter->SetNumberOfIterations(passes);
  filter->SetPassBand(pass_band);
  filter->FeatureEdgeSmoothingOff();
  filter->BoundarySmoothingOff();
  filter->NonManifoldSmoothingOn();
  filter->NormalizeCoordinatesOn();
  filter->Update();
  surface.ShallowCopy(filter->GetOutput());
}

/// A point that lies where the image ends, and in which direction it does.
struct OnBorder {
  vtkIdType point;
  int axis;
  double at_mm;
};

/// Half a voxel outside the image's outermost voxels, where the surface of what goes on behind the border was closed.
std::vector<OnBorder> on_border(vtkPolyData& surface, const VolumeReport& report,
                                const Eigen::Vector3d& spacing_mm) {
  constexpr double rounding = 1e-3;  // of a voxel: values are single precision
  std::vector<OnBorder> border;
  for (vtkIdType p = 0; p < surface.GetNumberOfPoints(); ++p) {
    const Eigen::Vector3d place(surface.GetPoint(p));
    for (int axis = 0; axis < 3; ++axis) {
      const double voxel = place[axis] / spacing_mm[axis];
      const double last = static_cast<double>(report.size[static_cast<std::size_t>(axis)]) - 0.5;
      if (std::abs(voxel + 0.5) < rounding || std::abs(voxel - last) < rounding)
        border.push_back({p, axis, place[axis]});
    }
  }
  return border;
}

/// Smoothing would make domes of the flat ends at the border, and let their rims sink in.
void put_back(vtkPolyData& surface, const std::vector<OnBorder>& border) {
  for (const OnBorder& on : border) {
    std::array<double, 3> place{};
    surface.GetPoint(on.point, place.data());
    place[static_cast<std::size_t>(on.axis)] = on.at_mm;
    surface.GetPoints()->SetPoint(on.point, place.data());
  }
}

}  // namespace

vessel::TriangleMesh lumen_surface(Volume volume, const VolumeOptions& options, const std::string& file_label,
                                   VolumeReport& report) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  const Eigen::Vector3d origin = volume.origin_mm;
  const Eigen::Matrix3d directions = volume.step_mm * spacing.cwiseInverse().asDiagonal();
  const LumenImage image = lumen_of(std::move(volume), options, file_label);
  report = image.report;
  report.smoothing_passes =
      options.smooth.value_or(report.label_map ? passes_of_labels : passes_of_grey_levels);
  const vtkNew<vtkPolyData> surface = flying_edges(image, spacing);
  if (report.smoothing_passes > 0) {
    const std::vector<OnBorder> border = on_border(*surface, report, spacing);
    smooth(*surface, report.smoothing_passes);
    put_back(*surface, border);
  }
  vessel::TriangleMesh mesh = from_vtk(*surface);
  report.surface_triangles_before = mesh.triangles.size();
  if (mesh.triangles.size() > max_triangles)
    if (vessel::TriangleMesh small = decimated(mesh, max_triangles); !small.triangles.empty())
      mesh = std::move(small);
  report.surface_triangles = mesh.triangles.size();
  for (Eigen::Vector3d& v : mesh.vertices_mm) v = (origin + directions * v).eval();
  // The axes of many images are left-handed: placing the surface turned it inside out.
  if (directions.determinant() < 0.0)
    for (std::array<std::int32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

#else

vessel::TriangleMesh lumen_surface(Volume, const VolumeOptions&, const std::string& file_label,
                                   VolumeReport&) {
  throw base::InputError(
      file_label +
      ": is an image volume; this build has no VTK (ENDOWIRE_WITH_VTK is off) and reads STL, PLY and OBJ "
      "surfaces");
}

#endif

}  // namespace endowire::io

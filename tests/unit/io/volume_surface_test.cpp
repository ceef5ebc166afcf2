// A surface out of an image keeps the diameter of the lumen, wherever the vessel lies to the grid.
#include "endowire/io/volume_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/repair.hpp"
#include "endowire/vessel/winding.hpp"
#include "support/temporary_folder.hpp"
#include "support/volume_files.hpp"

namespace endowire::io {
namespace {

using Eigen::Vector3d;

#ifdef ENDOWIRE_WITH_VTK

struct Tube {
  double diameter_voxels;
  double tilt_deg;  ///< of its axis against the grid
  bool grey;
};

/// Mean distance of the wall from the axis in the middle of the tube, as a diameter, in voxels.
double measured_diameter(const Tube& tube) {
  test::Grid grid;
  grid.size = {44, 44, 44};
  grid.step_mm *= 0.6;
  grid.origin_mm = {100.0, -40.0, 7.0};
  const Vector3d middle = grid.place_mm(0, 0, 0) + 0.6 * Vector3d(21.3, 21.6, 21.5);
  const double tilt = tube.tilt_deg * std::numbers::pi / 180.0;
  const Vector3d along(std::sin(tilt) * 0.8, std::sin(tilt) * 0.6, std::cos(tilt));
  const double radius = 0.5 * 0.6 * tube.diameter_voxels;
  Volume volume = test::volume_of(grid, [&](const Vector3d& p) {
    const double inside = (radius - test::from_line_mm(p, middle, along)) / 0.6;
    return tube.grey ? 100.0 * std::clamp(inside + 0.5, 0.0, 1.0) : (inside > 0.0 ? 1.0 : 0.0);
  });
  volume.whole_numbers = !tube.grey;
  VolumeOptions options;
  if (tube.grey) options.threshold = 50.0;
  VolumeReport report;
  const vessel::TriangleMesh mesh = lumen_surface(volume, options, "tube", report);
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d centre = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    if (std::abs((centre - middle).dot(along)) > 6.0) continue;
    const double a = mesh.area_normal(t).norm();
    sum += a * test::from_line_mm(centre, middle, along);
    area += a;
  }
  return 2.0 * sum / area / 0.6;
}

TEST(VolumeSurface, KeepsTheDiameterOfTubes) {
  for (const bool grey : {false, true}) {
    double worst = 0.0;
    double worst_of_narrow = 0.0;
    for (const double diameter : {3.0, 4.0, 6.0, 9.0, 12.0})
      for (const double tilt_deg : {0.0, 20.0, 45.0}) {
        const double bias = measured_diameter({diameter, tilt_deg, grey}) - diameter;
        std::printf("%s, %4.1f voxels across, %2.0f deg: bias %+.3f voxels\n",
                    grey ? "grey levels" : "labels", diameter, tilt_deg, bias);
        double& worst_here = diameter < 3.5 ? worst_of_narrow : worst;
        worst_here = std::max(worst_here, std::abs(bias));
      }
    EXPECT_LT(worst, grey ? 0.15 : 0.2);
    EXPECT_LT(worst_of_narrow, grey ? 0.25 : 0.4);
  }
}

TEST(VolumeSurface, IsClosedAndLiesWhereTheImageDoes) {
  test::Grid grid;
  grid.step_mm = Eigen::AngleAxisd(0.7, Vector3d(3, 1, 2).normalized()).toRotationMatrix() *
                 Vector3d(0.5, 0.5, -0.8).asDiagonal();
  grid.origin_mm = {-50.0, 210.0, 900.0};
  const Vector3d middle = grid.place_mm(20, 18, 16);
  Volume volume =
      test::volume_of(grid, [&](const Vector3d& p) { return (p - middle).norm() < 6.0 ? 1.0 : 0.0; });
  volume.whole_numbers = true;
  VolumeReport report;
  const vessel::RepairedMesh repaired = vessel::repair(lumen_surface(volume, {}, "ball", report), "ball");
  EXPECT_TRUE(repaired.openings.empty());
  EXPECT_TRUE(repaired.pin_holes.empty());
  EXPECT_EQ(repaired.report.components, 1U);
  EXPECT_LT((repaired.report.bounds_mm.center() - middle).norm(), 0.2);
  EXPECT_NEAR(repaired.report.volume_mm3, 4.0 / 3.0 * std::numbers::pi * 216.0, 20.0);
}

TEST(VolumeSurface, LeftHandedAxesDoNotTurnItInsideOut) {
  for (const double sign : {1.0, -1.0}) {
    test::Grid grid;
    grid.step_mm = Vector3d(0.5, 0.6 * sign, 0.8).asDiagonal();
    grid.origin_mm = {10.0, 20.0, 30.0};
    // Neither its own mirror image nor in the middle.
    const Vector3d large = grid.place_mm(14, 12, 12);
    const Vector3d small = grid.place_mm(24, 22, 18);
    Volume volume = test::volume_of(grid, [&](const Vector3d& p) {
      return (p - large).norm() < 5.0 || (p - small).norm() < 3.0 ||
                     ((p - large).dot(small - large) > 0.0 && (p - small).dot(large - small) > 0.0 &&
                      test::from_line_mm(p, large, (small - large).normalized()) < 2.0)
                 ? 1.0
                 : 0.0;
    });
    volume.whole_numbers = true;
    VolumeReport report;
    const vessel::TriangleMesh mesh = lumen_surface(volume, {}, "v", report);
    EXPECT_GT(vessel::signed_volume_mm3(mesh), 400.0) << "faces inward";
    const vessel::RepairedMesh repaired = vessel::repair(mesh, "v");
    EXPECT_EQ(repaired.report.flipped_triangles, 0U);
    EXPECT_FALSE(repaired.report.inward_in_file);
    EXPECT_NEAR((vessel::bounds_mm(mesh).min() - (large - Vector3d::Constant(5.0))).x(), 0.0, 0.3);
    EXPECT_NEAR(vessel::winding_number(mesh, small), 1.0, 1e-6);
    EXPECT_NEAR(vessel::winding_number(mesh, large), 1.0, 1e-6);
  }
}

/// Area of what lies in the plane z = height, facing along z.
double flat_area_mm2(const vessel::TriangleMesh& mesh, double height_mm) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool flat = true;
    for (std::size_t k = 0; k < 3; ++k) flat = flat && std::abs(mesh.corner(t, k).z() - height_mm) < 1e-5;
    if (flat) area += 0.5 * mesh.area_normal(t).norm();
  }
  return area;
}

TEST(VolumeSurface, EndsAtTheBorderOfTheImageAreFlatAfterSmoothingToo) {
  for (const bool grey : {false, true}) {
    test::Grid grid;
    const Vector3d along = Vector3d(0.25, 0.0, 1.0).normalized();
    Volume volume = test::volume_of(grid, [&](const Vector3d& p) {
      const double inside = 5.0 - test::from_line_mm(p, {17, 18, 0}, along);
      return grey ? 300.0 * std::clamp(inside + 0.5, 0.0, 1.0) : (inside > 0.0 ? 1.0 : 0.0);
    });
    volume.whole_numbers = !grey;
    VolumeOptions options;
    if (grey) options.threshold = 150.0;
    VolumeReport report;
    const vessel::TriangleMesh mesh = lumen_surface(volume, options, "tube", report);
    EXPECT_GT(report.smoothing_passes, 0);
    const vessel::RepairedMesh repaired = vessel::repair(mesh, "tube");
    EXPECT_TRUE(repaired.openings.empty());
    EXPECT_EQ(repaired.report.components, 1U);
    // All but a chamfer: the rim falls by half a voxel within half a voxel.
    const double section = std::numbers::pi * 4.5 * 4.5 / along.z();
    for (const double end : {-0.5, 31.5})
      EXPECT_NEAR(flat_area_mm2(mesh, end), section, 0.12 * section) << (grey ? "grey, " : "labels, ") << end;
  }
}

TEST(VolumeSurface, AVesselThatLeavesTheImageIsClosedAtItsBorder) {
  test::Grid grid;
  Volume volume = test::volume_of(grid, [](const Vector3d& p) {
    return test::from_line_mm(p, {20, 18, 0}, {0, 0, 1}) < 5.0 ? 1.0 : 0.0;
  });
  volume.whole_numbers = true;
  VolumeOptions options;
  options.smooth = 0;
  VolumeReport report;
  const vessel::RepairedMesh repaired =
      vessel::repair(lumen_surface(volume, options, "tube", report), "tube");
  EXPECT_TRUE(repaired.openings.empty());
  EXPECT_NEAR(repaired.report.bounds_mm.min().z(), -0.5, 1e-6);
  EXPECT_NEAR(repaired.report.bounds_mm.max().z(), 31.5, 1e-6);
}

#else

TEST(VolumeSurface, ABuildWithoutVtkSaysSo) {
  VolumeReport report;
  EXPECT_NE(test::message_of<base::InputError>([&] {
              static_cast<void>(lumen_surface({}, {}, "v.nii", report));
            }).find("v.nii: is an image volume; this build has no VTK"),
            std::string::npos);
}

#endif

}  // namespace
}  // namespace endowire::io

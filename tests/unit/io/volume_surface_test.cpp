// A surface out of an image keeps the diameter of the lumen, wherever the vessel lies to the grid.
#include "endowire/io/volume_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/repair.hpp"
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

#include "endowire/vessel/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/vessel/repair.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Volume of a tube whose cross-section is a regular polygon.
double prism_mm3(double radius_mm, double length_mm, int around) {
  return 0.5 * around * std::sin(2.0 * std::numbers::pi / around) * radius_mm * radius_mm * length_mm;
}

TEST(Wall, AnEnclosedPieceIsTheLumen) {
  TriangleMesh mesh = test::sphere(12.0, 3);
  const TriangleMesh inner = test::sphere(10.0, 3);
  test::add_mesh(mesh, inner);
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_TRUE(repaired.report.wall_with_thickness);
  EXPECT_EQ(repaired.report.components_in_file, 2U);
  EXPECT_EQ(repaired.report.components, 1U);
  EXPECT_EQ(repaired.report.triangles, inner.triangles.size());
  EXPECT_EQ(repaired.report.wall_triangles, inner.triangles.size());
  EXPECT_NEAR(signed_volume_mm3(repaired.mesh), signed_volume_mm3(inner), 1e-6);  // outward
}

class ThickTube : public testing::TestWithParam<bool> {};

TEST_P(ThickTube, LeavesItsLumenOpenAtBothEnds) {
  TriangleMesh mesh = test::thick_tube(4.0, 6.0, 60.0, 24, 20);
  if (GetParam()) test::turn_over(mesh);
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_TRUE(repaired.report.wall_with_thickness);
  EXPECT_EQ(repaired.report.triangles, 2U * 24U * 20U);
  EXPECT_EQ(repaired.report.wall_triangles, 2U * 24U * 20U + 4U * 24U);
  ASSERT_EQ(repaired.openings.size(), 2U);
  for (const Opening& opening : repaired.openings) {
    EXPECT_NEAR(opening.diameter_mm, 8.0, 0.1);
    EXPECT_GT(opening.direction.dot(opening.centre_mm - Vector3d(0, 0, 30)), 29.9);
  }
  for (std::size_t t = 0; t < repaired.mesh.triangles.size(); ++t) {
    Vector3d axis_out = repaired.mesh.corner(t, 0);
    EXPECT_NEAR(axis_out.head<2>().norm(), 4.0, 1e-9);
    axis_out.z() = 0.0;
    ASSERT_GT(repaired.mesh.area_normal(t).dot(axis_out), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Facing, ThickTube, testing::Bool(),
                         [](const auto& p) { return p.param ? "Inward" : "Outward"; });

TEST(Wall, ARimWithoutAnEdgeIsCutAcross) {
  std::vector<Eigen::Vector2d>
      profile;  // walls from z = 0 to 60 between 4 and 6 mm, half rounds at both ends
  constexpr int steps = 20;
  for (int i = 0; i < steps; ++i) profile.emplace_back(6.0, 60.0 * i / steps);
  for (int i = 0; i < 8; ++i)
    profile.emplace_back(5.0 + std::cos(std::numbers::pi * i / 8), 60.0 + std::sin(std::numbers::pi * i / 8));
  for (int i = 0; i < steps; ++i) profile.emplace_back(4.0, 60.0 - 60.0 * i / steps);
  for (int i = 0; i < 8; ++i)
    profile.emplace_back(5.0 - std::cos(std::numbers::pi * i / 8), -std::sin(std::numbers::pi * i / 8));
  const RepairedMesh repaired = repair(test::turned(profile, 24), "m");
  EXPECT_TRUE(repaired.report.wall_with_thickness);
  EXPECT_TRUE(repaired.pin_holes.empty());
  ASSERT_EQ(repaired.openings.size(), 2U);
  for (const Opening& opening : repaired.openings) {
    EXPECT_NEAR(opening.diameter_mm, 8.0, 0.4);
    EXPECT_GT(opening.direction.dot(opening.centre_mm - Vector3d(0, 0, 30)), 28.0);
    for (std::int32_t v : opening.loop)
      EXPECT_LT(std::abs(opening.direction.dot(repaired.mesh.vertices_mm[static_cast<std::size_t>(v)] -
                                               opening.centre_mm)),
                0.4);
  }
}

TEST(Wall, OneThatIsClosedAtItsEndsLeavesAClosedLumen) {
  TriangleMesh mesh = test::closed_tube(6.0, 64.0, 24, 20);
  TriangleMesh inner = test::closed_tube(4.0, 60.0, 24, 20);
  test::turn_over(inner);
  test::add_mesh(mesh, inner, {0.0, 0.0, 2.0});
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_TRUE(repaired.report.wall_with_thickness);
  EXPECT_TRUE(repaired.openings.empty());
  EXPECT_NEAR(repaired.report.volume_mm3, prism_mm3(4.0, 60.0, 24), 1e-6);
}

TEST(Wall, LumensAreNone) {
  const TriangleMesh tube = test::open_tube(4.0, 60.0, 24, 20);
  TriangleMesh bundle;  // each sees others all round, but behind each wall lies its own other side
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      test::add_mesh(bundle, test::open_tube(2.0, 80.0, 12, 16), {5.0 * i, 5.0 * j, 0});
  for (const TriangleMesh& lumen : {tube, test::sphere(10.0, 3), test::torus(20.0, 5.0, 40, 16), bundle}) {
    const RepairedMesh repaired = repair(lumen, "m");
    EXPECT_FALSE(repaired.report.wall_with_thickness);
    EXPECT_EQ(repaired.report.wall_triangles, 0U);
  }
}

}  // namespace
}  // namespace endowire::vessel

#include "endowire/vessel/repair.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/closure.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

/// Every edge is shared by two triangles that run along it in opposite directions.
void expect_watertight(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << "edge " << edge.first << " → " << edge.second;
    ASSERT_TRUE(edges.contains({edge.second, edge.first})) << "edge " << edge.first << " → " << edge.second;
  }
}

TEST(Repair, MergesPointsAndDropsWhatIsNoTriangle) {
  TriangleMesh mesh = test::sphere(10.0, 3);
  const std::size_t triangles = mesh.triangles.size();
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back(mesh.triangles[5]);
  std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);  // turned, yet the same triangle
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.triangles, triangles);
  EXPECT_EQ(repaired.report.vertices, triangles / 2 + 2);  // Euler
  EXPECT_EQ(repaired.report.degenerate_triangles, 1U);
  EXPECT_EQ(repaired.report.duplicate_triangles, 1U);
  EXPECT_EQ(repaired.report.components, 1U);
  EXPECT_TRUE(repaired.openings.empty());
  expect_watertight(repaired.mesh);
}

TEST(Repair, EveryOrientationEndsOutward) {
  const TriangleMesh out = test::sphere(10.0, 3);
  TriangleMesh in = out;
  TriangleMesh mixed = out;
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    std::swap(in.triangles[t][0], in.triangles[t][1]);
    if (t % 3 == 0) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  }
  const RepairedMesh expected = repair(out, "m");
  EXPECT_GT(signed_volume_mm3(expected.mesh), 4000.0);
  for (const TriangleMesh& other : {in, mixed})
    EXPECT_EQ(repair(other, "m").mesh.triangles, expected.mesh.triangles);
  EXPECT_TRUE(repair(in, "m").report.inward_in_file);
  EXPECT_FALSE(repair(mixed, "m").report.inward_in_file);
}

TEST(Repair, OrderOfTrianglesChangesNothing) {
  const TriangleMesh mesh = test::torus(20.0, 5.0, 40, 16);
  const RepairedMesh a = repair(mesh, "m");
  const RepairedMesh b = repair(test::shuffled(mesh, 5), "m");
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(content_hash(a.mesh), content_hash(b.mesh));
}

TEST(Repair, OpenTubeHasTwoOpenings) {
  const RepairedMesh repaired = repair(test::open_tube(5.0, 40.0, 24, 20), "m");
  ASSERT_EQ(repaired.openings.size(), 2U);
  EXPECT_TRUE(repaired.pin_holes.empty());
  EXPECT_GT(repaired.report.area_mm2, 0.0);
  for (const Opening& o : repaired.openings) {
    const double side = o.centre_mm.z() < 20.0 ? -1.0 : 1.0;
    EXPECT_LT((o.centre_mm - Eigen::Vector3d(0, 0, 20.0 + 20.0 * side)).norm(), 1e-9);
    EXPECT_LT((o.direction - Eigen::Vector3d(0, 0, side)).norm(), 1e-9);
    EXPECT_NEAR(o.diameter_mm, 10.0, 0.1);
    EXPECT_EQ(o.number, &o - repaired.openings.data() + 1);
  }
  const ClosedSurface closed = close_surface(repaired, 60.0);
  expect_watertight(closed.mesh);
  for (const VirtualTube& tube : closed.tubes) EXPECT_NEAR(tube.end_mm - tube.begin_mm, 60.0, 1e-9);
}

TEST(Repair, MissingTrianglesInAWallArePinHoles) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 40);
  mesh.triangles.erase(mesh.triangles.begin() + 900, mesh.triangles.begin() + 902);
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_TRUE(repaired.openings.empty());
  ASSERT_EQ(repaired.pin_holes.size(), 1U);
  EXPECT_NEAR(repaired.pin_holes[0].diameter_mm, 1.29, 0.02);  // a hole of 1.305 × 1 mm
  expect_watertight(close_surface(repaired, 60.0).mesh);
}

TEST(Repair, DebrisGoesAndASecondVesselStays) {
  TriangleMesh mesh = test::closed_tube(8.0, 100.0, 32, 20);
  test::add_mesh(mesh, test::closed_tube(1.0, 40.0, 16, 20), {30.0, 0.0, 0.0});
  test::add_mesh(mesh, test::sphere(0.3, 1), {-20.0, 5.0, 7.0});
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.components_in_file, 3U);
  EXPECT_EQ(repaired.report.components, 2U);
  ASSERT_EQ(repaired.report.debris.count, 1U);
  EXPECT_LT((repaired.report.debris.first_mm[0] - Eigen::Vector3d(-20.0, 5.0, 7.0)).norm(), 0.31);
}

TEST(Repair, ASurfaceOfOneSideIsRefusedWithItsPlace) {
  TriangleMesh strip;  // half a turn around z
  constexpr int steps = 40;
  for (int i = 0; i < steps; ++i) {
    const double u = 2.0 * std::numbers::pi * i / steps;
    for (const double side : {-5.0, 5.0})
      strip.vertices_mm.emplace_back((30.0 + side * std::cos(u / 2)) * std::cos(u),
                                     (30.0 + side * std::cos(u / 2)) * std::sin(u), side * std::sin(u / 2));
  }
  for (int i = 0; i < steps; ++i) {
    const bool last = i == steps - 1;  // the ends meet crosswise
    const int a = 2 * i;
    const int b = 2 * i + 1;
    const int c = last ? 1 : 2 * i + 2;
    const int d = last ? 0 : 2 * i + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  try {
    static_cast<void>(repair(strip, "strip.stl"));
    ADD_FAILURE() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("strip.stl: the surface has one side only"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find(") mm"), std::string::npos) << error.what();
  }
}

TEST(Repair, RefusesAbsurdSizesAndNamesTheUnit) {
  const auto said = [](double radius_mm, LengthUnit unit) -> std::string {
    try {
      static_cast<void>(repair(test::sphere(radius_mm, 2), "vessel.mm.stl", unit));
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(
      said(0.591 / std::sqrt(12.0), LengthUnit::millimetre),
      "vessel.mm.stl: extent is 0.591 mm; must be 5 … 3e+03 mm; was it saved in metres? then unit = \"m\"");
  EXPECT_NE(said(1e5, LengthUnit::metre).find("then unit = \"mm\""), std::string::npos);
  EXPECT_EQ(said(10.0, LengthUnit::millimetre), "accepted");
}

}  // namespace
}  // namespace endowire::vessel

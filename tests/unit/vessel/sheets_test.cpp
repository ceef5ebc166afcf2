#include "endowire/vessel/sheets.hpp"

#include <gtest/gtest.h>

#include "endowire/vessel/repair.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

TEST(Sheets, AFinIsDropped) {
  TriangleMesh mesh = test::sphere(10.0, 3);
  const RepairedMesh without = repair(mesh, "m");
  const auto apex = static_cast<std::int32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.emplace_back(1.0, 1.0, 1.0);
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], apex});
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.non_manifold_edges.count, 1U);
  EXPECT_EQ(repaired.report.fins.count, 1U);
  EXPECT_TRUE(repaired.pin_holes.empty());
  EXPECT_EQ(content_hash(repaired.mesh), content_hash(without.mesh));
}

TEST(Sheets, AFlapAgainstTheWallStaysAndItsBorderIsAPinHole) {
  TriangleMesh mesh = test::sphere(10.0, 3);
  const auto apex = static_cast<std::int32_t>(mesh.vertices_mm.size());
  const Vector3d middle = (mesh.corner(0, 0) + mesh.corner(0, 1) + mesh.corner(0, 2)) / 3.0;
  mesh.vertices_mm.emplace_back(middle + 0.2 * middle.normalized());
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], apex});
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.fins.count, 0U);
  EXPECT_EQ(repaired.pin_holes.size(), 1U);
}

TEST(Sheets, AMembraneAcrossTheLumenIsDropped) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 20);
  const RepairedMesh without = repair(mesh, "m");
  const auto middle = static_cast<std::int32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.emplace_back(0.0, 0.0, 20.0);
  for (std::int32_t j = 0; j < 24; ++j) mesh.triangles.push_back({240 + j, 240 + (j + 1) % 24, middle});
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.non_manifold_edges.count, 24U);
  ASSERT_EQ(repaired.report.membranes.count, 1U);
  EXPECT_NEAR(repaired.report.membranes.first_mm[0].z(), 20.0, 1e-9);
  EXPECT_EQ(content_hash(repaired.mesh), content_hash(without.mesh));
}

TEST(Sheets, VesselsThatTouchAlongAnEdgeStay) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 20);
  test::add_mesh(mesh, test::closed_tube(5.0, 40.0, 24, 20), {10.0, 0.0, 0.0});  // they share the line x = 5
  const std::size_t triangles = mesh.triangles.size();
  const RepairedMesh repaired = repair(mesh, "m");
  EXPECT_EQ(repaired.report.non_manifold_edges.count, 20U);
  EXPECT_EQ(repaired.report.triangles, triangles);
}

}  // namespace
}  // namespace endowire::vessel

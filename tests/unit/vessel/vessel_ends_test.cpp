#include "endowire/vessel/vessel_ends.hpp"

#include <gtest/gtest.h>

#include "endowire/vessel/centreline.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

TEST(VesselEnds, OpeningsAreNumberedAsTheMeshCountsThem) {
  const RepairedMesh tube = repair(test::open_tube(4.0, 60.0, 24, 30), "tube");
  const std::vector<VesselEnd> ends = vessel_ends(tube, extract_centrelines(tube));
  ASSERT_EQ(ends.size(), 2U);
  for (const VesselEnd& end : ends) {
    const Opening& opening = tube.openings[static_cast<std::size_t>(end.number - 1)];
    EXPECT_TRUE(end.open);
    EXPECT_EQ(end.access_mm, opening.centre_mm);
    EXPECT_EQ(end.inward, -opening.direction);
    EXPECT_EQ(end.branch, "1");
    EXPECT_NEAR((end.inside_mm - end.centre_mm).norm(), 4.0, 0.3);
  }
}

TEST(VesselEnds, CapsOfAClosedVesselAreEndsAfterItsOpenings) {
  TriangleMesh mesh = test::closed_tube(4.0, 60.0, 24, 30);
  const RepairedMesh closed = repair(mesh, "tube");
  std::vector<VesselEnd> ends = vessel_ends(closed, extract_centrelines(closed));
  ASSERT_EQ(ends.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(ends[k].number, static_cast<int>(k + 1));
    EXPECT_FALSE(ends[k].open);
    const double side = ends[k].centre_mm.z() < 30.0 ? -1.0 : 1.0;
    EXPECT_NEAR(ends[k].centre_mm.z(), 30.0 + 30.0 * side, 1.0);
    EXPECT_NEAR(ends[k].direction.z(), side, 0.01);
    EXPECT_NEAR(ends[k].diameter_mm, 8.0, 0.3);
    EXPECT_NEAR(ends[k].access_mm.z(), 30.0 + 26.0 * side, 1.0);  // a radius inside
    EXPECT_NEAR(ends[k].inward.z(), -side, 0.01);
  }
  // One end opened: it comes first.
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return t[2] == static_cast<std::int32_t>(mesh.vertices_mm.size() - 2);
  });
  const RepairedMesh half = repair(mesh, "tube");
  ends = vessel_ends(half, extract_centrelines(half));
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_TRUE(ends[0].open);
  EXPECT_NEAR(ends[0].centre_mm.z(), 0.0, 1e-9);
  EXPECT_FALSE(ends[1].open);
  EXPECT_EQ(ends[1].number, 2);
}

}  // namespace
}  // namespace endowire::vessel

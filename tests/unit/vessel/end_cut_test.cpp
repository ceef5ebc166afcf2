#include "endowire/vessel/end_cut.hpp"

#include <gtest/gtest.h>

#include "endowire/vessel/repair.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

TEST(EndCut, AnEvenEndStays) {
  TriangleMesh mesh = test::open_tube(5.0, 40.0, 24, 20);
  const std::uint64_t before = content_hash(mesh);
  EXPECT_EQ(cut_ragged_ends(mesh), 0U);
  EXPECT_EQ(content_hash(mesh), before);
}

TEST(EndCut, ARaggedEndBecomesAPlaneAcrossTheVessel) {
  TriangleMesh mesh = test::open_tube(5.0, 40.0, 24, 20);
  std::size_t next = 0;  // teeth of up to three rings at z = 40
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const std::size_t ring = static_cast<std::size_t>(t[0]) / 24;
    return ring >= 17 && (next++ % 7 < 3 || ring + next % 3 > 20);
  });
  EXPECT_EQ(cut_ragged_ends(mesh), 1U);
  const RepairedMesh repaired = repair(mesh, "m");
  ASSERT_EQ(repaired.openings.size(), 2U);
  const Opening& cut = repaired.openings[repaired.openings[0].centre_mm.z() > 20.0 ? 0 : 1];
  EXPECT_NEAR(cut.centre_mm.z(), 33.8, 0.3);  // just below the lowest tooth's root
  EXPECT_NEAR(cut.diameter_mm, 10.0, 0.1);
  EXPECT_GT(cut.direction.z(), 0.999);
  for (std::int32_t v : cut.loop)
    EXPECT_NEAR(repaired.mesh.vertices_mm[static_cast<std::size_t>(v)].z(), cut.centre_mm.z(), 0.1);
}

}  // namespace
}  // namespace endowire::vessel

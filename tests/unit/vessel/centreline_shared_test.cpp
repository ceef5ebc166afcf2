// Centrelines of the real vessels in ../shared: in the lumen, whole, and the same for any order of triangles.
// Against centrelines that others made: tests/vessels/centreline_reference_test.cpp.
#include <gtest/gtest.h>

#include "endowire/vessel/centreline.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/centreline_checks.hpp"
#include "support/generated_meshes.hpp"
#include "support/shared_vessels.hpp"

namespace endowire::vessel {
namespace {

struct Expected {
  const char* file;  ///< in the folder of shared vessels
  long openings;
  long least_caps, most_caps;
};

// Ends as counted on pictures of the meshes; where a skull base is too coarse to count, a range.
constexpr std::array<Expected, 7> vessels{{{"femoral_to_neuro/lumen_mm.stl", 0, 16, 26},
                                           {"femoral_to_neuro_fine/lumen_mm.stl", 4, 14, 26},
                                           {"aortoiliac/lumen_mm.stl", 0, 3, 3},
                                           {"aortoiliac/aorta-surface-open-ends.stl", 3, 0, 0},
                                           {"carotid_bifurcation/lumen_mm.stl", 3, 0, 0},
                                           {"branching_phantom/lumen_mm.stl", 8, 0, 0},
                                           {"abdominal_aorta_phantom/inner_lumen_mm.stl", 6, 0, 0}}};

class SharedVesselCentreline : public testing::TestWithParam<Expected> {};

TEST_P(SharedVesselCentreline, LiesInTheLumenAndReachesEveryEnd) {
  const std::string path = std::string(ENDOWIRE_SHARED_DIR) + "/vessels/" + GetParam().file;
  const std::vector<std::byte> bytes = test::read_bytes(path);
  if (bytes.empty()) GTEST_SKIP() << "no " << path << ": the shared vessels are not here";
  const TriangleMesh soup = parse_stl(bytes, path);
  const RepairedMesh repaired = repair(soup, path);
  const CentrelineTree tree = extract_centrelines(repaired);
  test::expect_tree_in_lumen(tree, repaired);
  EXPECT_EQ(test::count_ends(tree, CentrelineEndKind::opening), GetParam().openings);
  EXPECT_EQ(static_cast<std::size_t>(GetParam().openings), repaired.openings.size());
  EXPECT_GE(test::count_ends(tree, CentrelineEndKind::cap), GetParam().least_caps);
  EXPECT_LE(test::count_ends(tree, CentrelineEndKind::cap), GetParam().most_caps);
  EXPECT_EQ(std::count_if(tree.branches().begin(), tree.branches().end(),
                          [](const auto& b) { return b.parent < 0; }),
            1);
  EXPECT_EQ(extract_centrelines(repair(test::shuffled(soup, 3), path)).serialise(1), tree.serialise(1));
}

INSTANTIATE_TEST_SUITE_P(All, SharedVesselCentreline, testing::ValuesIn(vessels), [](const auto& instance) {
  std::string name = instance.param.file;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

}  // namespace
}  // namespace endowire::vessel

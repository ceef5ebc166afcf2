// The same shapes and forces as before: scenes against what tests/references/recorded keeps. No closed form exists for a wire in a
// vessel; what is kept was made by this program, and its bounds say how far a sound solver may lie from it (cases/reference.hpp).
// `make references` makes them anew, which a commit that changes numbers has to explain under *Numerics*.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "reference.hpp"

namespace endowire::test {

std::ostream& operator<<(std::ostream& out, const ReferenceScene& scene) {
  return out << scene.name;
}

namespace {

class SameAsBefore : public testing::TestWithParam<ReferenceScene> {};

/// Fewer moments than this compared, and the test would hold little.
constexpr int kLeastCompared = kMoments / 2;

// Breaks with a friction coefficient 1 % off, a stiffness of a section that is lost, a predictor that leaves its mark in the result.
TEST_P(SameAsBefore, ShapeAndPushLieWithinTheSolversTolerance) {
  const ReferenceScene& scene = GetParam();
  if (scene.real_vessel && !std::filesystem::exists(std::string(ENDOWIRE_SHARED_DIR) + "/vessels"))
    GTEST_SKIP() << "the vessels of ../shared are not there";
  const std::vector<KeptMoment> kept = read_kept(scene);
  const std::vector<Moment> now = play(scene);
  ASSERT_EQ(now.size(), kept.size());
  ASSERT_EQ(now.size(), static_cast<std::size_t>(kMoments));
  int compared = 0;
  for (std::size_t m = 0; m < now.size(); ++m) {
    const Moment& before = kept[m].moment;
    ASSERT_EQ(now[m].step, before.step) << "the scene takes other steps; `make references`";
    EXPECT_TRUE(now[m].converged) << "step " << before.step << " or one before it";
    const std::optional<Bounds>& bounds = now[m].rods == before.rods ? kept[m].same_rods : kept[m].other_rods;
    if (!bounds) continue;
    ++compared;
    EXPECT_LE(apart_mm(now[m], before), bounds->shape_mm)
        << "step " << before.step << ", rods " << before.rods << " before, " << now[m].rods << " now";
    EXPECT_NEAR(now[m].push_n, before.push_n, bounds->push_n) << "step " << before.step;
    EXPECT_NEAR(now[m].inserted_mm, before.inserted_mm, bounds->shape_mm) << "step " << before.step;
  }
  EXPECT_GE(compared, kLeastCompared);
}

INSTANTIATE_TEST_SUITE_P(All, SameAsBefore, testing::ValuesIn(reference_scenes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace endowire::test

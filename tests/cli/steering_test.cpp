// A wire is steered into the carotid arteries of an anatomy made in code; what it is steered by is what brings it there.
#include "support/steered_scene.hpp"

namespace endowire {
namespace {

class SteeringGenerated : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
#ifndef ENDOWIRE_JUDGE
    GTEST_SKIP() << "check_crossings is not part of this build";
#endif
  }
  std::string scene = test::shipped_scene(GetParam());
};

TEST_P(SteeringGenerated, ReachesTheCarotid) {
  test::expect_arrival(test::summary_of(scene));
}

TEST_P(SteeringGenerated, MissesWithoutTorque) {
  test::expect_wrong_vessel(test::summary_of(test::without_torque(scene)));
}

TEST_P(SteeringGenerated, MissesWithAStraightTip) {
  test::expect_wrong_vessel(test::summary_of(test::with_straight_tip(scene)));
}

TEST_P(SteeringGenerated, ReachesItWithTurnsOffBy10DegreesOtherRodsAndSteps) {
  for (const std::string& other :
       {test::with_turns_off_by(scene, -10.0), test::with_turns_off_by(scene, 10.0),
        test::with_rods_of(scene, 2.0), test::with_rods_of(scene, 8.0), test::with_steps_of(scene, 0.5)})
    EXPECT_EQ(test::summary_of(other)["target"]["reached"], true);
}

INSTANTIATE_TEST_SUITE_P(Arch, SteeringGenerated,
                         testing::Values("generated_left_carotid.toml", "generated_right_carotid.toml"),
                         [](const auto& scene) {
                           return std::string(scene.param).find("left") != std::string::npos ? "Left"
                                                                                             : "Right";
                         });

}  // namespace
}  // namespace endowire

// A wire is steered from the groin into the carotid arteries of a patient; what it is steered by is what brings it
// there.
#include "support/shared_vessels.hpp"
#include "support/steered_scene.hpp"

namespace endowire {
namespace {

class Steering : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::shared_vessel_path("femoral_to_neuro")))
      GTEST_SKIP() << "../shared/vessels/femoral_to_neuro is not here";
    scene = test::shipped_scene(GetParam());
  }
  std::string scene;
};

TEST_P(Steering, ReachesTheCarotid) {
  test::expect_arrival(test::summary_of(scene));
}

TEST_P(Steering, MissesWithoutTorque) {
  test::expect_wrong_vessel(test::summary_of(test::without_torque(scene)));
}

TEST_P(Steering, MissesWithAStraightTip) {
  test::expect_wrong_vessel(test::summary_of(test::with_straight_tip(scene)));
}

TEST_P(Steering, ReachesItWithTurnsOffBy10DegreesOtherRodsAndSteps) {
  for (const std::string& other :
       {test::with_turns_off_by(scene, -10.0), test::with_turns_off_by(scene, 10.0),
        test::with_rods_of(scene, 2.0), test::with_rods_of(scene, 8.0), test::with_steps_of(scene, 0.5)})
    EXPECT_EQ(test::summary_of(other)["target"]["reached"], true);
}

INSTANTIATE_TEST_SUITE_P(Femoral, Steering, testing::Values("femoral_to_left_carotid.toml"),
                         [](const auto&) { return std::string("LeftCarotid"); });

}  // namespace
}  // namespace endowire

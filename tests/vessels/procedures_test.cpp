// The main job, and a curved tip that is turned against the wall.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "support/temporary_folder.hpp"
#include "vessel_run.hpp"

namespace endowire {
namespace {

constexpr double kTurn_rad = std::numbers::pi / 18.0;  // 36 of them are a full turn

/// The access of scenes/femoral_entry.toml.
sim::Access femoral() {
  return {{-30.0, 66.5, 6.5}, {-0.75, -0.65, 0.15}};
}

class RealVessel : public testing::Test {
 protected:
  /// Plays the commands `push` times, then `turn` times, and holds the run against what must hold.
  void hold(const char* name, const sim::Access& access, int pushes, double advance_mm, int turns) {
    const test::Vessel* vessel = test::shared_vessel(name);
    if (vessel == nullptr) GTEST_SKIP() << "../shared/vessels/" << name << " is not here";
    const test::TemporaryFolder folder;
    int step = 0;
    const auto hand = [&](const sim::Simulation&) {
      return step++ < pushes ? sim::Command{advance_mm, 0.0} : sim::Command{0.0, kTurn_rad};
    };
    run_ = test::play(*vessel, access, pushes + turns, hand, folder.path());
    std::printf("%s: %s\n", name, run_.text().c_str());
    test::expect_all_that_must_hold(run_);
    EXPECT_GT(run_.max_deflection_mm, 0.001) << "the wire touched nothing";
  }

  test::RunFigures run_;
};

TEST_F(RealVessel, FromTheFemoralAccessToTheArch) {
  hold("femoral_to_neuro", femoral(), 450, 1.0, 0);
}

TEST_F(RealVessel, ACurvedTipTurnsTenTimesAgainstTheWall) {
  hold("femoral_to_neuro", femoral(), 450, 1.0, 360);
}

// A wire of which 370 mm are pushed into a vessel of 120 mm that is closed at its end folds, fills it, and slips in the hand.
TEST_F(RealVessel, AWireIsPushedIntoADeadEnd) {
  hold("aortoiliac", {{211.2, 106.8, 29.9}, {0.2, 0.97, -0.11}}, 370, 1.0, 0);
  EXPECT_NEAR(run_.max_push_n, 2.0, 1e-6) << "the grip's limit";
}

// A hand that rests: every step converges, and after a few the wire stays where it is.
TEST_F(RealVessel, AWireComesToRest) {
  const test::Vessel* vessel = test::shared_vessel("femoral_to_neuro");
  if (vessel == nullptr) GTEST_SKIP() << "../shared/vessels/femoral_to_neuro is not here";
  sim::Simulation simulation(vessel->field, test::hydrophilic_wire(), femoral(), test::lying_patient());
  constexpr int kSettling = 15;
  for (int push = 1; push <= 450; ++push) {
    ASSERT_TRUE(simulation.step({1.0, 0.0}).converged) << push;
    if (push % 30 != 0) continue;
    const sim::State moving = simulation.state();
    for (int rest = 0; rest < kSettling; ++rest)
      ASSERT_TRUE(simulation.step({0.0, 0.0}).converged) << "rest " << rest << " after " << push;
    const std::vector<Eigen::Vector3d> settled = simulation.state().joints_mm;
    for (int rest = 0; rest < 10; ++rest) ASSERT_TRUE(simulation.step({0.0, 0.0}).converged);
    double wandered_mm = 0.0;
    for (std::size_t j = 0; j < settled.size(); ++j)
      wandered_mm = std::max(wandered_mm, (simulation.state().joints_mm[j] - settled[j]).norm());
    EXPECT_LT(wandered_mm, 0.01) << "after " << push;
    simulation.restore(moving);
  }
}

// The end of the curved tip comes out of the sheath at the last of these steps, where a jump of the rest curvature once made Newton go to
// and fro.
TEST_F(RealVessel, TheEndOfTheCurvedTipComesOutOfTheSheath) {
  const test::Vessel* vessel = test::shared_vessel("femoral_to_neuro");
  if (vessel == nullptr) GTEST_SKIP() << "../shared/vessels/femoral_to_neuro is not here";
  const sim::Access access{{-44.0, 11.8, 13.8}, {-0.91, 0.01, 0.41}};
  sim::Simulation simulation(vessel->field, test::hydrophilic_wire(), access, test::lying_patient());
  for (int push = 1; push <= 12; ++push) {
    const sim::StepReport& report = simulation.step({1.0, 0.0});
    EXPECT_TRUE(report.converged) << push;
    EXPECT_EQ(report.splits, 0) << push;
  }
}

// Ten millimetres of advance in one command.
TEST_F(RealVessel, LongCommandsHold) {
  hold("femoral_to_neuro", femoral(), 45, 10.0, 0);
}

}  // namespace
}  // namespace endowire

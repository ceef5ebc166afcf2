// The main job on a real vessel: femoral access, 450 mm towards the arch, with the numbers of scenes/femoral_entry.toml.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "endowire/vessel/mesh_field.hpp"
#include "support/shared_vessels.hpp"
#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

struct Totals {
  int steps = 0, converged = 0, split = 0, verifications = 0, iterations = 0, snaps = 0;
  double detections = 0.0, deflection_mm = 0.0, push_n = 0.0;
};

class SlowSharedVessel : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string path = test::shared_vessel_path("femoral_to_neuro");
    const std::vector<std::byte> bytes = test::read_bytes(path);
    if (bytes.empty()) return;
    field_ = std::make_shared<vessel::MeshField>(
        vessel::MeshField::build(vessel::repair(vessel::parse_stl(bytes, path), path)));
    SimulationSpec spec;
    spec.gravity_m_per_s2 = {0.0, 0.0, -9.81};
    Simulation simulation(field_, test::hydrophilic_035_angled(), {{-30.0, 66.5, 6.5}, {-0.75, -0.65, 0.15}},
                          spec);
    for (int i = 0; i < 450; ++i) {
      const StepReport& r = simulation.step({1.0, 0.0});
      ++totals_.steps;
      totals_.converged += r.converged;
      totals_.split += r.splits > 0;
      totals_.detections += r.detections;
      totals_.verifications += r.verifications;
      totals_.iterations += r.newton_iterations;
      totals_.snaps += r.snapped;
      totals_.deflection_mm = std::max(totals_.deflection_mm, r.max_wall_deflection_mm);
      totals_.push_n = std::max(totals_.push_n, r.push_force_n);
    }
    inserted_mm_ = simulation.state().inserted_mm;
    std::printf(
        "femoral_to_neuro: %d steps, %d converged, %d split, %.4f detections and %.4f verifications a step, "
        "%.2f "
        "iterations a step, %d snaps, deflection %.4f mm, push %.3f N, inserted %.2f mm\n",
        totals_.steps, totals_.converged, totals_.split, totals_.detections / 450.0,
        totals_.verifications / 450.0, totals_.iterations / 450.0, totals_.snaps, totals_.deflection_mm,
        totals_.push_n, inserted_mm_);
  }
  static void TearDownTestSuite() { field_.reset(); }
  void SetUp() override {
    if (!field_)
      GTEST_SKIP() << "the shared vessels are not here: " << test::shared_vessel_path("femoral_to_neuro");
  }

  static inline std::shared_ptr<const vessel::Field> field_;
  static inline Totals totals_;
  static inline double inserted_mm_ = 0.0;
};

TEST_F(SlowSharedVessel, EveryStepConverges) {
  EXPECT_EQ(totals_.converged, 450);
  EXPECT_GT(inserted_mm_, 445.0);
}

TEST_F(SlowSharedVessel, AtMostTwoPercentOfTheStepsAreSplit) {
  EXPECT_LE(totals_.split, 9);
}

TEST_F(SlowSharedVessel, TheWallYieldsNoDeeperThanItsCap) {
  EXPECT_LE(totals_.deflection_mm, 0.15);
  EXPECT_GT(totals_.deflection_mm, 0.001) << "the wire touched nothing";
}

TEST_F(SlowSharedVessel, OneDetectionAStep) {
  EXPECT_LE(totals_.detections, 1.05 * 450.0);
}

}  // namespace
}  // namespace endowire::sim

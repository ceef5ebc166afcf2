// The ways to look for walls, compared where they must agree: docs/paper.md tells where they do not.
#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

struct Outcome {
  State state;
  double detections = 0.0;
  int steps = 0;
  int iterations = 0;
};

Outcome pushed(Detection detection) {
  SimulationSpec spec;
  spec.solver.detection = detection;
  Simulation simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), spec);
  Outcome outcome;
  for (; outcome.steps < 70; ++outcome.steps) {
    const StepReport& report = simulation.step({1.0, 0.02});
    EXPECT_TRUE(report.converged) << outcome.steps;
    EXPECT_EQ(report.splits, 0) << outcome.steps;
    outcome.detections += report.detections;
    outcome.iterations += report.newton_iterations;
  }
  outcome.state = simulation.state();
  return outcome;
}

// On a smooth wall local walls that follow the wire are as good as those detected anew. Breaks when detection in every
// iteration finds other walls than the first one, or is not counted.
TEST(Detection, EveryIterationGivesTheShapeOfOneDetection) {
  const Outcome needed = pushed(Detection::as_needed);
  const Outcome every = pushed(Detection::every_iteration);
  EXPECT_LT(test::shape_difference_mm(needed.state, every.state), 0.02);
  EXPECT_GE(every.detections, every.iterations - every.steps);
  EXPECT_GT(every.detections, 3.0 * needed.detections);
}

TEST(Detection, OnceIsOnce) {
  const Outcome once = pushed(Detection::once);
  EXPECT_LE(once.detections, once.steps);
  EXPECT_LT(test::shape_difference_mm(once.state, pushed(Detection::as_needed).state), 0.02);
}

}  // namespace
}  // namespace endowire::sim

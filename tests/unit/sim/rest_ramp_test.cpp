// Where the rest curvature ends, the hand feels no jump.
#include <gtest/gtest.h>

#include <memory>

#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

/// Push at the hand of a wire without friction whose tip is curved over 10 mm, in a straight tube hardly wider than the wire, after nine pushes
/// of 1 mm and one more to `inserted_mm`.
double push_n(double inserted_mm) {
  const auto tube = std::make_shared<vessel::TubeField>(Vector3d::Zero(), Vector3d::UnitZ(), 0.5);
  rod::Instrument wire = test::hydrophilic_035_angled();
  for (rod::Section& section : wire.sections) section.friction = 0.0;
  SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  spec.max_advance_mm = 3.0;
  Simulation simulation(tube, wire, {Vector3d::Zero(), Vector3d::UnitZ()}, spec);
  for (int push = 0; push < 9; ++push) EXPECT_TRUE(simulation.step({1.0, 0.0}).converged) << push;
  const StepReport& report = simulation.step({inserted_mm - 9.0, 0.0});
  EXPECT_TRUE(report.converged) << inserted_mm;
  return report.push_force_n;
}

// To straighten the tip takes a push, which ends with the curve. Breaks when it ends at once: without a ramp it falls from +23 to −26 mN
// within a tenth of a micrometre at 10 mm.
TEST(RestRamp, ThePushDoesNotJumpWhereTheCurveOfTheTipEnds) {
  constexpr double kFine_mm = 1e-4;
  for (const double end_mm : {9.5, 10.0, 10.5, 11.0})
    EXPECT_NEAR(push_n(end_mm - kFine_mm), push_n(end_mm + kFine_mm), 1e-4) << end_mm;
  EXPECT_GT(push_n(9.5), push_n(10.5) + 0.005) << "there is no curve to straighten";
}

}  // namespace
}  // namespace endowire::sim

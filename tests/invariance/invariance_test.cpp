// What must not matter, does not: numerical parameters, the wall where it is stiff. Frame, step size and rod length: tests/physics (V16).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "support/procedure.hpp"

namespace endowire::sim {
namespace {

/// Relative difference of two numbers, against the larger.
double relative(double a, double b) {
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300});
}

using test::Outcome;
using test::Procedure;

struct Parameter {
  std::string name;
  double SolverSpec::*value;
};

std::ostream& operator<<(std::ostream& out, const Parameter& p) {
  return out << p.name;
}

class Numerical : public testing::TestWithParam<Parameter> {};

// No fixed damping: a numerical parameter ten times larger or smaller moves the settled shape by less than 0.05 mm and the
// push by less than 1 %. Breaks with any of them acting as a physical one: a viscous drag, a soft grip, a loose stop.
TEST_P(Numerical, ParametersDoNotShapeTheResult) {
  rod::Instrument stiff = test::curved_tip_wire(0.2);
  for (rod::Section& s : stiff.sections) {
    s.flexural_rigidity_n_mm2 = {5.0 * s.flexural_rigidity_n_mm2.at_tip_side,
                                 5.0 * s.flexural_rigidity_n_mm2.at_hand_side};
  }
  for (const rod::Instrument& wire : {test::curved_tip_wire(), stiff}) {
    Procedure run;
    run.wire = wire;
    run.command = {1.0, 0.02};
    // No joint enters while the hand rests, and none comes or goes: a change of resolution is none of a parameter.
    run.steps = 72;
    run.spec.solver.rods.adaptive = false;
    const Outcome pushed = run();
    run.settling = 3;
    const Outcome base = run();
    ASSERT_EQ(pushed.state.joints_mm.size(), base.state.joints_mm.size());
    for (const double factor : {0.1, 10.0}) {
      Procedure changed = run;
      changed.spec.solver.*GetParam().value *= factor;
      const Outcome out = changed();
      const double shape = test::shape_difference_mm(out.state, base.state);
      const double push = relative(out.push_n, base.push_n);
      std::printf("  %s x %g: shape %.2g mm, push %.4f N, %.2g\n", GetParam().name.c_str(), factor, shape,
                  out.push_n, push);
      EXPECT_LT(shape, 0.05) << GetParam().name << " times " << factor;
      EXPECT_LT(push, 0.01) << GetParam().name << " times " << factor;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Numerical,
    testing::Values(Parameter{"proximal_scale", &SolverSpec::proximal_scale},
                    Parameter{"stick_stiffness_ratio", &SolverSpec::stick_stiffness_ratio},
                    Parameter{"grip_stiffness", &SolverSpec::grip_stiffness_n_per_mm},
                    Parameter{"correction_tolerance_mm", &SolverSpec::correction_tolerance_mm},
                    Parameter{"correction_tolerance_deg", &SolverSpec::correction_tolerance_deg},
                    Parameter{"force_tolerance", &SolverSpec::force_tolerance}),
    [](const auto& instance) { return instance.param.name; });

// A stiffer wall yields less, and the force that bends the wire round hardly changes with it: it is the wire's.
TEST(WallModulus, TenfoldStiffnessLessDeflection) {
  Procedure run;
  run.wire = test::curved_tip_wire(0.0);
  std::vector<Outcome> outcomes;
  for (const double modulus : {0.1, 1.0, 10.0, 100.0}) {
    run.spec.wall.modulus_mpa = modulus;
    outcomes.push_back(run());
    std::printf("  %g MPa: deflection %.4f mm, push %.5f N\n", modulus, outcomes.back().deflection_mm,
                outcomes.back().push_n);
  }
  for (std::size_t i = 1; i < outcomes.size(); ++i) {
    EXPECT_LT(outcomes[i].deflection_mm, outcomes[i - 1].deflection_mm);
  }
  EXPECT_LT(outcomes[1].deflection_mm, 0.3 * outcomes[0].deflection_mm);  // stiffer, it is all onset
  EXPECT_LT(relative(outcomes[3].push_n, outcomes[1].push_n), 0.05);
}

}  // namespace
}  // namespace endowire::sim

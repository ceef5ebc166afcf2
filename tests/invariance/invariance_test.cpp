// What must not matter, does not: where and how the world stands, the size of steps, numerical parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "support/fields.hpp"
#include "support/frames.hpp"
#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

/// Relative difference of two numbers, against the larger.
double relative(double a, double b) {
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300});
}

struct Outcome {
  State state;
  double push_n = 0.0, torque_n_mm = 0.0, wall_5mm_n = 0.0, deflection_mm = 0.0;
};

struct Procedure {
  test::FieldPointer field = test::bent_tube();
  rod::Instrument wire = test::curved_tip_wire();
  Access access = test::origin_access();
  SimulationSpec spec;
  int steps = 70;
  Command command{1.0, 0.0};
  int settling = 0;  ///< steps at the end in which the hand rests

  [[nodiscard]] Outcome operator()() const {
    Simulation simulation(field, wire, access, spec);
    Outcome out;
    for (int i = 0; i < steps + settling; ++i) {
      const StepReport& r = simulation.step(i < steps ? command : Command{});
      EXPECT_TRUE(r.converged) << "step " << i;
      if (!r.converged) break;
      out = {simulation.state(), r.push_force_n, r.torque_n_mm, r.max_force_5mm_n, r.max_wall_deflection_mm};
    }
    return out;
  }
};

// Vessel, access and gravity turned and shifted together: the same forces, the same shape turned and shifted. Breaks with
// any coordinate axis that is built in, and with an absolute tolerance on positions.
TEST(RigidMotion, ChangesNothing) {
  test::Random random(101);
  // Without friction, whose normal forces lag by up to 2e-3, and with a stop below what is asked here.
  Procedure run;
  run.wire = test::curved_tip_wire(0.0);
  run.spec.solver.force_tolerance = 1e-9;
  run.command = {1.0, 0.04};
  run.access.position_mm = {0.3, 0.2, 0.0};  // off the axis, where the gradient of the field is not unique
  const Outcome base = run();
  ASSERT_GT(base.push_n, 1e-3);
  ASSERT_GT(std::abs(base.torque_n_mm), 1e-3);
  for (int trial = 0; trial < 4; ++trial) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = random.frame();
    motion.translation() = 100.0 * random.vector();
    Procedure moved = run;
    moved.field = std::make_shared<test::MovedField>(run.field, motion);
    moved.access = {motion * run.access.position_mm, motion.linear() * run.access.direction};
    moved.spec.gravity_m_per_s2 = motion.linear() * run.spec.gravity_m_per_s2;
    // The first director of the wire in the sheath follows from the direction alone: the hand turns it back to where the
    // motion would have it, so that the curved tip points the same way.
    const Vector3d carried = motion.linear() * math::any_normal(run.access.direction);
    const Vector3d d = moved.access.direction;
    const Vector3d given = math::any_normal(d);
    const double turn = std::atan2(given.cross(carried).dot(d), given.dot(carried));
    Simulation simulation(moved.field, moved.wire, moved.access, moved.spec);
    ASSERT_TRUE(simulation.step({0.0, turn}).converged);
    Outcome out;
    for (int i = 0; i < run.steps; ++i) {
      const StepReport& r = simulation.step(run.command);
      ASSERT_TRUE(r.converged) << i;
      out = {simulation.state(), r.push_force_n, r.torque_n_mm, r.max_force_5mm_n, r.max_wall_deflection_mm};
    }
    EXPECT_LT(relative(out.push_n, base.push_n), 1e-6);
    EXPECT_LT(relative(out.torque_n_mm, base.torque_n_mm), 1e-6);
    EXPECT_LT(relative(out.wall_5mm_n, base.wall_5mm_n), 1e-6);
    EXPECT_LT(relative(out.deflection_mm, base.deflection_mm), 1e-6);
    State back = out.state;
    for (Vector3d& x : back.joints_mm) x = motion.inverse() * x;
    EXPECT_LT(test::shape_difference_mm(back, base.state), 1e-6);
  }
}

// Statics without friction has no history: steps of a tenth of a millimetre to two end in the same shape.
TEST(StepSize, DoesNotMatterWithoutFriction) {
  Procedure run;
  run.wire = test::curved_tip_wire(0.0);
  run.steps = 7;
  run.command = {10.0, 0.3};
  run.settling = 1;
  run.spec.solver.rods.adaptive = false;  // on one grid of rods: which ones there are may depend on the way
  std::vector<Outcome> outcomes;
  for (const double advance : {2.0, 1.0, 0.5, 0.25, 0.1}) {
    run.spec.max_advance_mm = advance;
    outcomes.push_back(run());
  }
  for (const Outcome& o : outcomes) {
    // Two states that each are converged to 1e-3 mm.
    EXPECT_LT(test::shape_difference_mm(o.state, outcomes[0].state), 2e-3);
    EXPECT_LT(relative(o.push_n, outcomes[0].push_n), 0.01);
  }
}

// With friction the way counts, and steps of finite size follow it to first order: half the step, half the error. Breaks when a step
// forgets or invents friction of its own.
TEST(StepSize, ConvergesWithFriction) {
  Procedure run;
  run.wire = test::curved_tip_wire(0.1);
  run.spec.solver.rods.adaptive = false;
  run.steps = 15;  // no joint is about to enter then
  run.command = {5.0, 0.2};
  std::vector<Outcome> outcomes;
  std::vector<double> peaks;
  const std::vector<double> advances{2.0, 1.0, 0.5, 0.1};
  for (const double advance : advances) {
    run.spec.max_advance_mm = advance;
    outcomes.push_back(run());
    peaks.push_back(outcomes.back().push_n);
  }
  std::vector<double> shape, push;
  for (std::size_t i = 0; i + 1 < outcomes.size(); ++i) {
    shape.push_back(test::shape_difference_mm(outcomes[i].state, outcomes.back().state));
    push.push_back(relative(peaks[i], peaks.back()));
    std::printf("  steps of %.1f against 0.1 mm: %.4f mm, push %.4f %%\n", advances[i], shape[i],
                100.0 * push[i]);
  }
  EXPECT_LT(shape[2], 0.2);
  EXPECT_LT(push[2], 0.05);
  EXPECT_LT(shape[2], 0.75 * shape[1] + 1e-3);
  EXPECT_LT(shape[1], 0.75 * shape[0] + 1e-3);
}

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

/// Distance of a point from a polyline.
double distance_to(const std::vector<Vector3d>& line, const Vector3d& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector3d d = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - line[i] - t * d).norm());
  }
  return nearest;
}

// Shorter rods come nearer to one shape: the change from 2 to 1 mm is less than half of that from 4 to 2 mm. Breaks when
// contact depends on where the joints are.
TEST(RodLength, Converges) {
  Procedure run;
  run.wire = test::curved_tip_wire(0.0);
  std::vector<Outcome> outcomes;
  for (const double length : {4.0, 2.0, 1.0}) {
    run.spec.solver.rods.adaptive = false;
    run.spec.solver.rods.rod_length_mm = length;
    outcomes.push_back(run());
  }
  const auto difference = [](const State& coarse, const State& fine) {
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < coarse.joints_mm.size(); ++i)  // the last joint lies in the sheath
      worst = std::max(worst, distance_to(fine.joints_mm, coarse.joints_mm[i]));
    return std::max(worst, (coarse.joints_mm[0] - fine.joints_mm[0]).norm());
  };
  const double first = difference(outcomes[0].state, outcomes[1].state);
  const double second = difference(outcomes[1].state, outcomes[2].state);
  std::printf("  4 to 2 mm: %.4f mm, 2 to 1 mm: %.4f mm; push %.5f, %.5f, %.5f N\n", first, second,
              outcomes[0].push_n, outcomes[1].push_n, outcomes[2].push_n);
  EXPECT_LT(first, 0.3);
  EXPECT_LT(second, 0.5 * first);
}

}  // namespace
}  // namespace endowire::sim

// V16  What must not matter, does not: where the world stands, the size of steps, the length of rods.
//
// Whole procedures of the simulator, whose closed form is that of a copy: the same forces, the same shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cases.hpp"
#include "endowire/math/transport.hpp"
#include "figures.hpp"
#include "step_size.hpp"
#include "support/fields.hpp"
#include "support/frames.hpp"
#include "support/procedure.hpp"

namespace endowire::test {

namespace {

constexpr double kMillion = 1e6;

/// Relative difference of two numbers, against the larger.
double relative(double a, double b) {
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300});
}

double nan_unless(bool converged) {
  return converged ? 0.0 : std::numeric_limits<double>::quiet_NaN();
}

Check check(const std::string& quantity, double ours, double allowed) {
  return {"V16", quantity, "0", 0.0, ours, allowed, ErrorKind::absolute, "invariance"};
}

/// Distance of a point from a polyline.
double distance_mm(const std::vector<Eigen::Vector3d>& line, const Eigen::Vector3d& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d d = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - line[i] - t * d).norm());
  }
  return nearest;
}

}  // namespace

// Vessel, access and gravity turned and shifted together. Breaks with any coordinate axis that is built in, and with an absolute
// tolerance on positions.
Checks rigid_motion() {
  Random random(101);
  Procedure base;
  base.wire = curved_tip_wire(0.0);  // friction lags its normal forces by up to 2e-3
  base.spec.solver.force_tolerance = 1e-9;
  base.command = {1.0, 0.04};
  base.access.position_mm = {0.3, 0.2, 0.0};  // off the axis, where the gradient of the field is not unique
  const Outcome there = base();
  double forces = nan_unless(there.converged && there.push_n > 1e-3 && std::abs(there.torque_n_mm) > 1e-3);
  double shape_mm = forces;
  for (int trial = 0; trial < 4; ++trial) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = random.frame();
    motion.translation() = 100.0 * random.vector();
    Procedure moved = base;
    moved.field = std::make_shared<MovedField>(base.field, motion);
    moved.access = {motion * base.access.position_mm, motion.linear() * base.access.direction};
    moved.spec.gravity_m_per_s2 = motion.linear() * base.spec.gravity_m_per_s2;
    // The first director of the wire in the sheath follows from the direction alone: the hand turns it back to where the
    // motion would have it, so that the curved tip points the same way.
    const Eigen::Vector3d carried = motion.linear() * math::any_normal(base.access.direction);
    const Eigen::Vector3d d = moved.access.direction;
    const Eigen::Vector3d given = math::any_normal(d);
    moved.first_turn_rad = std::atan2(given.cross(carried).dot(d), given.dot(carried));
    Outcome here = moved();
    forces += nan_unless(here.converged);
    forces = std::max(
        {forces, relative(here.push_n, there.push_n), relative(here.torque_n_mm, there.torque_n_mm),
         relative(here.wall_5mm_n, there.wall_5mm_n), relative(here.deflection_mm, there.deflection_mm)});
    for (Eigen::Vector3d& x : here.state.joints_mm) x = motion.inverse() * x;
    shape_mm = std::max(shape_mm, shape_difference_mm(here.state, there.state));
  }
  return {check("all turned and shifted: relative change of push, torque, wall force, deflection [10⁻⁶]",
                kMillion * forces, 1.0),
          check("all turned and shifted: change of shape [10⁻⁶ mm]", kMillion * shape_mm, 1.0)};
}

// Statics without friction has no history.
Checks step_size_without_friction() {
  Procedure run;
  run.wire = curved_tip_wire(0.0);
  run.steps = 7;
  run.command = {10.0, 0.3};
  run.settling = 1;
  run.spec.solver.rods.adaptive = false;  // on one grid of rods: which ones there are may depend on the way
  std::vector<Outcome> outcomes;
  double shape_mm = 0.0;
  double push = 0.0;
  for (const double advance : {2.0, 1.0, 0.5, 0.25, 0.1}) {
    run.spec.max_advance_mm = advance;
    outcomes.push_back(run());
    shape_mm += nan_unless(outcomes.back().converged);
    shape_mm = std::max(shape_mm, shape_difference_mm(outcomes.back().state, outcomes.front().state));
    push = std::max(push, relative(outcomes.back().push_n, outcomes.front().push_n));
  }
  // Two states that are each converged to 1e-3 mm.
  return {check("steps of 0.1 to 2 mm, no friction: change of shape [µm]", 1e3 * shape_mm, 2.0),
          check("steps of 0.1 to 2 mm, no friction: change of push [%]", 1e2 * push, 1.0)};
}

StepSizes step_sizes_with_friction() {
  Procedure run;
  run.wire = curved_tip_wire(0.1);
  run.spec.solver.rods.adaptive = false;
  run.steps = 15;  // no joint is about to enter then
  run.command = {5.0, 0.2};
  run.spec.max_advance_mm = 0.05;
  const Outcome finest = run();
  StepSizes result;
  for (const double advance : {2.0, 1.0, 0.5}) {
    run.spec.max_advance_mm = advance;
    const Outcome out = run();
    result.step_mm.push_back(advance);
    result.error_mm.push_back(shape_difference_mm(out.state, finest.state) +
                              nan_unless(out.converged && finest.converged));
  }
  return result;
}

// With friction the way counts, and steps of finite size follow it to first order: half the step, half the error. Breaks when a step
// forgets or invents friction of its own.
Checks step_size_with_friction() {
  const StepSizes sizes = step_sizes_with_friction();
  return {{"V16", "order in the step, with friction, steps of 2 to 0.5 mm", "1", 1.0,
           0.5 * std::log2(sizes.error_mm.front() / sizes.error_mm.back()), 0.35, ErrorKind::absolute,
           "first-order return mapping"},
          check("steps of 0.5 mm against 0.05 mm, with friction: change of shape [µm]",
                1e3 * sizes.error_mm.back(), 10.0)};
}

// Shorter rods come nearer to one shape. Breaks when contact depends on where the joints are.
Checks rod_length_in_contact() {
  Procedure run;
  run.wire = curved_tip_wire(0.0);
  run.spec.solver.rods.adaptive = false;
  std::vector<Outcome> outcomes;
  double failed = 0.0;
  for (const double length : {4.0, 2.0, 1.0}) {
    run.spec.solver.rods.rod_length_mm = length;
    outcomes.push_back(run());
    failed += nan_unless(outcomes.back().converged);
  }
  const auto difference_mm = [](const sim::State& coarse, const sim::State& fine) {
    double worst = (coarse.joints_mm[0] - fine.joints_mm[0]).norm();
    for (std::size_t i = 0; i + 1 < coarse.joints_mm.size(); ++i)  // the last joint lies in the sheath
      worst = std::max(worst, distance_mm(fine.joints_mm, coarse.joints_mm[i]));
    return worst;
  };
  const double first = difference_mm(outcomes[0].state, outcomes[1].state);
  const double second = difference_mm(outcomes[1].state, outcomes[2].state);
  return {{"V16", "order in the rod length, in contact, rods of 4, 2 and 1 mm", "2", 2.0,
           std::log2(first / second) + failed, 0.3, ErrorKind::absolute, "second-order rods"}};
}

Figure step_size_figure() {
  const StepSizes sizes = step_sizes_with_friction();
  Figure figure{"v16_steps", "V16  Error of the shape by the size of the steps, with friction",
                "step [mm]", "error against steps of 0.05 mm [µm]",
                {},          false,
                true,        true};
  Series ours{Mark::rings, {}, ""};
  for (std::size_t i = 0; i < sizes.step_mm.size(); ++i)
    ours.points.push_back({sizes.step_mm[i], 1e3 * sizes.error_mm[i]});
  const double first_um = 1e3 * sizes.error_mm.front();
  figure.series = {{Mark::line,
                    {{sizes.step_mm.back(), first_um * sizes.step_mm.back() / sizes.step_mm.front()},
                     {sizes.step_mm.front(), first_um}},
                    "order 1"},
                   ours};
  return figure;
}

}  // namespace endowire::test

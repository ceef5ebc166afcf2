// V16  Forces and moments balance.
//
// Internal ones sum to zero on any shape: the energy of a chain does not change when all of it moves or turns. Moved by a: δx = a. Turned
// by ω: δx = ω × x and every rod spins by ω·e, since its frame would keep from spinning under transport alone. Hence
//
//   Σ gᵢ = 0,   Σ xᵢ × gᵢ + Σ γᵢ eᵢ = 0,   g = ∂E/∂x, γ = ∂E/∂spin
//
// At rest they balance at every joint, in every step of a procedure. What a procedure without friction takes to go in, it gives back.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cases.hpp"
#include "support/chains.hpp"
#include "support/procedure.hpp"

namespace endowire::test {

namespace {

constexpr int kChainRods = 30;

/// A bent, twisted, stretched chain of an anisotropic, pre-curved and pre-twisted wire, some of it beyond its kink curvature.
void disturb(Chain& chain, std::mt19937& random) {
  const auto uniform = [&](double range) {
    return range * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
  };
  sim::ChainProblem& problem = chain.problem;
  std::vector<Eigen::Vector3d> joints = problem.shape.joints_mm;
  const Eigen::Vector3d origin(50.0, -30.0, 20.0);
  for (Eigen::Vector3d& x : joints) x += origin + Eigen::Vector3d(uniform(0.3), uniform(0.6), uniform(0.6));
  chain.lay_untwisted(joints);
  for (int i = 0; i < problem.shape.rods(); ++i) chain.spin(i, uniform(1.0));
  for (rod::JointMaterial& joint : problem.material.joints) {
    joint.bend_n_mm2 *= 1.0 + uniform(0.5);
    joint.bend_n_mm2[1] *= 1.0 + uniform(0.5);
    joint.rest_bend_rad = {uniform(0.2), uniform(0.2)};
    joint.rest_twist_rad = uniform(0.3);
    joint.kink_per_mm = 0.1 + std::abs(uniform(1.0));
  }
}

/// Sums over a gradient, as shares of the sums of sizes.
struct Sums {
  double force = 0.0;
  double moment = 0.0;
  double force_size_n = 0.0;
};

Sums sums_of(const rod::ChainShape& shape, const std::vector<double>& gradient) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double force_size = 0.0;
  double moment_size = 0.0;
  for (std::size_t i = 0; i < shape.joints_mm.size(); ++i) {
    const Eigen::Vector3d g(gradient[4 * i], gradient[4 * i + 1], gradient[4 * i + 2]);
    force += g;
    moment += shape.joints_mm[i].cross(g);
    force_size += g.norm();
    moment_size += shape.joints_mm[i].norm() * g.norm();
    if (i == shape.frames.size()) continue;
    moment += gradient[4 * i + 3] * shape.frames[i].col(2);
    moment_size += std::abs(gradient[4 * i + 3]);
  }
  return {force.norm() / force_size, moment.norm() / moment_size, force_size};
}

constexpr double kBillion = 1e9;
constexpr double kMillion = 1e6;

Check check(const char* quantity, double ours, double allowed, const char* source) {
  return {"V16", quantity, "0", 0.0, ours, allowed, ErrorKind::absolute, source};
}

}  // namespace

Checks internal_balance() {
  std::mt19937 random(7);
  double force = 0.0;
  double moment = 0.0;
  for (int shape_number = 0; shape_number < 20; ++shape_number) {
    Chain chain(uniform_wire(10.0, 100.0), kChainRods, 1.5);
    disturb(chain, random);
    const rod::ChainShape& shape = chain.problem.shape;
    math::BandMatrix hessian;
    hessian.resize(4 * (kChainRods + 1));
    hessian.set_zero();
    std::vector<double> gradient(4 * (kChainRods + 1), 0.0);
    rod::add_joint_derivatives(chain.problem.material, shape, hessian, gradient);
    // The stretch, far stiffer, must not hide an imbalance of the rest.
    const Sums bent = sums_of(shape, gradient);
    rod::add_stretch_derivatives(chain.problem.material, shape, std::vector<double>(kChainRods, 0.0), hessian,
                                 gradient);
    const Sums all = sums_of(shape, gradient);
    const bool took_part = bent.force_size_n > 1.0 && all.force_size_n > bent.force_size_n;
    if (!took_part) force = std::numeric_limits<double>::quiet_NaN();
    force = std::max({force, bent.force, all.force});
    moment = std::max({moment, bent.moment, all.moment});
  }
  return {check("internal forces of any shape, their sum over their sizes [10⁻⁹]", kBillion * force, 1e-3,
                "translation"),
          check("internal moments of any shape, their sum over their sizes [10⁻⁹]", kBillion * moment, 1e-3,
                "rotation")};
}

Checks balance_at_rest() {
  constexpr double kFloor = 1e-9;  // N and N·mm, that of the solver without its rounding
  double force = 0.0;
  double moment = 0.0;
  for (const double friction : {0.0, 0.1}) {
    Procedure run;
    run.wire = curved_tip_wire(friction);
    run.command = {1.0, 0.05};
    const Outcome out = run.run([&](const sim::StepReport& r) {
      if (r.solve.force_scale_n > 0.0) {
        force = std::max(force, (r.solve.force_residual_n - kFloor) / r.solve.force_scale_n);
        moment = std::max(moment, (r.solve.moment_residual_n_mm - kFloor) / r.solve.moment_scale_n_mm);
      }
    });
    if (!out.converged) force = std::numeric_limits<double>::quiet_NaN();
  }
  return {check("largest unbalanced force in 140 steps, over the largest internal one [10⁻⁶]",
                kMillion * force, 1.0, "equilibrium"),
          check("largest unbalanced moment in 140 steps, over the largest internal one [10⁻⁶]",
                kMillion * moment, 1.0, "equilibrium")};
}

Checks work_in_and_out() {
  constexpr int kSteps = 60;
  sim::SimulationSpec spec;
  spec.solver.rods.adaptive = false;
  spec.solver.rods.rod_length_mm = 1.0;
  sim::Simulation simulation(bent_tube(), curved_tip_wire(0.0), origin_access(), spec);
  double put_in_mj = 0.0;
  double lost_mj = 0.0;
  double last_n = 0.0;
  for (int step = 0; step < 2 * kSteps; ++step) {
    const double advance_mm = step < kSteps ? 1.0 : -1.0;
    const sim::StepReport& report = simulation.step({advance_mm, 0.0});
    if (!report.converged)
      return {check("work of the hand", std::numeric_limits<double>::quiet_NaN(), 1.0, "")};
    const double work_mj = 0.5 * (last_n + report.push_force_n) * advance_mm;
    last_n = report.push_force_n;
    if (step < kSteps) put_in_mj += work_mj;
    lost_mj += work_mj;
  }
  return {check("work lost pushing 60 mm in and out again, no friction, over the work put in [%]",
                1e2 * lost_mj / put_in_mj, 0.2, "energy conservation")};
}

}  // namespace endowire::test

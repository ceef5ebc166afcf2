// V3  A straight rod rolled up by an end moment.
//
//   M = EI φ/l with φ = 2π/n at every joint closes n rods into a regular polygon: the discrete closed form, for |κ| = φ.
//   M = EI κ bends the rod between clamp and tip into an arc of radius 1/κ: the continuum.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;

/// The moment is raised in steps: a turn of the tip beyond the reach of one Newton run would pick another branch.
solve::SolveReport roll(Chain& chain, double moment_n_mm) {
  constexpr int kSteps = 10;
  chain.problem.clamp_hand_end();
  chain.keep_plane();
  solve::Newton newton;
  solve::SolveReport report;
  for (int k = 1; k <= kSteps; ++k) {
    chain.problem.loads.tip_moment_n_mm = moment_n_mm * k / kSteps;
    report = newton.minimise(chain.problem, statics_spec());
    if (!report.converged()) break;
  }
  return report;
}

}  // namespace

Checks roll_up(int rods) {
  constexpr double kTightly = 1e-8;
  const double turn = 2.0 * std::numbers::pi;
  Checks checks;
  {
    Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / rods);
    const double failed = nan_unless_converged(roll(chain, turn * kRigidity_n_mm2 / kLength_mm));
    const rod::ChainShape& shape = chain.problem.shape;
    double worst = turn / rods;
    for (std::size_t j = 1; j < shape.frames.size(); ++j) {
      const double angle =
          2.0 * std::asin(0.5 * (shape.frames[j].col(2) - shape.frames[j - 1].col(2)).norm());
      if (std::abs(angle - turn / rods) > std::abs(worst - turn / rods)) worst = angle;
    }
    const double gap = (shape.joints_mm.front() - shape.joints_mm.back()).norm() / kLength_mm;
    checks.push_back({"V3", "worst angle of a joint, M = 2πEI/L [rad]", "2π/n", turn / rods, worst + failed,
                      kTightly, ErrorKind::relative, "discrete closed form"});
    checks.push_back({"V3", "gap of the closed ring over L", "0", 0.0, gap + failed, kTightly,
                      ErrorKind::absolute, "discrete closed form"});
  }
  {
    constexpr double kTolerance = 1e-3;
    Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / (rods - 0.5));
    const double curvature = 0.75 * turn / kLength_mm;
    const double failed = nan_unless_converged(roll(chain, kRigidity_n_mm2 * curvature));
    const rod::ChainShape& shape = chain.problem.shape;
    const double clamp_mm = shape.joints_mm.back().x() + 0.5 * chain.rod_length_mm;
    const Eigen::Vector3d& tip = shape.joints_mm.front();
    checks.push_back({"V3", "x/L of three quarters of a ring", "sin(κL)/κL",
                      std::sin(curvature * kLength_mm) / (curvature * kLength_mm),
                      (tip.x() - clamp_mm) / kLength_mm + failed, kTolerance, ErrorKind::relative,
                      "arc of a circle"});
    checks.push_back({"V3", "y/L of three quarters of a ring", "(1 − cos κL)/κL",
                      (1.0 - std::cos(curvature * kLength_mm)) / (curvature * kLength_mm),
                      tip.y() / kLength_mm + failed, kTolerance, ErrorKind::relative, "arc of a circle"});
  }
  return checks;
}

Figure roll_up_figure() {
  Figure figure{"v3",  "V3  A straight rod rolled up by an end moment, to a quarter … a whole turn",
                "x/L", "y/L",
                {},    true};
  constexpr int kEvery = 4;
  for (const double turns : {0.25, 0.5, 0.75, 1.0}) {
    const double curvature = 2.0 * std::numbers::pi * turns / kLength_mm;
    Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), kRods, kLength_mm / (kRods - 0.5));
    const double failed = nan_unless_converged(roll(chain, kRigidity_n_mm2 * curvature));
    const auto& joints = chain.problem.shape.joints_mm;
    const double clamp_mm = joints.back().x() + 0.5 * chain.rod_length_mm;
    Series exact{Mark::line, {}, ""};
    Series ours{Mark::rings, {}, ""};
    for (int i = 0; i <= kRods; ++i) {
      const double angle = curvature * kLength_mm * i / kRods;
      exact.points.push_back(
          {std::sin(angle) / (curvature * kLength_mm), (1.0 - std::cos(angle)) / (curvature * kLength_mm)});
    }
    for (std::size_t i = 0; i + 1 < joints.size(); i += kEvery)
      ours.points.push_back({(joints[i].x() - clamp_mm) / kLength_mm + failed, joints[i].y() / kLength_mm});
    figure.series.push_back(exact);
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

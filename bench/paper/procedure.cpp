#include "procedure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_clock.hpp"
#include "endowire/io/statistics.hpp"

namespace endowire::paper {

namespace {

constexpr int kStuckAfter = 10;
constexpr int kUnsettled = 5;  // steps after a snap
constexpr double kSpacing_mm = 0.5;

/// How deep the wire's surface lies behind the wall, all along its rods but the one in the sheath.
double depth_mm(const Vessel& vessel, const sim::Snapshot& wire) {
  double deepest = 0.0;
  for (std::size_t i = 0; i + 2 < wire.points.size(); ++i) {
    const sim::SnapshotPoint& a = wire.points[i];
    const sim::SnapshotPoint& b = wire.points[i + 1];
    const double length = (b.position_mm - a.position_mm).norm();
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / kSpacing_mm)));
    for (int k = 0; k < pieces; ++k) {
      const double w = static_cast<double>(k) / pieces;
      const Eigen::Vector3d p = (1.0 - w) * a.position_mm + w * b.position_mm;
      const double radius = (1.0 - w) * a.radius_mm + w * b.radius_mm;
      // The field errs by a few hundredths: where it is clear of the wall there is no need to look closer.
      if (vessel.field->at(p).distance_mm > radius + 0.1) continue;
      deepest = std::max(deepest, radius - vessel.exact_mm(p));
    }
  }
  return deepest;
}

void ask_where_the_tip_is(const Procedure& procedure, Run& run) {
  const Vessel& vessel = procedure.vessel;
  if (!vessel.tree || run.steps.empty() || run.steps.back().joints_mm.empty()) return;
  const Eigen::Vector3d& tip = run.steps.back().joints_mm.front();
  const std::int32_t branch = vessel.tree->branch_at(tip);
  if (branch >= 0) run.branch = vessel.tree->branches()[static_cast<std::size_t>(branch)].name;
  if (procedure.target)
    run.reached =
        sim::distance_to(sim::find_target(*vessel.tree, *procedure.target), *vessel.tree, tip).reached;
}

}  // namespace

double Run::mean_rods() const {
  double sum = 0.0;
  for (const Step& step : steps) sum += step.rods;
  return sum / static_cast<double>(steps.size());
}

double Run::mean_us() const {
  double sum = 0.0;
  for (const Step& step : steps) sum += step.cpu_us;
  return sum / static_cast<double>(steps.size());
}

double Run::percentile_us(double fraction) const {
  std::vector<double> us;
  for (const Step& step : steps) us.push_back(step.cpu_us);
  return io::percentile(us, fraction);
}

Run play(const Procedure& procedure) {
  sim::Simulation simulation(procedure.vessel.field, procedure.wire, procedure.vessel.access, procedure.spec);
  Run run;
  run.commands = procedure.commands.size();
  sim::Snapshot snapshot;
  int since_snap = kUnsettled;
  int failed = 0;
  for (const sim::Command& command : procedure.commands) {
    const double before_us = cpu_us();
    const sim::StepReport& report = simulation.step(command);
    const double us = cpu_us() - before_us;
    since_snap = report.snapped ? 0 : since_snap + 1;
    failed = report.converged ? 0 : failed + 1;
    run.steps.push_back({report.inserted_length_mm, report.push_force_n, static_cast<double>(report.rods), us,
                         report.detections, report.solve.correction_mm, report.converged,
                         report.converged && since_snap >= kUnsettled, simulation.state().joints_mm});
    run.converged += report.converged ? 1 : 0;
    run.snaps += report.snapped ? 1 : 0;
    run.splits += report.splits;
    run.detections += report.detections;
    run.calm_detections += report.snapped ? 0.0 : report.detections;
    run.verifications += report.verifications;
    run.iterations += report.newton_iterations;
    run.slipped_mm += std::abs(report.hand_slip_mm);
    run.most_push_n = std::max(run.most_push_n, report.push_force_n);
    run.resolution_energy_mj = std::max(run.resolution_energy_mj, report.resolution_energy_mj);
    simulation.snapshot(snapshot);
    run.deepest_mm = std::max(run.deepest_mm, depth_mm(procedure.vessel, snapshot));
    if (failed == kStuckAfter) break;
  }
  ask_where_the_tip_is(procedure, run);
  return run;
}

Run play(const Procedure& procedure, const sim::ResolutionSpec& rods) {
  Procedure with = procedure;
  with.spec.solver.rods = rods;
  return play(with);
}

sim::ResolutionSpec fixed_rods(double length_mm) {
  sim::ResolutionSpec rods;
  rods.adaptive = false;
  rods.rod_length_mm = length_mm;
  rods.max_bias_rad = 0.5 * std::numbers::pi;
  return rods;
}

}  // namespace endowire::paper

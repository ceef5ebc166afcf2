#include "harness/measure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "endowire/io/statistics.hpp"
#include "endowire/sim/simulation.hpp"
#include "harness/machine.hpp"

namespace endowire::bench {

namespace {

constexpr int kStagedRounds = 3;
constexpr std::size_t kManySteps =
    5'000;  // a procedure with more of them is played once with the stage clock
constexpr std::size_t kRestEvery = 25;

double median(std::vector<double>& values) {
  return io::percentile(values, 0.5);
}

/// Times of every step, a list a step, one entry a round.
using Rounds = std::vector<std::vector<double>>;

/// The stages of a step in the round in which it took least: the stage clock also counts what else the machine did.
StageTimes least_disturbed(const std::vector<StageTimes>& rounds) {
  StageTimes best{};
  double least = HUGE_VAL;
  for (const StageTimes& us : rounds) {
    const double sum = std::accumulate(us.begin(), us.end(), 0.0);
    if (sum < least) best = us;
    least = std::min(least, sum);
  }
  return best;
}

/// How far the tip still moves when the hand stops here; the simulation stays as it was.
double lag_mm(sim::Simulation& simulation, sim::State& kept) {
  kept = simulation.state();
  if (kept.joints_mm.empty()) return 0.0;
  const Eigen::Vector3d tip = kept.joints_mm.front();
  const sim::StepReport& report = simulation.step({});
  const double moved = report.snapped || simulation.state().joints_mm.empty()
                           ? 0.0
                           : (simulation.state().joints_mm.front() - tip).norm();
  simulation.restore(kept);
  return moved;
}

struct Player {
  const Prepared& prepared;
  Measured& out;
  Rounds cpu{};
  std::vector<std::vector<StageTimes>> staged{};
  std::vector<double> wall_calm{}, calm{}, snap{};
  double plain_us = 0.0, staged_us = 0.0;

  [[nodiscard]] bool counts(const StepRow& row) const { return row.rods >= out.scenario.least_rods; }

  /// The first round also writes down what every step was like: it is the same in all.
  void describe(const sim::StepReport& report, const sim::Command& command) {
    StepRow row;
    row.travel_mm = (out.rows.empty() ? 0.0 : out.rows.back().travel_mm) + std::abs(command.advance_mm);
    row.inserted_mm = report.inserted_length_mm;
    row.rods = report.rods;
    row.samples = report.contact_samples;
    row.iterations = report.newton_iterations;
    row.snapped = report.snapped;
    row.converged = report.converged;
    row.split = report.splits > 0;
    out.converged += report.converged ? 1 : 0;
    out.snaps += report.snapped ? 1 : 0;
    out.splits += row.split ? 1 : 0;
    out.most_rods = std::max(out.most_rods, report.rods);
    out.most_samples = std::max(out.most_samples, report.contact_samples);
    out.mean_factorisations += report.solve.factorisations;
    if (!report.snapped) out.calm_detections += report.detections;
    out.push_n = report.push_force_n;
    out.rows.push_back(row);
  }

  void plain_round() {
    sim::Simulation simulation(prepared.field, prepared.instrument, prepared.access, prepared.spec);
    const bool first = out.rounds == 0;
    for (std::size_t i = 0; i < prepared.commands.size(); ++i) {
      const double wall_before = wall_us();
      const double before = cpu_us();
      const sim::StepReport& report = simulation.step(prepared.commands[i]);
      const double us = cpu_us() - before;
      const double on_the_wall = wall_us() - wall_before;
      if (first) describe(report, prepared.commands[i]);
      plain_us += us;
      cpu[i].push_back(us);
      if (!counts(out.rows[i])) continue;
      (report.snapped ? snap : calm).push_back(us);
      if (!report.snapped) wall_calm.push_back(on_the_wall);
    }
    end_round(simulation);
    ++out.rounds;
    if (first) shorten(simulation);
  }

  void staged_round() {
    sim::Simulation simulation(prepared.field, prepared.instrument, prepared.access, prepared.spec);
    StageClock clock;
    sim::State kept;
    for (std::size_t i = 0; i < prepared.commands.size(); ++i) {
      simulation.observe_stages(&clock);
      static_cast<void>(clock.take());
      const double before = cpu_us();
      simulation.step(prepared.commands[i]);
      staged_us += cpu_us() - before;
      staged[i].push_back(clock.take());
      staged[i].back()[0] = 0.0;  // outside of the step
      simulation.observe_stages(nullptr);
      if (i % kRestEvery == kRestEvery - 1)
        out.tip_lag_mm = std::max(out.tip_lag_mm, lag_mm(simulation, kept));
    }
    end_round(simulation);
  }

  void end_round(const sim::Simulation& simulation) {
    const std::uint64_t hash = simulation.state_hash();
    if (out.state_hash == 0) {
      out.state_hash = hash;
      out.same_bits = true;
    }
    out.same_bits = out.same_bits && hash == out.state_hash;
  }

  void shorten(const sim::Simulation& simulation) {
    const sim::State& state = simulation.state();
    out.inserted_mm = state.inserted_mm;
    double chords = 0.0;
    for (std::size_t j = 0; j + 2 < state.joints_mm.size(); ++j)
      chords += (state.joints_mm[j] - state.joints_mm[j + 1]).norm();
    // Joint n - 1 lies at the end of the sheath; the arcs end with it.
    out.shortened_mm = state.joints_mm.empty() ? 0.0 : state.inserted_mm - chords;
  }

  void sum_up() {
    double iterations_and_rods = 0.0;
    double counted_us = 0.0;
    std::size_t calm_rows = 0;
    double counted = 0.0;
    for (std::size_t i = 0; i < out.rows.size(); ++i) {
      StepRow& row = out.rows[i];
      row.cpu_us = median(cpu[i]);
      row.stage_us = least_disturbed(staged[i]);
      calm_rows += row.snapped ? 0 : 1;
      if (!counts(row)) continue;
      counted += 1.0;
      out.mean_rods += row.rods;
      out.mean_samples += row.samples;
      out.mean_iterations += row.iterations;
      if (row.snapped) continue;
      iterations_and_rods += static_cast<double>(row.iterations) * row.rods;
      counted_us += row.cpu_us;
      for (std::size_t s = 0; s < row.stage_us.size(); ++s) out.mean_stage_us[s] += row.stage_us[s];
    }
    const double calm_counted = std::max(1.0, static_cast<double>(calm.size()) / out.rounds);
    for (double& us : out.mean_stage_us) us /= calm_counted;
    for (double* mean : {&out.mean_rods, &out.mean_samples, &out.mean_iterations})
      *mean /= std::max(1.0, counted);
    out.mean_factorisations /= static_cast<double>(std::max<std::size_t>(1, out.rows.size()));
    out.calm_detections /= static_cast<double>(std::max<std::size_t>(1, calm_rows));
    out.us_per_iteration_and_rod = counted_us / std::max(1.0, iterations_and_rods);
    out.calm = percentiles_of(calm);
    out.snap = percentiles_of(snap);
    out.wall = percentiles_of(wall_calm);
    out.total_ms = 1e-3 * plain_us / out.rounds;
    out.ms_per_mm = out.total_ms / std::max(1e-9, out.rows.back().travel_mm);
  }
};

}  // namespace

Percentiles percentiles_of(const std::vector<double>& us) {
  const auto at = [&](double fraction) { return io::percentile(us, fraction); };
  return {us.size(), at(0.5), at(0.95), at(0.99), at(0.999), at(1.0)};
}

Measured measure(const Scenario& scenario, const MeasureOptions& options) {
  Measured out;
  out.scenario = scenario;
  out.processor = processor();
  out.compiler = compiler();
  out.calibration_before_ns = calibration_ns();
  const Prepared prepared = prepare(scenario, options.cache_folder);
  out.triangles = prepared.triangles;
  out.field_mb = static_cast<double>(prepared.field_bytes) / 1e6;
  out.prepare_s = prepared.prepare_s;
  out.field_s = prepared.field_s;
  out.steps = prepared.commands.size();
  Player player{prepared, out};
  player.cpu.resize(out.steps);
  player.staged.resize(out.steps);
  const auto least = static_cast<std::size_t>(options.once ? 0 : scenario.least_steps);
  do {
    player.plain_round();
  } while (static_cast<std::size_t>(out.rounds) * out.steps < least);
  const int staged_rounds = !options.stages ? 0
                            : options.once || out.steps > kManySteps || scenario.scene.empty()
                                ? 1
                                : kStagedRounds;
  for (int i = 0; i < staged_rounds; ++i) player.staged_round();
  player.sum_up();
  if (staged_rounds > 0) out.clock_share = player.staged_us / staged_rounds / (1e3 * out.total_ms) - 1.0;
  out.calibration_after_ns = calibration_ns();
  out.peak_mb = peak_memory_mb();
  return out;
}

}  // namespace endowire::bench

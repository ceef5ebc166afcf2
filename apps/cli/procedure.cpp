#include "procedure.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "commands.hpp"
#include "endowire/sim/event_watch.hpp"
#include "results.hpp"

namespace endowire::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t hash_interval = 10;  // steps between two state hashes of a recording

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int report_failure(const Procedure& procedure) {
  if (procedure.statistics.failed.empty()) return exit_success;
  const io::FailedStep& first = procedure.statistics.failed.front();
  fmt::print(stderr,
             "{}: step {} did not converge (t = {:.2f} s, {:.1f} mm inserted, {}); {} of {} steps did not\n",
             procedure.scene.name, first.step, first.time_s, first.inserted_length_mm,
             io::name_of(first.solve.termination),
             procedure.statistics.steps - procedure.statistics.converged_steps, procedure.statistics.steps);
  return exit_not_converged;
}

/// Recording and shapes are written as they happen.
void play(Procedure& procedure, sim::Simulation& simulation, std::span<const io::TimedCommand> commands,
          io::RunOutput& output, Progress& progress, const StepWatcher& watcher) {
  const auto count = static_cast<std::uint64_t>(commands.size());
  procedure.forces.reserve(commands.size());
  procedure.history.emplace(count);
  sim::EventWatch events(procedure.centrelines);
  const double length_mm = procedure.scene.instrument.length_mm();
  events.reserve(static_cast<std::size_t>(simulation.most_rods()), length_mm);
  sim::Snapshot on_the_way;
  for (std::uint64_t step = 1; step <= count; ++step) {
    const io::TimedCommand& timed = commands[step - 1];
    output.command({step, timed.time_s, timed.command});
    const Clock::time_point start = Clock::now();
    const sim::StepReport& report = simulation.step(timed.command);
    const double step_us = 1e6 * seconds_since(start);
    simulation.snapshot(procedure.last);
    const std::span<const sim::Event> begun = events.after(timed.command, report, procedure.last);
    procedure.statistics.add(timed.time_s, report, begun, step_us);
    procedure.history->add(step, timed.time_s, report, procedure.last, !begun.empty());
    procedure.forces.push_back({report.inserted_length_mm, report.push_force_n});
    for (int k = 0; k < simulation.waypoints(); ++k) {
      const double before_s = step > 1 ? commands[step - 2].time_s : 0.0;
      const double share = (k + 1.0) / (simulation.waypoints() + 1.0);
      simulation.waypoint(k, on_the_way);
      output.waypoint(step, k, before_s + share * (timed.time_s - before_s), on_the_way);
    }
    output.shape(step, timed.time_s, procedure.last);
    if (step % hash_interval == 0 || step == count) output.state_hash({step, simulation.state_hash()});
    if (watcher) watcher(step, simulation);
    progress.update(static_cast<double>(step) / static_cast<double>(count),
                    fmt::format("step {} of {}, {:.1f} mm inserted, push {:.2f} N", step, count,
                                report.inserted_length_mm, report.push_force_n));
  }
  procedure.state_hash = simulation.state_hash();
  output.finish(count, procedure.last);
}

}  // namespace

void add_run_options(CLI::App& command, RunOptions& options) {
  options.cache = io::default_cache_folder().string();
  command.add_option("--out", options.out, "folder for the results")->required();
  command.add_option("--cache", options.cache, "folder for prepared vessels");
  command.add_flag("--quiet", options.quiet, "no progress, no table");
}

Procedure prepare(io::SceneFile scene, const std::string& cache, Progress& progress) {
  Procedure procedure;
  progress.stage("preparing the vessel …");
  const Clock::time_point start = Clock::now();
  static_cast<io::PreparedScene&>(procedure) = io::prepare_scene(std::move(scene), cache);
  procedure.preparation_s = seconds_since(start);
  return procedure;
}

int run_procedure(Procedure& procedure, std::span<const io::TimedCommand> commands,
                  const io::RecordingHeader& header, const RunOptions& options, Progress& progress,
                  const StepWatcher& watcher) {
  sim::Simulation simulation = io::simulation_of(procedure);
  // From here on the input is good: only now is the folder touched.
  io::RunOutput output(options.out, header, procedure.scene.access);
  fs::path triangles = procedure.scene.vessel.file;
  if (triangles.empty() || !io::uses_the_files_triangles(procedure.vessel)) {
    const std::vector<std::byte> stl = vessel::write_binary_stl(procedure.vessel.repaired.mesh);
    output.file("vessel.stl", {reinterpret_cast<const char*>(stl.data()), stl.size()});
    triangles = output.folder() / "vessel.stl";
  }
  play(procedure, simulation, commands, output, progress, watcher);
  write_results(procedure, triangles, peak_memory_mb(), options, output, progress);
  return report_failure(procedure);
}

}  // namespace endowire::cli

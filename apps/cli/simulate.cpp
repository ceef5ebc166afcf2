#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "crossings.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/picture.hpp"
#include "endowire/io/run_output.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/io/summary.hpp"
#include "endowire/io/version.hpp"
#include "endowire/io/vessel_file.hpp"
#include "endowire/sim/simulation.hpp"
#include "progress.hpp"

namespace endowire::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t hash_interval = 10;  // steps between two state hashes of a recording

struct Options {
  std::string scene;
  std::string out;
  std::string cache = io::default_cache_folder().string();
  bool quiet = false;
};

struct Run {
  io::SceneFile scene;
  io::VesselMesh vessel;
  io::PreparedField prepared;
  double preparation_s = 0.0;
  io::RunStatistics statistics;
  std::vector<io::ForcePoint> forces;
  sim::Snapshot last;
  std::uint64_t state_hash = 0;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

const char* instruction_set() {
#if defined(__AVX512F__)
  return "x86-64 with AVX-512";
#elif defined(__AVX2__)
  return "x86-64 with AVX2";
#elif defined(__x86_64__)
  return "x86-64";
#elif defined(__aarch64__)
  return "arm64";
#else
  return "other";
#endif
}

/// The access through an opening: at its centre, into the vessel.
sim::Access through_opening(const io::SceneFile& scene, const io::VesselMesh& vessel) {
  const std::vector<vessel::Opening>& openings = vessel.repaired.openings;
  for (const vessel::Opening& opening : openings)
    if (opening.number == *scene.opening) return {opening.centre_mm, -opening.direction};
  throw base::InputError(fmt::format("{}: access.opening is {}; must be {}", scene.name, *scene.opening,
                                     openings.empty() ? "left out: the vessel has no opening"
                                                      : fmt::format("between 1 and {}", openings.size())));
}

sim::Simulation make_simulation(const Run& run) {
  try {
    return {run.prepared.field, run.scene.instrument, run.scene.access, run.scene.simulation};
  } catch (const base::InputError& error) {
    const std::string message = error.what();
    throw base::InputError(message.starts_with(run.scene.name) ? message : run.scene.name + ": " + message);
  }
}

io::RecordingHeader header_of(const Run& run) {
  io::RecordingHeader header;
  header.version = io::version;
  header.scene_name = run.scene.name;
  header.scene_text = run.scene.text;
  header.vessel = run.vessel.source;
  header.vessel_hash = run.vessel.content_hash;
  header.instrument = run.scene.instrument;
  return header;
}

void play(Run& run, sim::Simulation& simulation, io::RunOutput& output, Progress& progress) {
  const std::vector<io::TimedCommand> commands = io::commands_of(run.scene);
  const auto count = static_cast<std::uint64_t>(commands.size());
  run.forces.reserve(commands.size());
  sim::Snapshot on_the_way;
  for (std::uint64_t step = 1; step <= count; ++step) {
    const io::TimedCommand& timed = commands[step - 1];
    output.command({step, timed.time_s, timed.command});
    const Clock::time_point start = Clock::now();
    const sim::StepReport& report = simulation.step(timed.command);
    const double step_us = 1e6 * seconds_since(start);
    run.statistics.add(timed.time_s, report, step_us);
    run.forces.push_back({report.inserted_length_mm, report.push_force_n});
    for (int k = 0; k < simulation.waypoints(); ++k) {
      const double before_s = step > 1 ? commands[step - 2].time_s : 0.0;
      const double share = (k + 1.0) / (simulation.waypoints() + 1.0);
      simulation.waypoint(k, on_the_way);
      output.waypoint(step, k, before_s + share * (timed.time_s - before_s), on_the_way);
    }
    simulation.snapshot(run.last);
    output.shape(step, timed.time_s, run.last);
    if (step % hash_interval == 0 || step == count) output.state_hash({step, simulation.state_hash()});
    progress.update(static_cast<double>(step) / static_cast<double>(count),
                    fmt::format("step {} of {}, {:.1f} mm inserted, push {:.2f} N", step, count,
                                report.inserted_length_mm, report.push_force_n));
  }
  run.state_hash = simulation.state_hash();
  output.finish(count, run.last);
}

std::string crossings_text(const io::CrossingVerdict& verdict) {
  return verdict.crossings ? fmt::format("{}", *verdict.crossings) : verdict.note;
}

Eigen::Vector3d tip_of(const Run& run) {
  return run.last.points.empty() ? run.scene.access.position_mm : run.last.points.front().position_mm;
}

std::string picture_of(const Run& run, const io::CrossingVerdict& verdict) {
  const io::RunStatistics& statistics = run.statistics;
  const Eigen::Vector3d tip = tip_of(run);
  io::PictureContent content;
  content.title = fs::path(run.scene.name).stem().string();
  content.subtitle = fmt::format(
      "{}, {:.0f} mm inserted into {}", run.scene.instrument.model, run.last.inserted_length_mm,
      run.scene.vessel.file.empty()
          ? run.vessel.source
          : (run.scene.vessel.file.parent_path().filename() / run.scene.vessel.file.filename()).string());
  content.numbers = {
      {"Inserted", fmt::format("{:.1f} mm", run.last.inserted_length_mm)},
      {"Tip", fmt::format("{:.1f}, {:.1f}, {:.1f} mm", tip.x(), tip.y(), tip.z())},
      {"Largest push", fmt::format("{:.3f} N", statistics.max_push_force_n)},
      {"Largest torque", fmt::format("{:.3f} N·mm", statistics.max_torque_n_mm)},
      {"Largest wall force in 5 mm", fmt::format("{:.3f} N", statistics.max_force_5mm_n)},
      {"Wall crossings", verdict.crossings ? fmt::format("{}", *verdict.crossings) : "not judged"}};
  content.forces = run.forces;
  content.gravity_m_per_s2 = run.scene.simulation.gravity_m_per_s2;
  return io::wire_picture_svg(run.vessel.repaired.mesh, run.last, run.scene.access, content);
}

void print_table(const Run& run, const io::CrossingVerdict& verdict, const io::MachineFacts& machine,
                 const io::RunOutput& output) {
  const io::RunStatistics& statistics = run.statistics;
  const Eigen::Vector3d tip = tip_of(run);
  const auto row = [](const char* name, const std::string& value) {
    fmt::print("  {:<18} {}\n", name, value);
  };
  fmt::print("{}: {} steps, {} converged, {} split\n", run.scene.name, statistics.steps,
             statistics.converged_steps, statistics.split_steps);
  row("inserted", fmt::format("{:.1f} mm", run.last.inserted_length_mm));
  row("tip", fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", tip.x(), tip.y(), tip.z()));
  row("largest push", fmt::format("{:.3f} N", statistics.max_push_force_n));
  row("largest torque", fmt::format("{:.3f} N mm", statistics.max_torque_n_mm));
  row("largest wall force", fmt::format("{:.3f} N in 5 mm, {:.3f} N at the tip", statistics.max_force_5mm_n,
                                        statistics.max_tip_force_n));
  row("wall crossings", crossings_text(verdict));
  row("events", fmt::format("{}", statistics.events.size()));
  row("step time", fmt::format("{:.0f} us median, {:.0f} us 99 %", io::percentile(statistics.step_us, 0.5),
                               io::percentile(statistics.step_us, 0.99)));
  row("preparation",
      fmt::format("{:.2f} s{}", machine.preparation_s, machine.field_from_cache ? ", from the cache" : ""));
  row("peak memory", fmt::format("{:.0f} MB", machine.peak_memory_mb));
  std::string files;
  for (const std::string& name : output.written()) files += (files.empty() ? "" : ", ") + name;
  row("written", fmt::format("{}: {}", output.folder().string(), files));
  if (!io::vtp_available())
    row("",
        "wire.vtp, wire.pvd and steps/ are not written: this build has no VTK (ENDOWIRE_WITH_VTK is off)");
}

int report_failure(const Run& run) {
  if (run.statistics.failed.empty()) return exit_success;
  const io::FailedStep& first = run.statistics.failed.front();
  fmt::print(stderr,
             "{}: step {} did not converge (t = {:.2f} s, {:.1f} mm inserted, {}); {} of {} steps did not\n",
             run.scene.name, first.step, first.time_s, first.inserted_length_mm,
             io::name_of(first.solve.termination), run.statistics.steps - run.statistics.converged_steps,
             run.statistics.steps);
  return exit_not_converged;
}

int simulate(const Options& options) {
  io::check_output_folder(options.out);
  Run run;
  run.scene = io::read_scene_file(options.scene, instrument_folders());
  Progress progress(options.quiet);
  progress.stage("preparing the vessel …");
  const Clock::time_point start = Clock::now();
  run.vessel = run.scene.vessel.generate.empty()
                   ? io::read_vessel_file(run.scene.vessel.file, run.scene.vessel.unit)
                   : io::generate_vessel(run.scene.vessel.generate);
  if (run.scene.opening) run.scene.access = through_opening(run.scene, run.vessel);
  run.prepared = io::prepare_field(run.vessel, options.cache);
  run.preparation_s = seconds_since(start);
  sim::Simulation simulation = make_simulation(run);
  // From here on the input is good: only now is the folder touched.
  io::RunOutput output(options.out, header_of(run), run.scene.access);
  fs::path triangles = run.scene.vessel.file;
  if (triangles.empty()) {
    const std::vector<std::byte> stl = vessel::write_binary_stl(run.vessel.repaired.mesh);
    output.file("vessel.stl", {reinterpret_cast<const char*>(stl.data()), stl.size()});
    triangles = output.folder() / "vessel.stl";
  }
  play(run, simulation, output, progress);

  const double peak_mb = peak_memory_mb();  // of the simulation; drawing and judging come after it
  progress.stage("judging wall crossings …");
  const io::CrossingVerdict verdict =
      judge_crossings(output.folder() / "wire.pvd", triangles, vessel::name_of(run.vessel.unit));
  output.file("wire.svg", picture_of(run, verdict));
  const io::MachineFacts machine{peak_mb, run.preparation_s, run.prepared.origin == io::FieldOrigin::cached,
                                 instruction_set()};
  output.file("summary.json", io::summary_json(run.scene, run.vessel, *run.prepared.field, run.statistics,
                                               run.last, run.state_hash, verdict, machine));
  progress.clear();
  if (!options.quiet) print_table(run, verdict, machine, output);
  return report_failure(run);
}

}  // namespace

std::function<int()> add_simulate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("simulate", "play a scripted procedure");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("--out", options->out, "folder for the results")->required();
  command->add_option("--cache", options->cache, "folder for prepared distance fields");
  command->add_flag("--quiet", options->quiet, "no progress, no table");
  return [options] { return simulate(*options); };
}

}  // namespace endowire::cli

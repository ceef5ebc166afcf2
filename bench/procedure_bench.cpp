// bench_procedure [SCENE.toml]: plays a whole procedure, writes no files, prints one table.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/scene_vessel.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/io/vessel_file.hpp"
#include "endowire/sim/simulation.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// Time of one of ten million multiply-adds, each waiting for the one before: how fast this machine is right now.
double calibration_ns() {
  constexpr int count = 10'000'000;
  volatile double factor = 0.999999;  // unknown to the compiler
  const double a = factor;
  double x = 1.0;
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < count; ++i) x = x * a + 1e-6;
  const double ns = 1e9 * seconds_since(start) / count;
  volatile double sink = x;
  static_cast<void>(sink);
  return ns;
}

fs::path default_scene() {
  const fs::path root = ENDOWIRE_SOURCE_DIR;
  const bool anatomy = fs::exists(root / "../shared/vessels/femoral_to_neuro/lumen_mm.stl");
  return root / "scenes" / (anatomy ? "femoral_entry.toml" : "generated_entry.toml");
}

struct Played {
  io::RunStatistics statistics;
  double contact_samples = 0.0;  ///< sum over the steps
  double first_calibration_ns = 0.0;
  double last_calibration_ns = 0.0;
  double total_s = 0.0;
  double inserted_mm = 0.0;
  std::uint64_t state_hash = 0;
};

Played play(sim::Simulation& simulation, const std::vector<io::TimedCommand>& commands) {
  Played run;
  run.first_calibration_ns = calibration_ns();
  for (const io::TimedCommand& timed : commands) {
    const Clock::time_point start = Clock::now();
    const sim::StepReport& report = simulation.step(timed.command);
    const double step_s = seconds_since(start);
    run.statistics.add(timed.time_s, report, report.events, 1e6 * step_s);
    run.contact_samples += report.contact_samples;
    run.total_s += step_s;
    run.inserted_mm = report.inserted_length_mm;
  }
  run.last_calibration_ns = calibration_ns();
  run.state_hash = simulation.state_hash();
  return run;
}

template <typename... Values>
void row(const char* name, fmt::format_string<Values...> form, Values&&... values) {
  fmt::print("{:<24}{}\n", name, fmt::format(form, std::forward<Values>(values)...));
}

void times_row(const char* name, const std::vector<double>& us) {
  const auto at = [&](double fraction) { return io::percentile(us, fraction); };
  if (us.empty()) return row(name, "none");
  row(name, "p50 {:.0f}, p95 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} us ({} steps)", at(0.5), at(0.95),
      at(0.99), at(0.999), at(1.0), us.size());
}

void print_table(const io::SceneFile& scene, const io::PreparedField& prepared, double preparation_s,
                 const Played& run) {
  const io::RunStatistics& s = run.statistics;
  const double steps = static_cast<double>(s.steps);
  const std::vector<double>& newton = s.newton_iterations;
  row("machine", "{}", processor());
  row("compiler", "{}", ENDOWIRE_COMPILER);
  row("calibration", "{:.2f} ns before, {:.2f} ns after, a dependent multiply-add", run.first_calibration_ns,
      run.last_calibration_ns);
  row("scene", "{}, {}", fs::path(scene.name).filename().string(), scene.instrument.model);
  row("steps", "{}, {} converged, {} split, {:.1f} mm inserted", s.steps, s.converged_steps, s.split_steps,
      run.inserted_mm);
  row("rods", "{} to {}", s.least_rods, s.most_rods);
  row("contact samples", "mean {:.0f}, max {}", run.contact_samples / steps, s.most_contact_samples);
  row("detections per step", "{:.3f}, {:.3f} without a snap", s.detections / steps,
      s.calm_detections / std::max<double>(1.0, static_cast<double>(s.step_us.size())));
  row("Newton iterations", "mean {:.1f}, p99 {:.0f}, max {:.0f}",
      std::accumulate(newton.begin(), newton.end(), 0.0) / steps, io::percentile(newton, 0.99),
      io::percentile(newton, 1.0));
  times_row("step time, no snap", s.step_us);
  times_row("step time, with a snap", s.snap_step_us);
  row("all steps", "{:.3f} s", run.total_s);
  row("field preparation", "{:.2f} s, {:.1f} MB", preparation_s,
      static_cast<double>(prepared.field->facts().bytes) / 1e6);
  row("peak memory", "{:.0f} MB, preparation included", peak_memory_mb());
  row("state hash", "{:016x}", run.state_hash);
}

/// @param cache_folder  empty: the field is prepared now, and that is timed
void bench(const fs::path& path, const fs::path& cache_folder) {
  const io::SceneFile scene = io::read_scene_file(path, {fs::path(ENDOWIRE_SOURCE_DIR) / "instruments"});
  const io::VesselMesh vessel = io::vessel_of(scene);
  const Clock::time_point start = Clock::now();
  const io::PreparedField prepared = io::prepare_field(vessel, cache_folder);
  const double preparation_s = seconds_since(start);
  sim::Simulation simulation(prepared.field, scene.instrument,
                             io::access_of(scene, vessel, *io::prepare_centrelines(vessel, cache_folder)),
                             scene.simulation);
  const std::vector<io::TimedCommand> commands = io::commands_of(scene);
  print_table(scene, prepared, preparation_s, play(simulation, commands));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  fs::path cache_folder;
  if (arguments.size() >= 2 && arguments[0] == "--cache") {
    cache_folder = arguments[1];
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  if (arguments.size() > 1) {
    fmt::print(stderr, "usage: bench_procedure [--cache FOLDER] [SCENE.toml]\n");
    return 2;
  }
  try {
    bench(arguments.empty() ? default_scene() : fs::path(arguments[0]), cache_folder);
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

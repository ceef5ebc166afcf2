// bench_batch [--simulations N] [--rounds N] [--step-limit MM] [--cache FOLDER] [SCENE.toml]
//
// Many wires pushed into one vessel, each turned another way: one thread against all of them, in turns within one run.
// A control step is 1/7.5 s at 35 mm/s, 4.67 mm: what a learner asks for.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/base/hash.hpp"
#include "endowire/batch/batch.hpp"
#include "endowire/io/places.hpp"
#include "endowire/io/prepared_scene.hpp"
#include "endowire/io/statistics.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;
using Clock = std::chrono::steady_clock;

constexpr double kControl_mm = 35.0 / 7.5;
constexpr int kControlSteps = 96;  // 448 mm, from the groin into the arch

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto s = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return s(usage.ru_utime) + s(usage.ru_stime);
}

struct Options {
  std::size_t simulations = 16;
  int rounds = 3;
  double step_limit_mm = 1.0;
  fs::path cache;
  fs::path scene = fs::path(ENDOWIRE_SOURCE_DIR) / "scenes" / "generated_left_carotid.toml";
};

/// One insertion of every wire.
struct Round {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double inserted_mm = 0.0;
  std::size_t not_converged = 0;
  std::uint64_t hash = 0;  ///< of all final states
};

Round play(batch::Batch& batch, const std::vector<sim::State>& start, int threads) {
  batch.set_threads(threads);
  for (std::size_t i = 0; i < batch.size(); ++i) batch.restore(i, start[i]);
  const std::vector<sim::Command> push(batch.size(), {kControl_mm, 0.0});
  Round round;
  const double cpu_before = cpu_s();
  const Clock::time_point before = Clock::now();
  for (int step = 0; step < kControlSteps; ++step)
    for (const sim::StepReport& report : batch.step(push)) round.not_converged += report.converged ? 0 : 1;
  round.wall_s = std::chrono::duration<double>(Clock::now() - before).count();
  round.cpu_s = cpu_s() - cpu_before;
  base::Hash hash;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    hash.add(batch.simulation(i).state_hash());
    round.inserted_mm += batch.simulation(i).state().inserted_mm - start[i].inserted_mm;
  }
  round.hash = hash.value();
  return round;
}

void bench(const Options& options) {
  io::SceneFile scene = io::read_scene_file(options.scene, io::instrument_folders({}, ENDOWIRE_SOURCE_DIR));
  scene.simulation.max_advance_mm = options.step_limit_mm;
  const io::PreparedScene prepared = io::prepare_scene(std::move(scene), options.cache);
  std::vector<sim::Simulation> simulations;
  std::vector<sim::State> start;
  for (std::size_t i = 0; i < options.simulations; ++i) {
    simulations.push_back(io::simulation_of(prepared));
    start.push_back(simulations.back().state());
    start.back().hand_turn_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(options.simulations);
  }
  batch::Batch batch(std::move(simulations));
  const int all = batch.threads();
  const double control_steps = static_cast<double>(options.simulations) * kControlSteps;
  fmt::print("{} simulations of {}, {} control steps of {:.2f} mm each, pieces of at most {} mm\n",
             options.simulations, options.scene.filename().string(), kControlSteps, kControl_mm,
             options.step_limit_mm);
  fmt::print("{:>7} {:>9} {:>9} {:>16} {:>14} {:>22} {:>14}  {}\n", "threads", "wall s", "cpu s",
             "control steps/s", "inserted mm/s", "control steps/cpu s", "not converged", "states");
  std::vector<double> wall_ratio;
  std::vector<double> cpu_ratio;
  for (int round = 0; round < options.rounds; ++round) {
    const auto shown = [&](int threads) {
      const Round r = play(batch, start, threads);
      fmt::print("{:>7} {:>9.2f} {:>9.2f} {:>16.0f} {:>14.0f} {:>22.0f} {:>14}  {:016x}\n", threads, r.wall_s,
                 r.cpu_s, control_steps / r.wall_s, r.inserted_mm / r.wall_s, control_steps / r.cpu_s,
                 r.not_converged, r.hash);
      return r;
    };
    const Round one = shown(1);
    const Round many = shown(all);
    wall_ratio.push_back(one.wall_s / many.wall_s);
    cpu_ratio.push_back(static_cast<double>(all) * one.cpu_s / many.cpu_s);
  }
  fmt::print(
      "ratio of {} threads to one: {:.2f} by the clock (median; best {:.2f}), {:.2f} by processor time, "
      "which other "
      "programs do not take\n",
      all, io::percentile(wall_ratio, 0.5), *std::max_element(wall_ratio.begin(), wall_ratio.end()),
      io::percentile(cpu_ratio, 0.5));
}

/// @throws base::InputError naming the option
Options read(const std::vector<std::string>& arguments) {
  Options options;
  const auto number = [&](std::size_t i, double low, double high) {
    try {
      const double value = std::stod(arguments.at(i + 1));
      if (value >= low && value <= high) return value;
    } catch (const std::exception&) {  // told below
    }
    throw base::InputError(fmt::format("bench_batch: {} must be a number, {} … {}", arguments[i], low, high));
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    if (a == "--simulations")
      options.simulations = static_cast<std::size_t>(number(i++, 1, 100'000));
    else if (a == "--rounds")
      options.rounds = static_cast<int>(number(i++, 1, 1000));
    else if (a == "--step-limit")
      options.step_limit_mm = number(i++, 0.001, 10.0);
    else if (a == "--cache" && i + 1 < arguments.size())
      options.cache = arguments[++i];
    else if (a.rfind("--", 0) == 0 || i + 1 != arguments.size())
      throw base::InputError(
          "usage: bench_batch [--simulations N] [--rounds N] [--step-limit MM] [--cache FOLDER] "
          "[SCENE.toml]");
    else
      options.scene = a;
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    bench(read({argv + 1, argv + argc}));
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

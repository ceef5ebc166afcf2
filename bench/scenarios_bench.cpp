// bench_scenarios [options] [NAME or SCENE.toml ...]: plays whole procedures and times their steps.
//
//   --list            the scenarios that ship
//   --machine         the name of this machine's folder of results
//   --out FOLDER      where NAME.json, NAME.csv, NAME.svg and summary.csv go; bench/results/MACHINE
//   --json            one round of each scenario without the stage clock, a line of JSON each, no files: for comparisons
//   --cache FOLDER    distance fields are kept there; else prepared now, and that is timed
//   --step MM         longest advance of a step, instead of the scene's
//   --group NAME      procedures, long or peers
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "harness/machine.hpp"
#include "harness/results.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;
using nlohmann::ordered_json;

const fs::path root = ENDOWIRE_SOURCE_DIR;

struct Options {
  fs::path out = root / "bench/results" / bench::machine_slug();
  fs::path cache;
  double step_mm = 0.0;
  std::string group;
  bool list = false, machine = false, json = false;
  std::vector<std::string> names;
};

Options options_of(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw base::InputError(argument + " needs a value");
      return arguments[++i];
    };
    if (argument == "--list") {
      options.list = true;
    } else if (argument == "--machine") {
      options.machine = true;
    } else if (argument == "--json") {
      options.json = true;
    } else if (argument == "--out") {
      options.out = value();
    } else if (argument == "--cache") {
      options.cache = value();
    } else if (argument == "--group") {
      options.group = value();
    } else if (argument == "--step") {
      options.step_mm = std::atof(value().c_str());
      if (!(options.step_mm >= 1e-3 && options.step_mm <= 10.0))
        throw base::InputError("--step is " + arguments[i] + "; must be between 0.001 and 10 mm");
    } else if (argument.starts_with("--")) {
      throw base::InputError(argument + " is no option; see the head of bench/scenarios_bench.cpp");
    } else {
      options.names.push_back(argument);
    }
  }
  return options;
}

std::vector<bench::Scenario> chosen(const Options& options) {
  const std::vector<bench::Scenario> all = bench::scenarios();
  std::vector<bench::Scenario> out;
  for (const std::string& name : options.names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
    if (found != all.end()) {
      out.push_back(*found);
    } else if (name.ends_with(".toml")) {
      out.push_back({fs::path(name).stem().string(), name, name, 0.0, 0.0, 0, 0, false, ""});
    } else {
      throw base::InputError(name + " is no scenario; --list names those whose vessels are there");
    }
  }
  if (options.names.empty())
    for (const bench::Scenario& scenario : all)
      if (options.group.empty() || scenario.group == options.group) out.push_back(scenario);
  for (bench::Scenario& scenario : out)
    if (options.step_mm > 0.0) scenario.step_mm = options.step_mm;
  return out;
}

/// In a process of its own, so that the peak memory is that of this scenario. False when it failed; it has said why.
bool in_child(const std::function<void()>& work) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process could be started");
  if (child == 0) {
    int status = 0;
    try {
      work();
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      status = 2;
    }
    std::fflush(nullptr);
    _exit(status);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

ordered_json json_file(const fs::path& path) {
  return ordered_json::parse(std::ifstream(path));
}

/// Crossings that the independent judge finds when the program plays the scene; null when it could not.
ordered_json judged_crossings(const bench::Scenario& scenario, const fs::path& cache) {
  const fs::path out =
      fs::temp_directory_path() / fmt::format("endowire_judged_{}_{}", scenario.name, getpid());
  const std::string command =
      fmt::format("{}'{}' simulate '{}' --out '{}' > /dev/null 2>&1",
                  cache.empty() ? "" : fmt::format("XDG_CACHE_HOME='{}' ", cache.string()), ENDOWIRE_PROGRAM,
                  scenario.scene.string(), out.string());
  const int status = std::system(command.c_str());
  ordered_json crossings = nullptr;
  if (status != -1 && fs::exists(out / "summary.json"))
    crossings = json_file(out / "summary.json").at("wall_crossings");
  fs::remove_all(out);
  return crossings.is_number() ? crossings : nullptr;
}

/// One scenario into files.
bool run(const bench::Scenario& scenario, const Options& options) {
  const fs::path file = options.out / (scenario.name + ".json");
  fs::remove(file);
  if (!in_child([&] {
        bench::write_results(options.out, bench::measure(scenario, {options.cache, true, false}));
      }))
    return false;
  if (scenario.judged && scenario.step_mm == 0.0) {
    ordered_json result = json_file(file);
    result["crossings"] = judged_crossings(scenario, options.cache);
    io::write_file_atomically(file, result.dump(2) + "\n");
  }
  return true;
}

/// All scenarios that the folder has, in the order in which they ship: one that was timed before stays in the summary.
void sum_up(const fs::path& folder, const std::vector<bench::Scenario>& timed) {
  std::vector<ordered_json> all;
  for (const bench::Scenario& scenario : bench::scenarios())
    if (fs::exists(folder / (scenario.name + ".json")))
      all.push_back(json_file(folder / (scenario.name + ".json")));
  io::write_file_atomically(folder / "summary.csv", bench::summary_csv(all));
  std::vector<ordered_json> now;
  for (const bench::Scenario& scenario : timed)
    if (fs::exists(folder / (scenario.name + ".json")))
      now.push_back(json_file(folder / (scenario.name + ".json")));
  fmt::print("\n{}\n{}\n{}\n", bench::processor(), bench::compiler(), bench::summary_table(now));
  fmt::print("written: {}/summary.csv; NAME.json, NAME.csv, NAME.svg of each\n", folder.string());
}

int bench_all(const Options& options) {
  if (options.machine) {
    fmt::print("{}\n", bench::machine_slug());
    return 0;
  }
  const std::vector<bench::Scenario> all = chosen(options);
  if (options.list) {
    for (const bench::Scenario& scenario : all) fmt::print("{:<36}{}\n", scenario.name, scenario.what);
    return 0;
  }
  bool good = true;
  std::size_t number = 0;
  for (const bench::Scenario& scenario : all) {
    ++number;
    if (options.json) {
      good =
          in_child([&] {
            fmt::print("{}\n", bench::to_json(bench::measure(scenario, {options.cache, false, true})).dump());
          }) &&
          good;
      continue;
    }
    fmt::print("[{}/{}] {} ", number, all.size(), scenario.name);
    std::fflush(nullptr);
    const double start_us = bench::wall_us();
    good = run(scenario, options) && good;
    fmt::print("{:.0f} s\n", 1e-6 * (bench::wall_us() - start_us));
  }
  if (!options.json) sum_up(options.out, all);
  return good ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return bench_all(options_of({argv + 1, argv + argc}));
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}

// bench_compare OLD NEW ROUNDS [SCENARIO ...]: OLD and NEW are two builds of bench_scenarios. Each round plays every scenario with
// both, in turns that swap (old new, new old, …), so that what the machine does meanwhile meets both alike. Prints ratios new / old.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "endowire/io/statistics.hpp"
#include "harness/scenario.hpp"

namespace {

using namespace endowire;
using nlohmann::json;

/// One round of a scenario by one build.
json played(const std::string& program, const std::string& scenario) {
  const std::string command = fmt::format("'{0}' --json --cache '{0}.cache' '{1}'", program, scenario);
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + program);
  std::string text;
  std::array<char, 4096> piece{};
  while (std::fgets(piece.data(), static_cast<int>(piece.size()), pipe) != nullptr) text += piece.data();
  if (pclose(pipe) != 0) throw std::runtime_error(program + " failed on " + scenario);
  return json::parse(text);
}

/// A figure of both builds, a value a round, and their ratios.
struct Figure {
  const char* name;
  json::json_pointer at;
  std::vector<double> old_values{}, new_values{};

  void add(const json& before, const json& now) {
    old_values.push_back(before.at(at).get<double>());
    new_values.push_back(now.at(at).get<double>());
  }
  void print() const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < old_values.size(); ++i)
      if (old_values[i] > 0.0) ratios.push_back(new_values[i] / old_values[i]);
    if (ratios.empty()) return;
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    fmt::print("    {:<26}{:>12.4g}{:>12.4g}   ratio {:.3f}   ({:.3f} to {:.3f})\n", name,
               io::percentile(old_values, 0.5), io::percentile(new_values, 0.5), io::percentile(ratios, 0.5),
               *least, *most);
  }
};

/// Plays a scenario in turns. @return the ratio of all computing
double compare(const std::string& old_program, const std::string& new_program, const std::string& scenario,
               int rounds) {
  std::vector<Figure> figures{{"computing, all [ms]", json::json_pointer("/total_ms")},
                              {"p50, no snap [us]", json::json_pointer("/calm_us/p50")},
                              {"p99, no snap [us]", json::json_pointer("/calm_us/p99")},
                              {"p50 with a snap [us]", json::json_pointer("/snap_us/p50")},
                              {"us an iteration and rod", json::json_pointer("/us_per_iteration_and_rod")},
                              {"Newton iterations", json::json_pointer("/newton_iterations_mean")},
                              {"rods", json::json_pointer("/rods/mean")},
                              {"samples", json::json_pointer("/samples/mean")},
                              {"peak memory [MB]", json::json_pointer("/peak_mb")}};
  json before;
  json now;
  for (int round = 0; round < rounds; ++round) {
    if (round % 2 == 0) before = played(old_program, scenario);
    now = played(new_program, scenario);
    if (round % 2 == 1) before = played(old_program, scenario);
    for (Figure& figure : figures) figure.add(before, now);
    fmt::print(stderr, "\r{}: round {} of {} ", scenario, round + 1, rounds);
  }
  fmt::print(stderr, "\n");
  const bool same = before["state_hash"] == now["state_hash"];
  fmt::print(
      "{}: {}\n", scenario,
      same ? "the same bits"
           : fmt::format("OTHER STATES ({} {}), tip and forces must be compared",
                         before["state_hash"].get<std::string>(), now["state_hash"].get<std::string>()));
  fmt::print("    {:<26}{:>12}{:>12}   median of {} (least to most)\n", "", "old", "new", rounds);
  for (const Figure& figure : figures) figure.print();
  for (const json* run : {&before, &now})
    if ((*run)["converged"] != (*run)["steps"])
      fmt::print("    {}: {} of {} steps converged\n", run == &before ? "old" : "new",
                 (*run)["converged"].dump(), (*run)["steps"].dump());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < figures[0].old_values.size(); ++i)
    ratios.push_back(figures[0].new_values[i] / figures[0].old_values[i]);
  return io::percentile(ratios, 0.5);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 0;
  if (rounds < 1) {
    fmt::print(stderr, "usage: bench_compare OLD NEW ROUNDS [SCENARIO ...]\n");
    return 2;
  }
  std::vector<std::string> names(argv + 4, argv + argc);
  if (names.empty())
    for (const bench::Scenario& scenario : bench::scenarios())
      if (scenario.group == "procedures" && scenario.step_mm == 0.0 && scenario.rod_mm == 0.0)
        names.push_back(scenario.name);
  try {
    std::vector<std::string> lines;
    for (const std::string& name : names)
      lines.push_back(fmt::format("{:<36}{:.3f}", name, compare(argv[1], argv[2], name, rounds)));
    fmt::print("\nall computing, new / old:\n");
    for (const std::string& line : lines) fmt::print("  {}\n", line);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  return 0;
}

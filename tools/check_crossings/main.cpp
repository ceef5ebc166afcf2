// check_crossings WIRE.pvd VESSEL.stl: did the wire ever leave the vessel through its wall?
//
// Judges a recording against the triangles as they are in the file. Shares no code with the simulator.
// Exit: 0 no crossing, 1 crossings, 2 input that cannot be judged.

#include <vtkLogger.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "input_error.hpp"
#include "judge.hpp"
#include "lumen.hpp"
#include "recording.hpp"

namespace {

using crossings::Crossing;
using crossings::Verdict;

struct Arguments {
  std::string recording;
  std::string vessel;
  std::string unit = "mm";
  std::optional<double> radius_mm;
  double limit_mm = 0.2;
  std::vector<double> sheath_mm;
  bool json = false;
};

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string place(const Crossing& c) {
  return "step " + std::to_string(c.step) + ", arc " + number(c.arc_mm, 1) + " mm, position (" +
         number(c.position_mm.x(), 2) + ", " + number(c.position_mm.y(), 2) + ", " +
         number(c.position_mm.z(), 2) + ")";
}

nlohmann::json to_json(const Crossing& c) {
  return {
      {"kind", name_of(c.kind)},  {"step", c.step},
      {"arc_mm", c.arc_mm},       {"depth_mm", c.depth_mm},
      {"length_mm", c.length_mm}, {"position_mm", {c.position_mm.x(), c.position_mm.y(), c.position_mm.z()}}};
}

nlohmann::json to_json(const Verdict& v, const crossings::Lumen& lumen, double limit_mm) {
  nlohmann::json holes = nlohmann::json::array();
  for (const crossings::Hole& hole : lumen.holes()) {
    holes.push_back({{"kind", hole.opening ? "opening" : "pin_hole"},
                     {"diameter_mm", hole.diameter_mm},
                     {"lumen_radius_mm", hole.lumen_radius_mm},
                     {"centre_mm", {hole.centre_mm.x(), hole.centre_mm.y(), hole.centre_mm.z()}}});
  }
  nlohmann::json examples = nlohmann::json::array();
  for (const Crossing& c : v.examples) examples.push_back(to_json(c));
  return {{"schema", 1},
          {"crossings", v.crossings()},
          {"deep_points", v.deep_points},
          {"axis_passes", v.axis_passes},
          {"path_passes", v.path_passes},
          {"steps", v.steps},
          {"steps_with_crossings", v.steps_with_crossings},
          {"points", v.points},
          {"limit_mm", limit_mm},
          {"deepest", to_json(v.deepest)},
          {"examples", examples},
          {"vessel", {{"triangles", lumen.triangles()}, {"holes", holes}}}};
}

void print(const Verdict& v) {
  std::cout << "crossings: " << v.crossings() << "  (steps " << v.steps << ", points " << v.points;
  if (v.deepest.depth_mm > 0.0) {
    std::cout << ", deepest " << number(v.deepest.depth_mm, 3) << " mm at " << place(v.deepest);
  } else {
    std::cout << ", no point outside";
  }
  std::cout << ")\n";
  if (v.crossings() == 0) return;
  std::cout << "  points too deep " << v.deep_points << ", axis through the wall " << v.axis_passes
            << ", path between steps through the wall " << v.path_passes << ", in " << v.steps_with_crossings
            << " steps\n";
  for (const Crossing& c : v.examples) {
    std::cout << "  " << name_of(c.kind) << ": " << place(c)
              << (c.kind == crossings::CrossingKind::depth ? ", deep " + number(c.depth_mm, 3) + " mm"
                                                           : ", piece of " + number(c.length_mm, 3) + " mm")
              << "\n";
  }
}

void add(Verdict& sum, const Verdict& v) {
  sum.steps = std::max(sum.steps, v.steps);
  sum.points += v.points;
  sum.deep_points += v.deep_points;
  sum.axis_passes += v.axis_passes;
  sum.path_passes += v.path_passes;
  sum.steps_with_crossings += v.steps_with_crossings;
  if (v.deepest.depth_mm > sum.deepest.depth_mm) sum.deepest = v.deepest;
  for (const Crossing& c : v.examples) {
    if (sum.examples.size() < Verdict::max_examples) sum.examples.push_back(c);
  }
}

int run(const Arguments& arguments) {
  const double mm_per_unit = arguments.unit == "m" ? 1000.0 : arguments.unit == "cm" ? 10.0 : 1.0;
  const crossings::Lumen lumen = crossings::Lumen::read(arguments.vessel, mm_per_unit);
  std::optional<Eigen::Vector3d> sheath;
  if (!arguments.sheath_mm.empty()) {
    sheath = Eigen::Vector3d(arguments.sheath_mm[0], arguments.sheath_mm[1], arguments.sheath_mm[2]);
  }
  crossings::Settings settings;
  settings.limit_mm = arguments.limit_mm;
  std::map<int, crossings::Judge> judges;  // one for each wire of the recording
  for (const crossings::RecordedFile& file : crossings::read_collection(arguments.recording)) {
    auto [judge, fresh] = judges.try_emplace(file.part, lumen, settings);
    judge->second.step(crossings::read_axis(file.path, arguments.radius_mm, sheath));
  }
  Verdict verdict;
  for (const auto& [part, judge] : judges) add(verdict, judge.verdict());
  if (arguments.json) {
    std::cout << to_json(verdict, lumen, settings.limit_mm).dump(2) << "\n";
  } else {
    print(verdict);
  }
  return verdict.crossings() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Did the wire ever leave the vessel through its wall? Exit 0: no, 1: yes, 2: bad input.");
  app.add_option("recording", arguments.recording, "wire.pvd, the axis of the wire at every recorded step")
      ->required();
  app.add_option("vessel", arguments.vessel, "STL file of the lumen")->required();
  app.add_option("--unit", arguments.unit, "unit of the STL file")->check(CLI::IsMember({"mm", "cm", "m"}));
  app.add_option("--radius-mm", arguments.radius_mm, "outer radius, instead of radius_mm of the files")
      ->check(CLI::PositiveNumber);
  app.add_option("--limit-mm", arguments.limit_mm,
                 "depth outside the lumen that is still the wall giving way")
      ->check(CLI::PositiveNumber);
  app.add_option("--sheath", arguments.sheath_mm, "x,y,z: the wire behind this point lies in the sheath")
      ->delimiter(',')
      ->expected(3);
  app.add_flag("--json", arguments.json, "the verdict as JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "check_crossings: " << error.what() << "\n";
    return 2;
  }
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // the user reads one line, ours
    return run(arguments);
  } catch (const crossings::InputError& error) {
    std::cerr << "check_crossings: " << error.what() << "\n";
    return 2;
  }
}

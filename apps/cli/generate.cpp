#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/generated_json.hpp"
#include "endowire/vessel/generate.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::cli {

namespace {

using vessel::anatomy::LesionRequest;

struct Options {
  std::string name;
  bool list = false;
  bool parameters = false;
  std::string out;
  std::string json;
  CLI::Option* seed_given = nullptr;
  std::uint64_t seed = 0;
  std::vector<std::string> settings;
  std::vector<std::string> stenoses;
  std::vector<std::string> aneurysms;
  bool open_ends = false;
};

constexpr const char* name_field = "generate: NAME";

void print_generators() {
  for (const vessel::Generator& generator : vessel::generators())
    fmt::print("{:<16} {}\n", generator.name, generator.meaning);
}

void print_parameters(const std::string& name) {
  const vessel::Generator generator = vessel::generator_named(name, name_field);
  fmt::print("{}: {}\n\n", generator.name, generator.meaning);
  for (const vessel::anatomy::Parameter& p : generator.parameters) {
    fmt::print("{:<34} {:>6} {:<4} {:>6} to {:<6}  {}\n", p.name, p.usual, p.unit, p.low, p.high, p.meaning);
    fmt::print("{:<34} {}\n", "", p.source);
  }
}

double number_of(const std::string& text, const std::string& field) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc() || stop != end)
    throw base::InputError(fmt::format("{} is \"{}\"; must be a number", field, text));
  return number;
}

/// `name=value`, each.
vessel::anatomy::Settings settings_of(const std::vector<std::string>& texts) {
  vessel::anatomy::Settings settings;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw base::InputError(fmt::format("--set is \"{}\"; must be name=value", text));
    const std::string name = text.substr(0, equals);
    settings[name] = number_of(text.substr(equals + 1), "--set " + name);
  }
  return settings;
}

/// `branch:arc_mm:length_mm:percent`, each.
void add_lesions(vessel::GenerateRequest& request, LesionRequest::Kind kind, const char* option,
                 const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
      if (c == ':')
        parts.emplace_back();
      else
        parts.back() += c;
    }
    if (parts.size() != 4)
      throw base::InputError(
          fmt::format("{} is \"{}\"; must be branch:arc_mm:length_mm:percent", option, text));
    const std::string field = option;
    request.lesions.push_back({kind, parts[0], number_of(parts[1], field + " arc_mm"),
                               number_of(parts[2], field + " length_mm"),
                               number_of(parts[3], field + " percent")});
  }
}

vessel::GenerateRequest request_of(const Options& options) {
  vessel::GenerateRequest request;
  request.name = options.name;
  request.generator_field = name_field;
  if (options.seed_given->count() > 0) request.seed = options.seed;
  request.settings = settings_of(options.settings);
  request.open_ends = options.open_ends;
  add_lesions(request, LesionRequest::Kind::stenosis, "--stenosis", options.stenoses);
  add_lesions(request, LesionRequest::Kind::aneurysm, "--aneurysm", options.aneurysms);
  request.settings_prefix = "--set ";
  request.stenosis_field = "--stenosis";
  request.aneurysm_field = "--aneurysm";
  return request;
}

std::string place(const Eigen::Vector3d& point) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", point.x(), point.y(), point.z());
}

void print_vessel(const vessel::GeneratedVessel& vessel, const Options& options) {
  fmt::print("{}: {} triangles{}\n", options.out, vessel.mesh.triangles.size(),
             options.open_ends ? ", open at the vessels' ends" : ", closed");
  const Eigen::Vector3d& d = vessel.access_direction;
  fmt::print("access position_mm = [{:.2f}, {:.2f}, {:.2f}], direction = [{:.4f}, {:.4f}, {:.4f}]\n",
             vessel.access_position_mm.x(), vessel.access_position_mm.y(), vessel.access_position_mm.z(),
             d.x(), d.y(), d.z());
  fmt::print("\n{:<44} {:>9}\n", "vessel", "length mm");
  for (const vessel::anatomy::Branch& branch : vessel.branches)
    fmt::print("{:<44} {:>9.1f}\n", branch.name, branch.axis.length_mm() - branch.ostium_arc_mm);
  fmt::print("\n{:<28} {:<44} {:>7}  {:<24} {:>9}\n", "landmark", "vessel", "arc mm", "position mm",
             "radius mm");
  for (const vessel::Landmark& mark : vessel.landmarks)
    fmt::print("{:<28} {:<44} {:>7.1f}  {:<24} {:>9.2f}\n", mark.name, mark.branch, mark.arc_mm,
               place(mark.position_mm), mark.lumen_radius_mm);
}

int run(const Options& options) {
  if (options.list) {
    print_generators();
    return exit_success;
  }
  if (options.name.empty()) throw base::InputError("generate: NAME is missing; `generate --list` names them");
  if (options.parameters) {
    print_parameters(options.name);
    return exit_success;
  }
  if (options.out.empty())
    throw base::InputError("generate: --out is missing; must be the path of an STL file");
  const vessel::GeneratedVessel vessel = vessel::generate(request_of(options));
  const std::vector<std::byte> stl = vessel::write_binary_stl(vessel.mesh);
  io::write_file_atomically(options.out, {reinterpret_cast<const char*>(stl.data()), stl.size()});
  if (!options.json.empty())
    io::write_file_atomically(options.json, io::generated_json(vessel).dump(1) + "\n");
  print_vessel(vessel, options);
  return exit_success;
}

}  // namespace

std::function<int()> add_generate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("generate", "make a vessel in code, from published dimensions");
  command->add_option("NAME", options->name, "an anatomy");
  command->add_flag("--list", options->list, "names the anatomies");
  command->add_flag("--parameters", options->parameters,
                    "what can be set: default, range and source of each");
  command->add_option("--out", options->out, "STL file to write");
  command->add_option("--json", options->json,
                      "also write access, landmarks, axes and calibres to this file");
  options->seed_given =
      command->add_option("--seed", options->seed, "draw everything that is not set within its range");
  command->add_option("--set", options->settings, "name=value, as often as wanted")->allow_extra_args(false);
  command->add_option("--stenosis", options->stenoses, "branch:arc_mm:length_mm:percent of the diameter")
      ->allow_extra_args(false);
  command->add_option("--aneurysm", options->aneurysms, "branch:arc_mm:length_mm:percent of the diameter")
      ->allow_extra_args(false);
  command->add_flag("--open-ends", options->open_ends,
                    "openings at the vessels' ends, which a wire can leave by, instead of half balls");
  return [options] { return run(*options); };
}

}  // namespace endowire::cli

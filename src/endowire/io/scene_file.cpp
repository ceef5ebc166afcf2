#include "endowire/io/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/instrument_file.hpp"
#include "endowire/io/toml_table.hpp"
#include "endowire/rod/rest_shape.hpp"

namespace endowire::io {

namespace fs = std::filesystem;
using base::InputError;

namespace {

constexpr std::uintmax_t max_scene_bytes = 16 << 20;  // a hand-written file, with room for long scripts
constexpr double max_steps = 1e6;  // three hours at 100 Hz; a slip of a unit gives far more

const char* const default_perforation_source =
    "estimate: the order at which a stiff tip passes an arterial wall; no measurement is cited";

vessel::GenerateRequest read_generator(const TomlTable& table) {
  std::string known;
  bool found = false;
  vessel::GenerateRequest request;
  const std::vector<vessel::Generator> generators = vessel::generators();
  for (const vessel::Generator& generator : generators)
    known += (known.empty() ? "one of \"" : ", \"") + generator.name + '"';
  request.name = table.string("generate", known);
  for (const vessel::Generator& generator : generators) found = found || generator.name == request.name;
  if (!found) table.refuse("generate", '"' + request.name + '"', known);
  constexpr auto largest_seed = std::numeric_limits<std::int64_t>::max();
  if (table.has("seed")) request.seed = static_cast<std::uint64_t>(table.integer("seed", 0, largest_seed));
  request.open_ends = table.boolean_or("open_ends", false);
  for (const auto& [name, number] : table.numbers("parameters")) request.settings.emplace(name, number);
  using Kind = vessel::anatomy::LesionRequest::Kind;
  for (const Kind kind : {Kind::stenosis, Kind::aneurysm})
    for (const TomlTable& lesion : table.tables(kind == Kind::stenosis ? "stenosis" : "aneurysm",
                                                {"branch", "arc_mm", "length_mm", "percent"}))
      request.lesions.push_back(
          {kind, lesion.string("branch", "the name of a vessel"), lesion.number("arc_mm", any_number()),
           lesion.number("length_mm", any_number()), lesion.number("percent", any_number())});
  const std::string vessel = table.file() + ": vessel.";
  request.generator_field = vessel + "generate";
  request.settings_prefix = vessel + "parameters.";
  request.stenosis_field = vessel + "stenosis";
  request.aneurysm_field = vessel + "aneurysm";
  return request;
}

VolumeOptions read_volume_options(const TomlTable& table) {
  VolumeOptions options;
  if (table.has("threshold")) options.threshold = table.number("threshold", any_number());
  if (table.has("threshold_high")) {
    if (!options.threshold) table.refuse("threshold_high", "given alone", "given with threshold");
    options.threshold_high = table.number("threshold_high", any_number());
  }
  if (table.has("label")) options.label = table.integer("label", 1, 1'000'000'000);
  if (table.has("smooth"))
    options.smooth = static_cast<int>(table.integer("smooth", 0, max_smoothing_passes));
  const std::string keep = table.string_or("keep", "largest", "\"largest\" or \"all\"");
  if (keep != "largest" && keep != "all") table.refuse("keep", '"' + keep + '"', "\"largest\" or \"all\"");
  options.keep_all = keep == "all";
  return options;
}

VesselSource read_vessel(const TomlTable& root, const fs::path& folder, const RecordedParts* recorded) {
  const std::optional<TomlTable> table =
      root.table("vessel", {"file", "unit", "threshold", "threshold_high", "label", "smooth", "keep",
                            "generate", "seed", "open_ends", "parameters", "stenosis", "aneurysm"});
  if (!table) root.refuse_missing("vessel", "a table with file or generate");
  VesselSource vessel;
  std::string unit;
  if (table->has("unit")) {
    unit = table->string("unit", "\"mm\", \"cm\" or \"m\"");
    vessel.unit = vessel::parse_length_unit(unit, table->file() + ": " + table->path_of("unit"));
  }
  if (table->has("file") == table->has("generate"))
    root.refuse("vessel",
                table->has("file") ? "given both file and generate" : "given neither file nor generate",
                "given one of the two");
  if (table->has("generate")) {
    vessel.generate = read_generator(*table);
    if (!unit.empty() && unit != "mm")
      table->refuse("unit", '"' + unit + '"', "\"mm\" for a generated vessel");
    for (const char* key : {"threshold", "threshold_high", "label", "smooth", "keep"})
      if (table->has(key))
        table->refuse(key, "given for a generated vessel", "left out: it belongs to an image volume");
    return vessel;
  }
  for (const char* key : {"seed", "open_ends", "parameters", "stenosis", "aneurysm"})
    if (table->has(key)) table->refuse(key, "given with a file", "left out: it belongs to generate");
  vessel.volume = read_volume_options(*table);
  const std::string text = table->string("file", "the path of a mesh or of an image volume");
  if (recorded != nullptr) {
    vessel.file = recorded->vessel_file;
    return vessel;
  }
  vessel.file = (folder / text).lexically_normal();
  std::error_code error;
  if (!fs::exists(vessel.file, error))
    table->refuse("file", '"' + text + '"',
                  fmt::format("an existing file ({} is none)", vessel.file.string()));
  return vessel;
}

void read_access(const TomlTable& root, SceneFile& scene) {
  const std::optional<TomlTable> table = root.table("access", {"position_mm", "direction", "opening"});
  scene.access_given = table.has_value();
  if (!table && scene.vessel.generate) return;
  if (!table) root.refuse_missing("access", "a table with position_mm and direction, or opening");
  if (table->has("opening")) {
    if (table->has("position_mm") || table->has("direction"))
      root.refuse("access", "given both an opening and a position", "given one of the two");
    scene.opening = static_cast<int>(table->integer("opening", 1, 10'000));
    return;
  }
  scene.access.position_mm = table->vector("position_mm");
  if (scene.access.position_mm.cwiseAbs().maxCoeff() > 1e5)
    table->refuse("position_mm", fmt::format("{} from the origin", scene.access.position_mm.norm()),
                  "within 100000 mm of it");
  const Eigen::Vector3d direction = table->vector("direction");
  // Scaled first: the square of a tiny or huge component must neither vanish nor overflow.
  const double largest = direction.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) table->refuse("direction", "[0, 0, 0]", "a vector of some length, into the vessel");
  scene.access.direction = (direction / largest).normalized();
}

/// The tip as the user bends it.
void shape_tip(const TomlTable& table, rod::Instrument& instrument) {
  if (!table.has("tip_angle_deg")) {
    for (const char* const key : {"tip_length_mm", "tip_radius_mm"})
      if (table.has(key)) table.refuse(key, "given without tip_angle_deg", "left out, or given beside it");
    return;
  }
  rod::TipBend bend;
  const double angle_deg = table.number("tip_angle_deg", between(-270.0, 270.0));
  if (angle_deg == 0.0) table.refuse("tip_angle_deg", "0", "another angle, or left out");
  bend.angle_rad = angle_deg * std::numbers::pi / 180.0;
  if (table.has("tip_length_mm") == table.has("tip_radius_mm"))
    table.refuse("tip_length_mm", table.has("tip_length_mm") ? "given beside tip_radius_mm" : "missing",
                 "given, or else tip_radius_mm");
  bend.length_mm = table.has("tip_length_mm")
                       ? table.number("tip_length_mm", between(0.5, 1000.0))
                       : std::abs(bend.angle_rad) * table.number("tip_radius_mm", between(0.5, 1000.0));
  rod::bend_tip(bend, table.file() + ": " + table.path_of(""), instrument);
}

rod::Instrument read_instrument(const TomlTable& root, const fs::path& folder,
                                const std::vector<fs::path>& instrument_folders) {
  const std::vector<TomlTable> tables =
      root.tables("instrument", {"model", "grip_force_n", "grip_torque_n_mm", "friction", "tip_angle_deg",
                                 "tip_length_mm", "tip_radius_mm"});
  if (tables.empty()) root.refuse_missing("instrument", "one [[instrument]]");
  if (tables.size() > 1)
    root.refuse("instrument", fmt::format("a list of {}", tables.size()),
                "one: this version simulates one instrument");
  const TomlTable& table = tables.front();
  const std::string model = table.string("model", "the name of an instrument or the path of a .toml file");
  fs::path path;
  if (fs::path(model).extension() == ".toml") {
    path = (folder / model).lexically_normal();
    std::error_code error;
    if (!fs::is_regular_file(path, error))
      table.refuse("model", '"' + model + '"', fmt::format("an existing file ({} is none)", path.string()));
  } else {
    // A name, never a way out of the folders.
    if (model.find_first_of("/\\") == std::string::npos) path = find_instrument(model, instrument_folders);
    if (path.empty()) {
      std::string known;
      for (const std::string& name : list_instruments(instrument_folders))
        known += (known.empty() ? "" : ", ") + name;
      table.refuse("model", '"' + model + '"',
                   known.empty() ? "the path of a .toml file (no instrument library was found)"
                                 : "one of " + known + ", or the path of a .toml file");
    }
  }
  rod::Instrument instrument = read_instrument_file(path).instrument;
  instrument.grip_force_n = table.number_or("grip_force_n", instrument.grip_force_n, above(0.0));
  instrument.grip_torque_n_mm = table.number_or("grip_torque_n_mm", instrument.grip_torque_n_mm, above(0.0));
  if (table.has("friction")) {
    const double friction = table.number("friction", between(0.0, 2.0));
    for (rod::Section& section : instrument.sections) section.friction = friction;
  }
  shape_tip(table, instrument);
  instrument.validate(table.file() + ": " + root.path_of("instrument[0]"));
  return instrument;
}

void read_wall(const TomlTable& root, SceneFile& scene) {
  scene.perforation_source = default_perforation_source;
  const std::optional<TomlTable> table =
      root.table("wall", {"modulus_mpa", "poisson_ratio", "thickness_over_radius", "max_deflection_mm",
                          "perforation_force_n", "perforation_source"});
  if (!table) return;
  sim::SimulationSpec& spec = scene.simulation;
  sim::WallSpec& wall = spec.wall;
  wall.modulus_mpa = table->number_or("modulus_mpa", wall.modulus_mpa, between(0.1, 1000.0));
  wall.poisson_ratio = table->number_or("poisson_ratio", wall.poisson_ratio, between(0.0, 0.49));
  wall.thickness_over_radius =
      table->number_or("thickness_over_radius", wall.thickness_over_radius, between(0.01, 1.0));
  wall.max_deflection_mm = table->number_or("max_deflection_mm", wall.max_deflection_mm, between(0.01, 0.18));
  spec.perforation_force_n = table->number_or("perforation_force_n", spec.perforation_force_n, above(0.0));
  if (table->has("perforation_force_n")) scene.perforation_source = "the scene";
  scene.perforation_source =
      table->string_or("perforation_source", scene.perforation_source, "where the threshold comes from");
}

/// Whether the branch exists is known once the vessel is.
void read_target(const TomlTable& root, SceneFile& scene) {
  const std::optional<TomlTable> table =
      root.table("target", {"name", "branch", "near_mm", "opening", "beyond_ostium_mm", "within_radii"});
  if (!table) return;
  const int places =
      (table->has("branch") ? 1 : 0) + (table->has("near_mm") ? 1 : 0) + (table->has("opening") ? 1 : 0);
  if (places != 1)
    root.refuse("target", places == 0 ? "given no branch, near_mm or opening" : "given more than one place",
                "given one of branch, near_mm and opening");
  sim::TargetSpec target;
  target.name = table->string_or("name", "", "a text");
  if (table->has("opening")) {
    scene.target_opening = static_cast<int>(table->integer("opening", 1, 10'000));
    if (table->has("beyond_ostium_mm"))
      table->refuse("beyond_ostium_mm", "given with an opening", "left out: the opening is the place");
  } else if (table->has("near_mm")) {
    target.near_mm = table->vector("near_mm");
  } else {
    target.branch = table->string("branch", "the name of a branch, as endowire inspect lists it");
  }
  if (table->has("beyond_ostium_mm"))
    target.beyond_ostium_mm = table->number("beyond_ostium_mm", between(0.0, max_motion_mm));
  target.within_radii = table->number_or("within_radii", target.within_radii, between(0.1, 10.0));
  scene.target = target;
}

void read_solver(const TomlTable& root, sim::SolverSpec& solver) {
  const std::optional<TomlTable> table = root.table(
      "solver", {"correction_tolerance_mm", "correction_tolerance_deg", "force_tolerance", "proximal_scale",
                 "stick_stiffness_ratio", "grip_stiffness_n_per_mm", "max_iterations", "max_splits"});
  if (!table) return;
  const auto positive = [](double high) {
    Range range = above(0.0);
    range.high = high;
    return range;
  };
  const auto read = [&](std::string_view key, double& value, const Range& range) {
    value = table->number_or(key, value, range);
  };
  read("correction_tolerance_mm", solver.correction_tolerance_mm, positive(0.1));
  read("correction_tolerance_deg", solver.correction_tolerance_deg, positive(1.0));
  read("force_tolerance", solver.force_tolerance, positive(0.01));
  read("proximal_scale", solver.proximal_scale, positive(1e6));
  read("stick_stiffness_ratio", solver.stick_stiffness_ratio, positive(1e3));
  read("grip_stiffness_n_per_mm", solver.grip_stiffness_n_per_mm, positive(1e6));
  solver.max_iterations =
      static_cast<int>(table->integer_or("max_iterations", solver.max_iterations, 1, 10'000));
  solver.max_splits = static_cast<int>(table->integer_or("max_splits", solver.max_splits, 0, 20));
}

void read_rods(const TomlTable& root, sim::ResolutionSpec& rods) {
  const std::optional<TomlTable> table =
      root.table("rods", {"adaptive", "rod_length_mm", "longest_mm", "shortest_mm", "shape_tolerance_mm",
                          "max_turn_deg", "max_bias_deg", "lumen_diameters", "budget_mj"});
  if (!table) return;
  const auto read = [&](std::string_view key, double& value, double low, double high) {
    value = table->number_or(key, value, between(low, high));
  };
  const auto read_deg = [&](std::string_view key, double& value_rad, double low, double high) {
    constexpr double rad_per_deg = std::numbers::pi / 180.0;
    if (table->has(key)) value_rad = rad_per_deg * table->number(key, between(low, high));
  };
  rods.adaptive = table->boolean_or("adaptive", rods.adaptive);
  if (rods.adaptive && table->has("rod_length_mm"))
    table->refuse("rod_length_mm", "given for rods that adapt", "given with adaptive = false");
  for (const std::string_view key :
       {"longest_mm", "shortest_mm", "shape_tolerance_mm", "max_turn_deg", "lumen_diameters", "budget_mj"}) {
    if (!rods.adaptive && table->has(key))
      table->refuse(key, "given for uniform rods", "given with adaptive = true");
  }
  read("rod_length_mm", rods.rod_length_mm, 0.2, 20.0);
  read("longest_mm", rods.longest_mm, 0.5, 64.0);
  read("shortest_mm", rods.shortest_mm, 0.2, rods.longest_mm);
  read("shape_tolerance_mm", rods.shape_tolerance_mm, 1e-4, 1.0);
  read_deg("max_turn_deg", rods.max_turn_rad, 1.0, 90.0);
  read_deg("max_bias_deg", rods.max_bias_rad, 0.5, 60.0);
  read("lumen_diameters", rods.lumen_diameters, 0.1, 100.0);
  read("budget_mj", rods.budget_mj, 1e-9, 1e3);
}

void read_simulation(const TomlTable& root, SceneFile& scene) {
  sim::SimulationSpec& spec = scene.simulation;
  if (const auto table = root.table("simulation", {"max_advance_mm", "max_torque_deg", "step_s"})) {
    spec.max_advance_mm = table->number_or("max_advance_mm", spec.max_advance_mm, between(0.001, 10.0));
    spec.max_torque_deg = table->number_or("max_torque_deg", spec.max_torque_deg, between(0.01, 90.0));
    if (table->has("step_s")) scene.step_s = table->number("step_s", between(1e-4, 3600.0));
  }
  if (const auto table = root.table("environment", {"gravity_m_per_s2", "blood_density_g_per_mm3"})) {
    spec.gravity_m_per_s2 = table->vector_or("gravity_m_per_s2", spec.gravity_m_per_s2);
    if (spec.gravity_m_per_s2.norm() > 1000.0)
      table->refuse("gravity_m_per_s2", fmt::format("{} long", spec.gravity_m_per_s2.norm()), "<= 1000 long");
    spec.blood_density_g_per_mm3 =
        table->number_or("blood_density_g_per_mm3", spec.blood_density_g_per_mm3, between(0.0, 2e-3));
  }
  read_wall(root, scene);
  read_rods(root, spec.solver.rods);
  read_solver(root, spec.solver);
}

double steps_of(const sim::Motion& motion, const SceneFile& scene) {
  if (scene.step_s) return std::max(1.0, std::round(motion.duration_s / *scene.step_s));
  double steps = 1.0;
  for (const sim::HandMotion& hand : motion.hands) {
    // The small part keeps 450 mm in steps of 1 mm at 450 steps, whatever the rounding of the quotient.
    steps = std::max(steps, std::ceil(std::abs(hand.advance_mm) / scene.simulation.max_advance_mm - 1e-9));
    steps = std::max(steps, std::ceil(std::abs(hand.torque_deg) / scene.simulation.max_torque_deg - 1e-9));
  }
  return steps;
}

void read_motions(const TomlTable& root, SceneFile& scene, Script script) {
  const std::vector<TomlTable> tables = root.tables("motion", {"duration_s", "hands"});
  if (tables.empty() && script == Script::required) root.refuse_missing("motion", "at least one [[motion]]");
  const double length_mm = scene.instrument.length_mm();
  double advanced_mm = 0.0;
  double steps = 0.0;
  for (const TomlTable& table : tables) {
    sim::Motion motion;
    Range duration = above(0.0);
    duration.high = 1e6;
    motion.duration_s = table.number("duration_s", duration);
    const std::vector<TomlTable> hands = table.tables("hands", {"instrument", "advance_mm", "torque_deg"});
    if (hands.size() > 1)
      table.refuse("hands", fmt::format("a list of {}", hands.size()),
                   "at most one: there is one instrument");
    for (const TomlTable& hand_table : hands) {
      sim::HandMotion hand;
      hand.instrument = static_cast<int>(hand_table.integer_or("instrument", 1, 1, 1));
      hand.advance_mm = hand_table.number_or("advance_mm", 0.0, between(-max_motion_mm, max_motion_mm));
      hand.torque_deg = hand_table.number_or("torque_deg", 0.0, between(-max_motion_deg, max_motion_deg));
      if (advanced_mm + hand.advance_mm > length_mm)
        hand_table.refuse(
            "advance_mm", fmt::format("{}", hand.advance_mm),
            fmt::format("<= {}, what is left of the {} mm of the wire", length_mm - advanced_mm, length_mm));
      advanced_mm += hand.advance_mm;
      motion.hands.push_back(hand);
    }
    const double motion_steps = steps_of(motion, scene);
    steps += motion_steps;
    if (steps > max_steps)
      table.refuse("duration_s",
                   fmt::format("{}, which brings the script to {} steps", motion.duration_s, steps),
                   fmt::format("short enough for {} steps in all", max_steps));
    scene.motions.push_back(std::move(motion));
  }
}

/// @param recorded  null: vessel and instrument are looked for
SceneFile read_scene(const std::string& text, const std::string& name,
                     const std::vector<fs::path>& instrument_folders, const RecordedParts* recorded,
                     Script script) {
  const toml::table toml = parse_toml(text, name);
  const TomlTable root(toml, name, "",
                       {"schema", "title", "vessel", "access", "environment", "wall", "rods", "solver",
                        "instrument", "simulation", "motion", "target"});
  static_cast<void>(root.integer("schema", 1, 1));
  const fs::path folder = fs::path(name).parent_path();
  SceneFile scene;
  scene.name = name;
  scene.text = text;
  scene.title = root.string_or("title", fs::path(name).stem().string(), "a text");
  read_simulation(root, scene);
  scene.vessel = read_vessel(root, folder, recorded);
  read_access(root, scene);
  if (recorded == nullptr) {
    scene.instrument = read_instrument(root, folder, instrument_folders);
  } else {
    recorded->instrument.validate(name + ": instrument");
    scene.instrument = recorded->instrument;
  }
  read_motions(root, scene, script);
  read_target(root, scene);
  return scene;
}

}  // namespace

SceneFile parse_scene(const std::string& text, const std::string& name,
                      const std::vector<fs::path>& instrument_folders, Script script) {
  return read_scene(text, name, instrument_folders, nullptr, script);
}

SceneFile parse_scene(const std::string& text, const std::string& name, const RecordedParts& parts) {
  return read_scene(text, name, {}, &parts, Script::required);
}

SceneFile read_scene_file(const fs::path& path, const std::vector<fs::path>& instrument_folders,
                          Script script) {
  return parse_scene(read_file(path, max_scene_bytes), one_line(path.string()), instrument_folders, script);
}

std::vector<TimedCommand> commands_of(const SceneFile& scene) {
  std::vector<TimedCommand> commands;
  double start_s = 0.0;
  for (const sim::Motion& motion : scene.motions) {
    const double count = steps_of(motion, scene);
    double advance_mm = 0.0;
    double torque_deg = 0.0;
    for (const sim::HandMotion& hand : motion.hands) {
      advance_mm += hand.advance_mm;
      torque_deg += hand.torque_deg;
    }
    const sim::Command command{advance_mm / count, torque_deg / count * std::numbers::pi / 180.0};
    const auto steps = static_cast<std::size_t>(count);
    for (std::size_t i = 1; i <= steps; ++i)
      commands.push_back({start_s + motion.duration_s * (static_cast<double>(i) / count), command});
    start_s += motion.duration_s;
  }
  return commands;
}

}  // namespace endowire::io

#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/scene_vessel.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::test {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const fs::path root = ENDOWIRE_SOURCE_DIR;

constexpr double kSafety = 3.0;

/// What is prepared once for all runs of a scene.
struct Stage {
  explicit Stage(const ReferenceScene& reference)
      : scene(io::read_scene_file(reference.file, {root / "instruments"})),
        vessel(io::vessel_of(scene)),
        field(io::prepare_field(vessel, {}).field),
        access(io::access_of(scene, vessel, *io::prepare_centrelines(vessel, {}))),
        commands(io::commands_of(scene)) {}
  io::SceneFile scene;
  io::VesselMesh vessel;
  std::shared_ptr<const vessel::Field> field;
  sim::Access access;
  std::vector<io::TimedCommand> commands;
};

/// A point of the wire at an arc from its tip, on the straight rods between the joints.
Eigen::Vector3d point_at(const sim::Snapshot& wire, double arc_mm) {
  std::size_t i = 1;
  while (i + 1 < wire.points.size() && wire.points[i].arc_mm < arc_mm) ++i;
  const sim::SnapshotPoint& a = wire.points[i - 1];
  const sim::SnapshotPoint& b = wire.points[i];
  const double t = std::clamp((arc_mm - a.arc_mm) / (b.arc_mm - a.arc_mm), 0.0, 1.0);
  return a.position_mm + t * (b.position_mm - a.position_mm);
}

Moment moment_of(int step, const sim::Simulation& simulation, const sim::StepReport& report, bool converged) {
  Moment moment{step, report.rods, report.inserted_length_mm, report.push_force_n, {}, converged};
  sim::Snapshot wire;
  simulation.snapshot(wire);
  for (int k = 0; k < kShapePoints && wire.points.size() > 1; ++k)
    moment.shape_mm.push_back(point_at(wire, report.inserted_length_mm * k / (kShapePoints - 1)));
  return moment;
}

std::vector<Moment> play(const Stage& stage, const Variation& variation) {
  sim::SimulationSpec spec = stage.scene.simulation;
  const sim::SolverSpec nominal = spec.solver;
  spec.solver.correction_tolerance_mm *= variation.tolerance_scale;
  spec.solver.correction_tolerance_deg *= variation.tolerance_scale;
  spec.solver.force_tolerance *= variation.tolerance_scale;
  spec.solver.rods.shape_tolerance_mm *= variation.shape_tolerance_scale;
  // A jittered step must not become two.
  spec.max_advance_mm += 2.0 * nominal.correction_tolerance_mm;
  spec.max_torque_deg += 2.0 * nominal.correction_tolerance_deg;
  sim::Simulation simulation(stage.field, stage.scene.instrument, stage.access, spec);
  vessel::SplitMix random(variation.jitter_seed);
  std::vector<Moment> moments;
  bool converged = true;
  double error_mm = 0.0;
  double error_rad = 0.0;
  const std::size_t steps = stage.commands.size();
  for (std::size_t i = 0; i < steps; ++i) {
    sim::Command command = stage.commands[i].command;
    if (variation.jitter_seed != 0) {
      const bool last = i + 1 == steps;
      const double next_mm = last ? 0.0 : random.uniform(-1.0, 1.0) * nominal.correction_tolerance_mm;
      const double next_rad =
          last ? 0.0 : random.uniform(-1.0, 1.0) * nominal.correction_tolerance_deg * M_PI / 180.0;
      command.advance_mm += next_mm - error_mm;
      command.torque_rad += next_rad - error_rad;
      error_mm = next_mm;
      error_rad = next_rad;
    }
    const sim::StepReport& report = simulation.step(command);
    converged = converged && report.converged;
    if ((i + 1) * kMoments / steps > i * kMoments / steps)
      moments.push_back(moment_of(static_cast<int>(i) + 1, simulation, report, converged));
  }
  return moments;
}

ordered_json bounds_json(const std::optional<Bounds>& bounds) {
  if (!bounds) return nullptr;
  return {{"shape_mm", bounds->shape_mm}, {"push_n", bounds->push_n}};
}

std::optional<Bounds> bounds_of(const ordered_json& json) {
  if (json.is_null()) return {};
  return Bounds{json.at("shape_mm").get<double>(), json.at("push_n").get<double>()};
}

/// Rounded to what a bound can tell, so that files stay readable.
double rounded(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

}  // namespace

std::vector<ReferenceScene> reference_scenes() {
  return {{"generated_left_carotid", root / "scenes/generated_left_carotid.toml"},
          {"generated_right_carotid", root / "scenes/generated_right_carotid.toml"},
          {"carotid_siphon", root / "bench/scenes/carotid_siphon.toml"},
          {"femoral_entry", root / "scenes/femoral_entry.toml", true},
          {"femoral_to_left_carotid", root / "scenes/femoral_to_left_carotid.toml", true}};
}

std::vector<Moment> play(const ReferenceScene& scene, const Variation& variation) {
  return play(Stage(scene), variation);
}

double apart_mm(const Moment& a, const Moment& b) {
  if (a.shape_mm.size() != b.shape_mm.size()) return HUGE_VAL;
  double most = 0.0;
  for (std::size_t k = 0; k < a.shape_mm.size(); ++k)
    most = std::max(most, (a.shape_mm[k] - b.shape_mm[k]).norm());
  return most;
}

std::vector<KeptMoment> keep(const ReferenceScene& scene) {
  const Stage stage(scene);
  const std::vector<Moment> kept = play(stage, {});
  const std::vector<std::vector<Moment>> as_right{play(stage, {0.1, 0, 1.0}), play(stage, {1.0, 1, 1.0}),
                                                  play(stage, {1.0, 2, 1.0}), play(stage, {1.0, 3, 1.0})};
  const std::vector<std::vector<Moment>> other_rods{play(stage, {1.0, 0, 0.7}), play(stage, {1.0, 0, 1.4})};
  double most_push_n = 0.0;
  for (const Moment& moment : kept) most_push_n = std::max(most_push_n, std::abs(moment.push_n));
  std::vector<KeptMoment> out;
  for (std::size_t m = 0; m < kept.size(); ++m) {
    KeptMoment one{kept[m], {}, {}};
    Bounds apart;
    const auto widen = [&](const std::vector<std::vector<Moment>>& runs) {
      for (const std::vector<Moment>& run : runs) {
        apart.shape_mm = std::max(apart.shape_mm, apart_mm(kept[m], run[m]));
        apart.push_n = std::max(apart.push_n, std::abs(kept[m].push_n - run[m].push_n));
      }
    };
    const auto bounds = [&]() -> std::optional<Bounds> {
      if (!(apart.shape_mm <= kStable_mm && apart.push_n <= kStablePush * most_push_n)) return {};
      // Not below the tolerances: of a correction, and of the lagged normal forces that limit friction.
      const sim::SolverSpec& solver = stage.scene.simulation.solver;
      return Bounds{kSafety * std::max(apart.shape_mm, solver.correction_tolerance_mm),
                    kSafety * std::max(apart.push_n, 2e-3 * most_push_n)};
    };
    widen(as_right);
    one.same_rods = bounds();
    widen(other_rods);
    one.other_rods = bounds();
    out.push_back(one);
  }
  return out;
}

fs::path recorded_file(const ReferenceScene& scene) {
  return root / "tests/references/recorded" / (scene.name + ".json");
}

ordered_json to_json(const ReferenceScene& scene, const std::vector<KeptMoment>& kept) {
  ordered_json moments = ordered_json::array();
  for (const KeptMoment& one : kept) {
    ordered_json shape = ordered_json::array();
    for (const Eigen::Vector3d& p : one.moment.shape_mm)
      shape.push_back({rounded(p.x(), 1e4), rounded(p.y(), 1e4), rounded(p.z(), 1e4)});
    moments.push_back({{"step", one.moment.step},
                       {"rods", one.moment.rods},
                       {"inserted_mm", rounded(one.moment.inserted_mm, 1e6)},
                       {"push_n", rounded(one.moment.push_n, 1e6)},
                       {"bounds", bounds_json(one.same_rods)},
                       {"bounds_other_rods", bounds_json(one.other_rods)},
                       {"shape_mm", shape}});
  }
  return {{"scene", scene.name}, {"made_by", "make references"}, {"moments", moments}};
}

std::vector<KeptMoment> read_kept(const ReferenceScene& scene) {
  std::ifstream file(recorded_file(scene));
  if (!file)
    throw std::runtime_error(recorded_file(scene).string() + " is missing; `make references` writes it");
  std::vector<KeptMoment> out;
  const ordered_json recorded = ordered_json::parse(file);
  for (const ordered_json& json : recorded.at("moments")) {
    KeptMoment one{};
    one.moment.step = json.at("step").get<int>();
    one.moment.rods = json.at("rods").get<int>();
    one.moment.inserted_mm = json.at("inserted_mm").get<double>();
    one.moment.push_n = json.at("push_n").get<double>();
    one.same_rods = bounds_of(json.at("bounds"));
    one.other_rods = bounds_of(json.at("bounds_other_rods"));
    for (const ordered_json& p : json.at("shape_mm"))
      one.moment.shape_mm.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    out.push_back(one);
  }
  return out;
}

}  // namespace endowire::test

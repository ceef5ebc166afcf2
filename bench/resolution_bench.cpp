// bench_resolution [SCENE.toml]: one procedure on rods of several kinds, held against rods of half a millimetre.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/scene_vessel.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/sim/simulation.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;
using Line = std::vector<Eigen::Vector3d>;

constexpr std::size_t kWindow = 50;    // steps over which the push is averaged
constexpr std::size_t kUnsettled = 5;  // steps after a snap that are left out, in either run

struct Step {
  double push_n = 0.0;
  double rods = 0.0;
  bool calm = true;
  Line joints_mm;
};

struct Kind {
  std::string name;
  sim::ResolutionSpec spec;
};

std::vector<Step> play(const io::SceneFile& scene, const io::PreparedField& prepared,
                       const sim::Access& access, const sim::ResolutionSpec& rods) {
  sim::SimulationSpec spec = scene.simulation;
  spec.solver.rods = rods;
  sim::Simulation simulation(prepared.field, scene.instrument, access, spec);
  std::vector<Step> steps;
  std::size_t since_snap = kUnsettled;
  for (const io::TimedCommand& timed : io::commands_of(scene)) {
    const sim::StepReport& report = simulation.step(timed.command);
    since_snap = report.snapped ? 0 : since_snap + 1;
    steps.push_back({report.push_force_n, static_cast<double>(report.rods), since_snap >= kUnsettled,
                     simulation.state().joints_mm});
  }
  return steps;
}

double distance_mm(const Line& line, const Eigen::Vector3d& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d d = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - line[i] - t * d).norm());
  }
  return nearest;
}

/// How far the joints of a wire lie beside a reference, at most.
double beside_mm(const Line& wire, const Line& reference) {
  double worst = 0.0;
  for (const Eigen::Vector3d& p : wire) worst = std::max(worst, distance_mm(reference, p));
  return worst;
}

void compare(const Kind& kind, const std::vector<Step>& run, const std::vector<Step>& reference) {
  std::vector<double> shape_mm;
  std::vector<double> push;
  double rods = 0.0;
  for (std::size_t from = 0; from < run.size(); from += kWindow) {
    double sum = 0.0;
    double expected = 0.0;
    for (std::size_t i = from; i < std::min(run.size(), from + kWindow); ++i) {
      rods += run[i].rods;
      if (!run[i].calm || !reference[i].calm) continue;
      sum += run[i].push_n;
      expected += reference[i].push_n;
      if (i % 5 == 0) shape_mm.push_back(beside_mm(run[i].joints_mm, reference[i].joints_mm));
    }
    if (std::abs(expected) > 0.0) push.push_back(100.0 * std::abs(sum / expected - 1.0));
  }
  fmt::print("{:<34}{:>10.1f}{:>12.3f}{:>12.3f}{:>12.1f}{:>12.1f}\n", kind.name,
             rods / static_cast<double>(run.size()), io::percentile(shape_mm, 0.5),
             io::percentile(shape_mm, 0.9), io::percentile(push, 0.5), io::percentile(push, 0.9));
}

Kind uniform(double length_mm) {
  Kind kind{fmt::format("uniform, {} mm", length_mm), {}};
  kind.spec.adaptive = false;
  kind.spec.rod_length_mm = length_mm;
  return kind;
}

Kind adaptive(double tolerance_mm) {
  Kind kind{fmt::format("adaptive, shape_tolerance {} mm", tolerance_mm), {}};
  kind.spec.shape_tolerance_mm = tolerance_mm;
  return kind;
}

void bench(const fs::path& path) {
  const io::SceneFile scene = io::read_scene_file(path, {fs::path(ENDOWIRE_SOURCE_DIR) / "instruments"});
  const io::VesselMesh vessel = io::vessel_of(scene);
  const io::PreparedField prepared = io::prepare_field(vessel, {});
  const sim::Access access = io::access_of(scene, vessel, *io::prepare_centrelines(vessel, {}));
  const std::vector<Step> reference = play(scene, prepared, access, uniform(0.5).spec);
  fmt::print("{}, against uniform rods of 0.5 mm, steps within {} of a snap left out\n",
             path.filename().string(), kUnsettled);
  fmt::print("{:<34}{:>10}{:>24}{:>24}\n", "", "", "beside it [mm]", "mean push [%]");
  fmt::print("{:<34}{:>10}{:>12}{:>12}{:>12}{:>12}\n", "rods", "mean", "p50", "p90", "p50", "p90");
  for (const Kind& kind : {uniform(1.0), uniform(2.0), uniform(4.0), uniform(8.0), adaptive(0.01),
                           adaptive(0.02), adaptive(0.05), adaptive(0.1)})
    compare(kind, play(scene, prepared, access, kind.spec), reference);
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path root = ENDOWIRE_SOURCE_DIR;
  if (argc > 2) {
    fmt::print(stderr, "usage: bench_resolution [SCENE.toml]\n");
    return 2;
  }
  try {
    bench(argc == 2 ? fs::path(argv[1]) : root / "scenes/generated_left_carotid.toml");
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

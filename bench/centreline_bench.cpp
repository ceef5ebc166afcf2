// Centrelines: how long they take to find, and what a question costs. Real vessels are read from ../shared when it
// is there, else a bent tube stands for them.
#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <numbers>
#include <string>

#include "endowire/vessel/centreline.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/shared_vessels.hpp"
#include "support/swept_meshes.hpp"

namespace {

using namespace endowire;
using Eigen::Vector3d;
using vessel::CentrelineTree;
using vessel::RepairedMesh;
using vessel::TriangleMesh;

/// Every triangle cut into four: the same surface, more to read.
TriangleMesh finer(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d a = mesh.corner(t, 0);
    const Vector3d b = mesh.corner(t, 1);
    const Vector3d c = mesh.corner(t, 2);
    const std::array<Vector3d, 12> corners{a, 0.5 * (a + b), 0.5 * (a + c), 0.5 * (a + b),
                                           b, 0.5 * (b + c), 0.5 * (a + c), 0.5 * (b + c),
                                           c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (a + c)};
    for (std::size_t k = 0; k < 12; k += 3) {
      const auto first = static_cast<std::int32_t>(out.vertices_mm.size());
      for (std::size_t i = 0; i < 3; ++i) out.vertices_mm.push_back(corners[k + i]);
      out.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return out;
}

/// A real vessel, else a bent tube; cut `times` times.
const RepairedMesh& mesh_of(const char* name, int times) {
  static std::map<std::pair<std::string, int>, RepairedMesh> meshes;
  const auto [at, fresh] = meshes.try_emplace({name, times});
  if (!fresh) return at->second;
  const std::string path = test::shared_vessel_path(name);
  const std::vector<std::byte> bytes = test::read_bytes(path);
  TriangleMesh mesh;
  if (bytes.empty()) {
    const std::vector<Vector3d> curve = test::bent_curve(200.0, 30.0, std::numbers::pi, 2.0);
    mesh = test::swept_tube(curve, std::vector<double>(curve.size(), 4.0), 24, true);
  } else {
    mesh = vessel::parse_stl(bytes, path);
  }
  for (int k = 0; k < times; ++k) mesh = finer(mesh);
  return at->second = vessel::repair(mesh, path);
}

void extract(benchmark::State& state, const char* name, int times) {
  const RepairedMesh& mesh = mesh_of(name, times);
  std::size_t branches = 0;
  for (auto _ : state) branches = vessel::extract_centrelines(mesh).branches().size();
  state.counters["triangles"] = static_cast<double>(mesh.mesh.triangles.size());
  state.counters["branches"] = static_cast<double>(branches);
}
BENCHMARK_CAPTURE(extract, femoral_to_neuro, "femoral_to_neuro", 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extract, femoral_to_neuro_fine, "femoral_to_neuro_fine", 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extract, femoral_to_neuro_fine_cut, "femoral_to_neuro_fine", 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extract, branching_phantom, "branching_phantom", 0)->Unit(benchmark::kMillisecond);

struct Questions {
  CentrelineTree tree;
  std::vector<Vector3d> points;
  std::vector<vessel::CentrelinePlace> places;
};

/// Points within half a radius of the centrelines of the femoral tree.
const Questions& questions() {
  static const Questions made = [] {
    Questions q{vessel::extract_centrelines(mesh_of("femoral_to_neuro", 0)), {}, {}};
    vessel::SplitMix random(1);
    for (int n = 0; n < 4096; ++n) {
      const vessel::CentrelinePoint& p = q.tree.points()[random.next() % q.tree.points().size()];
      const Vector3d off(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      q.points.emplace_back(p.position_mm + 0.5 * p.radius_mm * off);
      q.places.push_back(q.tree.nearest(q.points.back()).place);
    }
    return q;
  }();
  return made;
}

template <typename Ask>
void ask(benchmark::State& state, Ask question) {
  const Questions& q = questions();
  std::size_t n = 0;
  for (auto _ : state) {
    n = (n + 1) % (q.points.size() - 1);
    benchmark::DoNotOptimize(question(q, n));
  }
}

void nearest(benchmark::State& state) {
  ask(state, [](const Questions& q, std::size_t n) { return q.tree.nearest(q.points[n]).offset_mm; });
}
BENCHMARK(nearest);
void nearest_with_hint(benchmark::State& state) {
  ask(state,
      [](const Questions& q, std::size_t n) { return q.tree.nearest(q.points[n], q.places[n]).offset_mm; });
}
BENCHMARK(nearest_with_hint);
void state_at(benchmark::State& state) {
  ask(state, [](const Questions& q, std::size_t n) { return q.tree.state_at(q.places[n]).radius_mm; });
}
BENCHMARK(state_at);
void next_turn(benchmark::State& state) {
  ask(state, [](const Questions& q, std::size_t n) {
    return q.tree.next_turn(q.places[n], q.places[n + 1]).distance_mm;
  });
}
BENCHMARK(next_turn);
void ahead_20_mm(benchmark::State& state) {
  ask(state, [](const Questions& q, std::size_t n) {
    return q.tree.ahead(q.places[n], q.places[n + 1], 20.0).min_radius_mm;
  });
}
BENCHMARK(ahead_20_mm);

}  // namespace

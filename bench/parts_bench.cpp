// Time of the parts of a step, each alone, and beside the limits that they are to keep. Arguments are numbers of rods; complexity should
// be linear.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "endowire/contact/contact_set.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/chain.hpp"
#include "endowire/sim/self_overlap.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/repair.hpp"
#include "limits.hpp"
#include "support/chain_states.hpp"
#include "support/frames.hpp"
#include "support/generated_meshes.hpp"
#include "support/wires.hpp"

namespace {

using namespace endowire;

constexpr double rod_length_mm = 4.0;
constexpr double tube_radius_mm = 3.0;
constexpr double wire_offset_mm =
    2.5;  // from the axis of the tube: the wire of 0.4445 mm almost touches the wall

/// A gently bent and twisted wire with its derivatives; the same numbers in every run.
struct BentChain {
  explicit BentChain(int rods) {
    test::Random random(1);
    const std::vector<double> arcs = test::even_arcs(rods, rod_length_mm);
    shape = test::random_chain(arcs, 0.02, 0.02, 0.0, random);
    const rod::MaterialLine line(test::hydrophilic_035_angled());
    rod::fill_material(line, arcs, 9.81, 1.06e-3, material);
    const int unknowns = 4 * (rods + 1);
    hessian.resize(unknowns);
    gradient.assign(static_cast<std::size_t>(unknowns), 0.0);
    direction = test::random_direction(gradient.size(), random);
  }

  void differentiate() {
    hessian.set_zero();
    std::fill(gradient.begin(), gradient.end(), 0.0);
    benchmark::DoNotOptimize(rod::add_joint_derivatives(material, shape, hessian, gradient));
  }

  rod::ChainShape shape;
  rod::ChainMaterial material;
  math::BandMatrix hessian;
  std::vector<double> gradient;
  std::vector<double> direction;
};

int rods_of(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

void joint_derivatives(benchmark::State& state) {
  BentChain chain(rods_of(state));
  for (auto _ : state) {
    chain.differentiate();
    benchmark::ClobberMemory();
  }
  state.SetComplexityN(state.range(0));
}

void band_factorise(benchmark::State& state) {
  BentChain chain(rods_of(state));
  chain.differentiate();
  math::BandMatrix matrix;
  for (auto _ : state) {  // the copy is part of every factorisation: the factors take the matrix's place
    matrix = chain.hessian;
    if (matrix.factorise(1e3) != 0) state.SkipWithError("the matrix is not positive definite");
  }
  state.SetComplexityN(state.range(0));
}

void band_solve(benchmark::State& state) {
  BentChain chain(rods_of(state));
  chain.differentiate();
  if (chain.hessian.factorise(1e3) != 0) state.SkipWithError("the matrix is not positive definite");
  std::vector<double> x = chain.direction;
  for (auto _ : state) {
    x = chain.direction;
    chain.hessian.solve(x);
    benchmark::ClobberMemory();
  }
  state.SetComplexityN(state.range(0));
}

void band_factorise_and_solve(benchmark::State& state) {
  BentChain chain(rods_of(state));
  chain.differentiate();
  math::BandMatrix matrix;
  std::vector<double> x = chain.direction;
  for (auto _ : state) {
    matrix = chain.hessian;
    if (matrix.factorise(1e3) != 0) state.SkipWithError("the matrix is not positive definite");
    x = chain.direction;
    matrix.solve(x);
    benchmark::ClobberMemory();
  }
  state.SetComplexityN(state.range(0));
}

/// Positions and frames of a trial state.
void kinematics(benchmark::State& state) {
  BentChain chain(rods_of(state));
  rod::ChainShape out = chain.shape;
  bool done = true;
  for (auto _ : state) {
    done = rod::retract(chain.shape, chain.direction, 1e-3, {false, false, false}, out) && done;
    benchmark::ClobberMemory();
  }
  if (!done) state.SkipWithError("the step is too long to retract");
  state.SetComplexityN(state.range(0));
}

vessel::TubeField analytic_tube() {
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), tube_radius_mm};
}

/// The same tube as a prepared mesh, long enough for 100 rods.
const vessel::MeshField& mesh_tube() {
  static const vessel::MeshField field = vessel::MeshField::build(
      vessel::repair(test::closed_tube(tube_radius_mm, 100.0 * rod_length_mm + 40.0, 32, 110), "tube"));
  return field;
}

void lookup(benchmark::State& state, const vessel::Field& field) {
  test::Random random(2);
  std::vector<Eigen::Vector3d> points(4096);
  for (Eigen::Vector3d& p : points)
    p = {random.uniform(-1.7, 1.7), random.uniform(-1.7, 1.7), random.uniform(20.0, 400.0)};
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(field.at(points[k]));
    k = (k + 1) % points.size();
  }
}

void analytic_lookup(benchmark::State& state) {
  lookup(state, analytic_tube());
}

void mesh_lookup(benchmark::State& state) {
  lookup(state, mesh_tube());
}

/// Detection for a straight wire along the wall of a tube.
void detect(benchmark::State& state, const vessel::Field& field) {
  const std::vector<double> arcs = test::even_arcs(rods_of(state), rod_length_mm);
  const rod::ChainShape shape =
      test::straight_chain(arcs, Eigen::Vector3d(wire_offset_mm, 0.0, 20.0), Eigen::Vector3d::UnitZ());
  const rod::MaterialLine line(test::hydrophilic_035_angled());
  rod::ChainMaterial material;
  rod::fill_material(line, arcs, 9.81, 1.06e-3, material);
  const contact::ContactSpec spec;
  contact::ContactSet contact;
  const contact::Wire wire{line, material, shape};
  contact.begin(wire, {});
  contact.place(wire, rods_of(state) - 1, field, spec);
  for (auto _ : state) {
    contact.detect(wire, field, spec);
    benchmark::ClobberMemory();
  }
  const auto samples = static_cast<double>(contact.samples().size());
  state.counters["samples"] = samples;
  state.counters["s_per_sample"] = benchmark::Counter(
      samples, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void detect_in_analytic_tube(benchmark::State& state) {
  detect(state, analytic_tube());
}

void detect_in_mesh_tube(benchmark::State& state) {
  detect(state, mesh_tube());
}

/// A wire of 1 mm rods that winds through a body and lies clear of itself.
void self_overlap(benchmark::State& state) {
  std::vector<sim::SnapshotPoint> points(static_cast<std::size_t>(rods_of(state)) + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = static_cast<double>(i);
    points[i].position_mm = {0.8 * s, 40.0 * std::sin(0.015 * s), 40.0 * std::cos(0.01 * s)};
    points[i].arc_mm = s;
    points[i].radius_mm = 0.4445;
  }
  sim::SelfOverlap overlap;
  for (auto _ : state) benchmark::DoNotOptimize(overlap.nearest(points));
  state.SetComplexityN(state.range(0));
}

BENCHMARK(self_overlap)->Arg(100)->Arg(300)->Arg(1000)->Arg(2600)->Complexity(benchmark::oN);
BENCHMARK(joint_derivatives)->Arg(100)->Arg(300)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK(band_factorise)->Arg(100)->Arg(300)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK(band_solve)->Arg(100)->Arg(300)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK(band_factorise_and_solve)->Arg(100)->Arg(300)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK(kinematics)->Arg(100)->Arg(300)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK(analytic_lookup);
BENCHMARK(mesh_lookup);
BENCHMARK(detect_in_analytic_tube)->Arg(100)->Arg(300)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK(detect_in_mesh_tube)->Arg(100)->Unit(benchmark::kMicrosecond);

/// Prints as Google Benchmark does, and at the end what the parts took beside their limits.
class Reporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration)
        us_.emplace_back(run.benchmark_name(),
                         1e6 * run.cpu_accumulated_time / static_cast<double>(run.iterations));
    }
    ConsoleReporter::ReportRuns(runs);
  }
  void Finalize() override {
    std::printf("\n%-28s%8s%12s%12s%8s\n", "part", "joints", "took [us]", "limit [us]", "ratio");
    for (const bench::Limit& limit : bench::limits)
      print(std::string(limit.part) + "/" + std::to_string(limit.joints), std::string(limit.part),
            limit.joints, limit.us);
    print("mesh_lookup", "mesh_lookup", 0, bench::lookup_us);
  }

 private:
  void print(const std::string& name, const std::string& part, int joints, double limit_us) const {
    for (const auto& [run, us] : us_)
      if (run == name)
        std::printf("%-28s%8d%12.3f%12.3f%8.2f\n", part.c_str(), joints, us, limit_us, us / limit_us);
  }
  std::vector<std::pair<std::string, double>> us_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}

// bench_long_wire: 260 cm of wire in a coiled vessel. How the time of a step grows with the rods.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "support/swept_meshes.hpp"
#include "support/wires.hpp"

namespace {

using namespace endowire;
using Clock = std::chrono::steady_clock;

constexpr double kLength_mm = 2600.0;
constexpr double kCoil_mm = 80.0;
constexpr double kPitch_mm = 24.0;
constexpr double kRadius_mm = 4.0;
constexpr double kWindow_mm = 100.0;

/// A coil that climbs: six turns, never back to where it was.
std::vector<Eigen::Vector3d> coil() {
  const double climb = kPitch_mm / (2.0 * std::numbers::pi);
  const double per_rad = std::hypot(kCoil_mm, climb);
  std::vector<Eigen::Vector3d> axis;
  for (double s = -20.0; s < kLength_mm + 60.0; s += 1.25) {
    const double angle = s / per_rad;
    axis.emplace_back(kCoil_mm * std::cos(angle), kCoil_mm * std::sin(angle), climb * angle);
  }
  return axis;
}

rod::Instrument long_wire() {
  rod::Instrument wire = test::hydrophilic_035_angled();
  wire.sections.back().length_mm += kLength_mm + 20.0 - 1800.0;
  return wire;
}

struct Row {
  double rods = 0.0;
  double median_us = 0.0;
};

/// Median step of every window of insertion.
std::vector<Row> push_all(const std::shared_ptr<const vessel::Field>& field, const sim::Access& access,
                          bool adaptive) {
  sim::SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  spec.solver.rods.adaptive = adaptive;
  sim::Simulation simulation(field, long_wire(), access, spec);
  std::vector<Row> rows;
  std::vector<double> us;
  double rods = 0.0;
  int failed = 0;
  double inserted_mm = 0.0;
  for (double start_mm = 0.0; inserted_mm < kLength_mm && failed == 0;) {
    const Clock::time_point before = Clock::now();
    const sim::StepReport& report = simulation.step({1.0, 0.0});
    us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
    rods += report.rods;
    failed += report.converged ? 0 : 1;
    if (report.inserted_length_mm - inserted_mm < 0.01) break;  // locked: the hand slips
    inserted_mm = report.inserted_length_mm;
    if (inserted_mm - start_mm < kWindow_mm) continue;
    const auto middle = us.begin() + static_cast<std::ptrdiff_t>(us.size() / 2);
    std::nth_element(us.begin(), middle, us.end());
    rows.push_back({rods / static_cast<double>(us.size()), *middle});
    start_mm = inserted_mm;
    us.clear();
    rods = 0.0;
  }
  std::printf("%s rods: %.0f mm in, %s\n", adaptive ? "adaptive" : "uniform", inserted_mm,
              failed > 0                       ? "a step did not converge"
              : inserted_mm < kLength_mm - 1.0 ? "then the hand slipped"
                                               : "all steps converged");
  return rows;
}

/// Slope of log time over log rods, from 150 rods on: the first turn of the coil lies free at first, and a rod that touches nothing costs less.
double exponent(const std::vector<Row>& rows) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Row& row : rows) {
    if (row.rods < 150.0) continue;
    const double a = std::log(row.rods);
    const double b = std::log(row.median_us);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

int main() {
  const std::vector<Eigen::Vector3d> axis = coil();
  const std::vector<double> radii(axis.size(), kRadius_mm);
  const auto field = std::make_shared<const vessel::MeshField>(
      vessel::MeshField::build(vessel::repair(test::swept_tube(axis, radii, 24, true), "coil")));
  const sim::Access access{axis[16], (axis[17] - axis[15]).normalized()};
  for (const bool adaptive : {false, true}) {
    const std::vector<Row> rows = push_all(field, access, adaptive);
    std::printf("%10s %12s %14s\n", "rods", "median [us]", "per rod [us]");
    for (std::size_t i = 0; i < rows.size(); i += 3)
      std::printf("%10.1f %12.0f %14.2f\n", rows[i].rods, rows[i].median_us,
                  rows[i].median_us / rows[i].rods);
    std::printf("from 150 rods on time goes with rods to the power %.2f\n\n", exponent(rows));
  }
  return 0;
}

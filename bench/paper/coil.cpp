#include "coil.hpp"

#include <cmath>
#include <numbers>

#include "cpu_clock.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "support/swept_meshes.hpp"
#include "support/wires.hpp"

namespace endowire::paper {

namespace {

constexpr double kTurn_mm = 80.0;  // radius
constexpr double kPitch_mm = 24.0;
constexpr double kLumenRadius_mm = 4.0;
constexpr double kWindow_mm = 100.0;
constexpr double kLeastRods = 150.0;

}  // namespace

rod::Instrument long_wire() {
  rod::Instrument wire = test::hydrophilic_035_angled();
  wire.sections.back().length_mm += kLongWire_mm + 20.0 - 1800.0;
  return wire;
}

Coil coil() {
  constexpr double climb = kPitch_mm / (2.0 * std::numbers::pi);
  const double per_rad = std::hypot(kTurn_mm, climb);
  std::vector<Eigen::Vector3d> axis;
  for (double s = -20.0; s < kLongWire_mm + 60.0; s += 1.25) {
    const double angle = s / per_rad;
    axis.emplace_back(kTurn_mm * std::cos(angle), kTurn_mm * std::sin(angle), climb * angle);
  }
  const std::vector<double> radii(axis.size(), kLumenRadius_mm);
  return {std::make_shared<const vessel::MeshField>(
              vessel::MeshField::build(vessel::repair(test::swept_tube(axis, radii, 24, true), "coil"))),
          {axis[16], (axis[17] - axis[15]).normalized()}};
}

LongWireRun push_long_wire(const Coil& coil, const sim::ResolutionSpec& rods) {
  sim::SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  spec.solver.rods = rods;
  sim::Simulation simulation(coil.field, long_wire(), coil.access, spec);
  LongWireRun run;
  std::vector<double> us;
  LongWireRow sum;
  double window_from_mm = 0.0;
  while (run.inserted_mm < kLongWire_mm && run.converged == run.steps) {
    const double before_us = cpu_us();
    const sim::StepReport& report = simulation.step({1.0, 0.0});
    us.push_back(cpu_us() - before_us);
    sum.rods += report.rods;
    sum.samples += report.contact_samples;
    sum.iterations += report.newton_iterations;
    sum.factorisations += report.solve.factorisations;
    ++run.steps;
    run.converged += report.converged ? 1 : 0;
    if (report.inserted_length_mm - run.inserted_mm < 0.01) break;  // locked: the hand slips
    run.inserted_mm = report.inserted_length_mm;
    if (run.inserted_mm - window_from_mm < kWindow_mm) continue;
    const double n = static_cast<double>(us.size());
    run.rows.push_back({run.inserted_mm, sum.rods / n, io::percentile(us, 0.5), sum.samples / n,
                        sum.iterations / n, sum.factorisations / n});
    window_from_mm = run.inserted_mm;
    us.clear();
    sum = {};
  }
  return run;
}

double exponent(const std::vector<LongWireRow>& rows) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const LongWireRow& row : rows) {
    if (row.rods < kLeastRods) continue;
    const double a = std::log(row.rods);
    const double b = std::log(row.median_us);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace endowire::paper

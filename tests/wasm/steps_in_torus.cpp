// Pushes and turns a wire with a curved tip in a vessel bent to a ring, and prints where the tip is after
// every step.
//
//   steps_in_torus              prints
//   steps_in_torus FILE         compares with what another build printed into FILE; exit 1 when they differ
//
// Built by the native compiler and by Emscripten: the layers below io give the same answer in both. They may
// differ by what the two maths libraries differ in the last bits of sin, cos and atan2.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "endowire/sim/simulation.hpp"

namespace {

using Eigen::Vector3d;
using namespace endowire;

constexpr double tolerance_mm = 1e-9;
constexpr int steps = 20;

/// φ = r − d, d the distance to a circle of radius R in the plane z = 0.
class Torus : public vessel::Field {
 public:
  [[nodiscard]] vessel::WallDistance at(const Vector3d& p) const override {
    const double rho = std::hypot(p.x(), p.y());
    const double d = std::hypot(rho - bend_radius_mm, p.z());
    if (d < 1e-12 || rho < 1e-12) return {lumen_mm - d, Vector3d::UnitZ()};
    const Vector3d outward((rho - bend_radius_mm) / d * p.x() / rho, (rho - bend_radius_mm) / d * p.y() / rho,
                           p.z() / d);
    return {lumen_mm - d, -outward};
  }
  [[nodiscard]] double lumen_radius_mm(const Vector3d& /*point_mm*/) const override { return lumen_mm; }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Vector3d& /*point_mm*/) const override {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] int exit_at(const Vector3d& /*point_mm*/) const override { return 0; }
  [[nodiscard]] double error_mm() const override { return 0.0; }

  static constexpr double bend_radius_mm = 40.0;
  static constexpr double lumen_mm = 3.0;
};

rod::Instrument wire() {
  rod::Section tip;
  tip.length_mm = 10.0;
  tip.flexural_rigidity_n_mm2 = {6.0, 6.0};
  tip.torsional_rigidity_n_mm2 = {4.6, 4.6};
  tip.axial_rigidity_n = {1900.0, 1900.0};
  tip.radius_mm = {0.4445, 0.4445};
  tip.linear_density_g_per_mm = 1.4e-3;
  tip.friction = 0.05;
  tip.rest_curvature_per_mm = 0.05;
  tip.kink_curvature_per_mm = 0.7;
  rod::Section shaft = tip;
  shaft.length_mm = 290.0;
  shaft.flexural_rigidity_n_mm2 = {6.0, 60.0};
  shaft.torsional_rigidity_n_mm2 = {4.6, 46.0};
  shaft.rest_curvature_per_mm = 0.0;
  rod::Instrument instrument;
  instrument.model = "wire";
  instrument.sections = {tip, shaft};
  return instrument;
}

std::vector<Vector3d> tips() {
  sim::Simulation simulation(std::make_shared<Torus>(), wire(),
                             {Vector3d(Torus::bend_radius_mm, 0.0, 0.0), Vector3d::UnitY()}, {});
  std::vector<Vector3d> result;
  for (int i = 0; i < steps; ++i) {
    const sim::StepReport& report = simulation.step({1.0, 0.05});
    if (!report.converged) std::fprintf(stderr, "step %d did not converge\n", i);
    result.push_back(simulation.state().joints_mm.front());
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Vector3d> here = tips();
  if (argc < 2) {
    for (const Vector3d& tip : here) std::printf("%.17g %.17g %.17g\n", tip.x(), tip.y(), tip.z());
    return 0;
  }
  std::ifstream file(argv[1]);
  double largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    Vector3d there;
    if (!(file >> there.x() >> there.y() >> there.z())) {
      std::fprintf(stderr, "%s: holds %d of %d steps\n", argv[1], i, steps);
      return 1;
    }
    largest = std::fmax(largest, (there - here[static_cast<std::size_t>(i)]).norm());
  }
  std::printf("largest difference of the tip %.3g mm, allowed %.3g mm\n", largest, tolerance_mm);
  return largest <= tolerance_mm ? 0 : 1;
}

// V13  Three-point bend: F = 48 EI d/span³, the bench test by which the moduli of real wires were measured.
//
// Flexural moduli of 0.035" wires [Harrison2011], EI for a solid section. The shaft of each wire of the library that was measured is bent in
// the simulator as on the bench: two supports, one of which slides, a small dead load at the middle; its modulus comes back out of load and
// deflection.
#include <cmath>
#include <numbers>
#include <string>

#include "cases.hpp"
#include "endowire/io/instrument_file.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

Checks three_point_bend(int rods) {
  constexpr double kSpan_mm = 100.0;
  constexpr double kDiameter_mm = 0.889;
  constexpr double kGpa = 1e3;
  constexpr double kDeflection = 3e-4;  // of the span: the closed form is linear, at 1e-3 it errs by 4e-6
  const double inertia_mm4 = std::numbers::pi * std::pow(kDiameter_mm, 4) / 64.0;
  struct Wire {
    const char* model;
    double modulus_gpa;  ///< as measured; the heavy-duty wires were 11.4 to 14.5
  };
  Checks checks;
  for (const Wire& wire :
       {Wire{"stiff_035_010gpa", 9.5}, Wire{"stiff_035_013gpa", 13.0}, Wire{"stiff_035_017gpa", 17.0},
        Wire{"stiff_035_029gpa", 29.2}, Wire{"stiff_035_060gpa", 60.3}, Wire{"stiff_035_065gpa", 65.4},
        Wire{"stiff_035_140gpa", 139.6}, Wire{"stiff_035_158gpa", 158.4}}) {
    const double rigidity_n_mm2 = wire.modulus_gpa * kGpa * inertia_mm4;
    const double load_n = 48.0 * rigidity_n_mm2 * kDeflection / (kSpan_mm * kSpan_mm);
    rod::Instrument shaft =
        io::read_instrument_file(std::string(ENDOWIRE_SOURCE_DIR "/instruments/") + wire.model + ".toml")
            .instrument;
    shaft.sections = {shaft.sections.back()};
    Chain chain(shaft, rods, kSpan_mm / rods);
    chain.problem.hold_joint(0, false, true, true);
    chain.keep_plane();
    const auto middle = static_cast<std::size_t>(rods / 2);
    chain.problem.material.weight_n[middle] = load_n;
    chain.problem.loads.gravity_direction = -Eigen::Vector3d::UnitY();
    solve::Newton newton;
    const double failed = nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
    const double deflection_mm = -chain.problem.shape.joints_mm[middle].y();
    const double measured_gpa = load_n * std::pow(kSpan_mm, 3) / (48.0 * deflection_mm * inertia_mm4) / kGpa;
    checks.push_back({"V13", std::string("modulus of ") + wire.model + " [GPa]", "F span³/48 d I",
                      wire.modulus_gpa, measured_gpa + failed, 1e-3, ErrorKind::relative, "Harrison2011"});
  }
  return checks;
}

Figure three_point_bend_figure() {
  Figure figure{"v13",
                "V13  Moduli of real wires by three-point bending",
                "measured on the bench [GPa]",
                "measured in the simulator [GPa]",
                {}};
  Series ours{Mark::rings, {}, ""};
  for (const Check& wire : three_point_bend(kRods)) ours.points.push_back({wire.reference, wire.ours});
  constexpr double kMost_gpa = 170.0;
  figure.series = {{Mark::line, {{0.0, 0.0}, {kMost_gpa, kMost_gpa}}, ""}, ours};
  return figure;
}

}  // namespace endowire::test

// V12  A pre-curved tip (κ0, length L from the clamp) held by a wall at offset c, small angle:
//
//   F = 3 EI (κ0 L²/2 − c)/L³
//
// by superposition of the free shape y = κ0 x²/2 and of a cantilever's F L³/3EI. The wall is a plane, stiff enough to hold still, met by
// the contact samples along the whole wire; c counts from the axis of the wire at the tip.
#include "cases.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "support/chains.hpp"

namespace endowire::test {

Checks curved_tip_at_a_wall() {
  constexpr int kTipRods = 50;
  constexpr double kLength_mm = 30.0;
  constexpr double kRigidity_n_mm2 = 10.0;
  constexpr double kCurvature_per_mm = 0.002;  // free deflection 0.9 mm, slope 3.4°
  constexpr double kStiff_mpa = 1000.0;
  Checks checks;
  for (const double offset_mm : {0.0, 0.3, 0.6}) {
    rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm);
    wire.sections[0].rest_curvature_per_mm = kCurvature_per_mm;
    Chain chain(wire, kTipRods, kLength_mm / (kTipRods - 0.5));
    chain.problem.clamp_hand_end();
    const double radius_mm = wire.sections[0].radius_mm.at_tip_side;
    const vessel::HalfSpaceField wall({0.0, offset_mm + radius_mm, 0.0}, -Eigen::Vector3d::UnitY(), 3.0);
    contact::ContactSpec spec;
    spec.wall.modulus_mpa = kStiff_mpa;
    sim::ChainProblem& problem = chain.problem;
    const contact::Wire seen{chain.line, problem.material, problem.shape};
    problem.contact.begin(seen, {});
    problem.contact.place(seen, kTipRods - 1, wall, spec);
    problem.contact.detect(seen, wall, spec);
    solve::Newton newton;
    const double failed = nan_unless_converged(newton.minimise(problem, statics_spec()));
    double force_n = failed;
    for (std::size_t i = 0; i < problem.contact.samples().size(); ++i) {
      force_n -= problem.contact.normal_force_n(problem.shape, i).y();
    }
    const double exact_n = 3.0 * kRigidity_n_mm2 *
                           (0.5 * kCurvature_per_mm * kLength_mm * kLength_mm - offset_mm) /
                           (kLength_mm * kLength_mm * kLength_mm);
    checks.push_back({"V12", "wall force, wall at c = " + std::to_string(offset_mm).substr(0, 3) + " mm [mN]",
                      "3EI(κ0L²/2 − c)/L³", 1e3 * exact_n, 1e3 * force_n, 1e-2, ErrorKind::relative,
                      "superposition of cantilevers"});
  }
  return checks;
}

}  // namespace endowire::test

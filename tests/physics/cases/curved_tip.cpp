// V12  A pre-curved tip (κ0, length L from the clamp) held by a wall at offset c, small angle:
//
//   F = 3 EI (κ0 L²/2 − c)/L³
//
// by superposition of the free shape y = κ0 x²/2 and of a cantilever's F L³/3EI. The wall is a plane, stiff enough to hold still, met by
// the contact samples along the whole wire; c counts from the axis of the wire at the tip.
#include <string>

#include "cases.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 30.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kCurvature_per_mm = 0.002;  // free deflection 0.9 mm, slope 3.4°

/// Force of the wall on the wire.
double wall_force_n(double offset_mm) {
  constexpr int kTipRods = 50;
  constexpr double kStiff_mpa = 1000.0;
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
  double force_n = nan_unless_converged(newton.minimise(problem, statics_spec()));
  for (std::size_t i = 0; i < problem.contact.samples().size(); ++i)
    force_n -= problem.contact.normal_force_n(problem.shape, i).y();
  return force_n;
}

double beam_force_n(double offset_mm) {
  return 3.0 * kRigidity_n_mm2 * (0.5 * kCurvature_per_mm * kLength_mm * kLength_mm - offset_mm) /
         (kLength_mm * kLength_mm * kLength_mm);
}

}  // namespace

Checks curved_tip_at_a_wall() {
  Checks checks;
  for (const double offset_mm : {0.0, 0.3, 0.6}) {
    checks.push_back({"V12", "wall force, wall at c = " + std::to_string(offset_mm).substr(0, 3) + " mm [mN]",
                      "3EI(κ0L²/2 − c)/L³", 1e3 * beam_force_n(offset_mm), 1e3 * wall_force_n(offset_mm),
                      1e-2, ErrorKind::relative, "superposition of cantilevers"});
  }
  return checks;
}

Figure curved_tip_figure() {
  Figure figure{
      "v12", "V12  Force of a pre-curved tip on a wall", "offset of the wall c [mm]", "wall force [mN]", {}};
  constexpr double kFree_mm = 0.5 * kCurvature_per_mm * kLength_mm * kLength_mm;
  Series ours{Mark::rings, {}, ""};
  constexpr double kStep_mm = 0.1;
  for (double offset_mm = 0.0; offset_mm < kFree_mm - 0.05; offset_mm += kStep_mm)
    ours.points.push_back({offset_mm, 1e3 * wall_force_n(offset_mm)});
  figure.series = {{Mark::line, {{0.0, 1e3 * beam_force_n(0.0)}, {kFree_mm, 0.0}}, ""}, ours};
  return figure;
}

}  // namespace endowire::test

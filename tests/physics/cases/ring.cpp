// V6  Michell's ring: a straight wire closed to a ring leaves its plane at the total twist
//
//   Φ = 2π √3 EI/GJ                                                                          [Michell1889]
//
// An open chain whose first and last rods lie on each other and are held there. A ring's own modes and those of this chain are the same
// but for rigid motions: what turns or shifts the ring at the joined ends is undone by turning and shifting all of it. Twisted evenly,
// the regular polygon is in equilibrium by its symmetry, at any Φ; how stable it is the inertia of the factorisation tells. A round wire
// may swing about the tangent at its joined ends, each section rolling back, at no cost: a joint across is kept in the plane.
#include <cmath>
#include <limits>
#include <numbers>

#include "cases.hpp"
#include "figures.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kDegree = std::numbers::pi / 180.0;

/// A ring of a number of rods, twisted evenly: how many of its modes are unstable.
int unstable_modes(int rods, double twist_rad) {
  const double turn = 2.0 * std::numbers::pi / rods;
  Chain ring(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods + 1, kLength_mm / rods);
  std::vector<Eigen::Vector3d> joints(static_cast<std::size_t>(rods + 2), Eigen::Vector3d::Zero());
  for (int i = rods; i >= 0; --i) {
    const double angle = (rods - i) * turn;
    joints[static_cast<std::size_t>(i)] =
        joints[static_cast<std::size_t>(i + 1)] +
        ring.rod_length_mm * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  }
  ring.lay_untwisted(joints);
  for (int i = 0; i < rods; ++i) ring.spin(i, twist_rad * (rods - i) / rods);
  ring.problem.clamp_hand_end();
  ring.problem.hold_joint(0, true, true, true);
  ring.problem.hold_joint(1, true, true, true);
  ring.problem.hold_spin(0);
  ring.problem.hold_joint(rods / 2, false, false, true);
  solve::Newton newton;
  return newton.inertia(ring.problem);
}

}  // namespace

Checks michell_ring(int rods) {
  const rod::Section section = uniform_section(kRigidity_n_mm2, kLength_mm);
  const double exact = michell_twist_rad(kRigidity_n_mm2 / section.torsional_rigidity_n_mm2.at_tip_side);
  double low = 0.9 * exact;
  double high = 1.1 * exact;
  // The mode of four nodes may lie anywhere along the ring: two become unstable at once.
  const bool bracketed = unstable_modes(rods, low) == 0 && unstable_modes(rods, high) == 2;
  constexpr int kHalvings = 30;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (unstable_modes(rods, middle) == 0 ? low : high) = middle;
  }
  return {{"V6", "critical twist by inertia count [°]", "2π√3 EI/GJ", exact / kDegree,
           bracketed ? 0.5 * (low + high) / kDegree : std::numeric_limits<double>::quiet_NaN(), 1e-3,
           ErrorKind::relative, "Michell1889"}};
}

Figure michell_ring_figure() {
  Figure figure{"v6",
                "V6  Modes in which a twisted ring is unstable, from Michell's on",
                "twist/(2π EI/GJ)",
                "unstable modes",
                {}};
  Series exact{Mark::line, {{0.0, 0.0}}, ""};
  constexpr int kLastMode = 4;
  for (int mode = 2; mode <= kLastMode; ++mode) {  // of 2, 3, … waves round the ring
    const double twist = std::sqrt(mode * mode - 1.0);
    exact.points.push_back({twist, 2.0 * (mode - 2)});
    exact.points.push_back({twist, 2.0 * (mode - 1)});
  }
  constexpr double kMost = 4.5;
  exact.points.push_back({kMost, exact.points.back().y});
  const double unit_rad =
      michell_twist_rad(kRigidity_n_mm2 /
                        uniform_section(kRigidity_n_mm2, kLength_mm).torsional_rigidity_n_mm2.at_tip_side) /
      std::numbers::sqrt3;
  Series ours{Mark::rings, {}, ""};
  constexpr double kStep = 0.2;
  for (double twist = 0.1; twist < kMost; twist += kStep)
    ours.points.push_back({twist, static_cast<double>(unstable_modes(kRods, twist * unit_rad))});
  figure.series = {exact, ours};
  return figure;
}

}  // namespace endowire::test

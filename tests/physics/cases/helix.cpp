// V9  A weightless wire in a straight cylinder, compressed, lies on the wall as a helix.
//
//   without friction   F = 8π² EI/p² [Lubinski1962],  wall force per length w = r F²/4EI                         [Mitchell1986]
//   with friction      dF/dx = μ w:  F = F₀/(1 − μ r F₀ x/4EI), locked up at x = 4EI/(μ r F₀)                 [Mitchell1986]
//
// Symbols  p pitch, r clearance between the axes of wire and cylinder, x from the tip [mm], F compression, F₀ at the tip [N]
// Domain   slopes 2πr/p ≪ 1; the tip is free to run round the wall, so that no torque goes through the helix.
//
// The wall is soft, and still deflects by less than 0.3 % of r: a joint that slides round a hard one leaves it at second order, and
// Newton would have to crawl.
#include "helix.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "cases.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kWire_mm = 2.0;  // radius
constexpr double kPi = std::numbers::pi;
constexpr double kWave_per_mm = 0.05;  // 2π/p of the helix under the force at the tip
constexpr double kTip_n = 2.0 * kRigidity_n_mm2 * kWave_per_mm * kWave_per_mm;

rod::Instrument wire_of(double length_mm, double friction) {
  rod::Instrument wire = uniform_wire(kRigidity_n_mm2, length_mm);
  wire.sections[0].radius_mm = {kWire_mm, kWire_mm};
  wire.sections[0].friction = friction;
  return wire;
}

/// A wire that lies on the wall of a cylinder along x, its hand end clamped there and its tip pushed back.
struct WoundWire {
  /// @param force_n      compression by distance from the tip, with which it is laid
  /// @param wave_per_mm  rate at which it is laid winding
  template <typename Force, typename Wave>
  WoundWire(int rods, double length_mm, double friction, double clearance_mm, double wall_mpa, Force force_n,
            Wave wave_per_mm)
      : chain(wire_of(1.2 * length_mm, friction), rods, length_mm / rods),
        tube(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), kWire_mm + clearance_mm) {
    std::vector<Eigen::Vector3d> joints(static_cast<std::size_t>(rods + 1));
    double angle = 0.0;
    for (int i = rods; i >= 0; --i) {
      const auto k = static_cast<std::size_t>(i);
      const double from_tip_mm = (i + 0.5) * chain.rod_length_mm;
      const bool clamped = i >= rods - 1;
      if (!clamped) angle += chain.rod_length_mm * wave_per_mm(from_tip_mm);
      joints[k] = clearance_mm * Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
      if (i == rods) continue;
      const double rod_mm =
          chain.rod_length_mm -
          (clamped ? 0.0 : force_n(from_tip_mm) / chain.problem.material.stretch_n_per_mm[k]);
      const Eigen::Vector3d aside = joints[k] - Eigen::Vector3d(0.0, joints[k + 1].y(), joints[k + 1].z());
      joints[k].x() = joints[k + 1].x() + std::sqrt(rod_mm * rod_mm - aside.squaredNorm());
    }
    chain.lay_untwisted(joints);
    chain.problem.clamp_hand_end();
    chain.problem.loads.tip_force_n.x() = -kTip_n;
    spec.wall.modulus_mpa = wall_mpa;
  }

  [[nodiscard]] contact::Wire seen() const {
    return {chain.line, chain.problem.material, chain.problem.shape};
  }
  /// The compression at a distance from the tip.
  [[nodiscard]] double compression_n(double from_tip_mm) const {
    return -rod::axial_force_n(chain.problem.material, chain.problem.shape,
                               static_cast<int>(from_tip_mm / chain.rod_length_mm));
  }

  Chain chain;
  vessel::TubeField tube;
  contact::ContactSpec spec;
};

}  // namespace

Helix helix_without_friction() {
  constexpr int kHelixRods = 400;
  constexpr double kTurns = 5.0;
  constexpr double kLength_mm = kTurns * 2.0 * kPi / kWave_per_mm;
  constexpr double kLoose = 0.97;  // it has to find its own pitch
  Helix result;
  result.clearance_mm = 0.25;
  WoundWire wire(
      kHelixRods, kLength_mm, 0.0, result.clearance_mm, 1.0, [](double) { return kTip_n; },
      [](double) { return kLoose * kWave_per_mm; });
  sim::ChainProblem& problem = wire.chain.problem;
  problem.contact.begin(wire.seen(), {});
  problem.contact.place(wire.seen(), kHelixRods - 1, wire.tube, wire.spec);
  solve::Newton newton;
  double failed = 0.0;
  for (int detection = 0; detection < 3; ++detection) {
    problem.contact.detect(wire.seen(), wire.tube, wire.spec);
    failed = nan_unless_converged(newton.minimise(problem, statics_spec()));
  }
  result.joints_mm = problem.shape.joints_mm;
  // The middle two turns, between the middles of rods: the ends need a turn to come to rest.
  constexpr int kFirst = 3 * kHelixRods / 10;
  constexpr int kLast = 7 * kHelixRods / 10;
  double turned = failed;
  for (std::size_t i = kFirst; i < kLast; ++i) {
    const Eigen::Vector3d& a = result.joints_mm[i];
    const Eigen::Vector3d& b = result.joints_mm[i + 1];
    turned += std::atan2(b.y() * a.z() - b.z() * a.y(), a.y() * b.y() + a.z() * b.z());
  }
  result.pitch_mm = 2.0 * kPi * (result.joints_mm[kFirst].x() - result.joints_mm[kLast].x()) / turned;
  const auto inside = [&](double arc_mm) {
    return arc_mm > (kFirst + 0.5) * wire.chain.rod_length_mm &&
           arc_mm < (kLast + 0.5) * wire.chain.rod_length_mm;
  };
  for (std::size_t i = 0; i < problem.contact.samples().size(); ++i) {
    if (inside(problem.contact.samples()[i].arc_mm))
      result.wall_n_per_mm += problem.contact.normal_force_n(problem.shape, i).norm();
  }
  result.wall_n_per_mm /= (kLast - kFirst) * wire.chain.rod_length_mm;
  return result;
}

Lock helix_with_friction() {
  constexpr int kLockRods = 600;
  constexpr double kFriction = 0.5;
  constexpr double kClearance_mm = 0.5;
  constexpr double kShare = 0.82;  // of the length at which it locks
  constexpr double kStep_mm = 0.05;
  constexpr int kSteps = 20;  // what it was laid with is forgotten
  Lock result;
  result.lock_mm = 4.0 * kRigidity_n_mm2 / (kFriction * kClearance_mm * kTip_n);
  const auto force_n = [&](double x) { return kTip_n / (1.0 - x / result.lock_mm); };
  WoundWire wire(kLockRods, kShare * result.lock_mm, kFriction, kClearance_mm, 0.03, force_n,
                 [&](double x) { return std::sqrt(force_n(x) / (2.0 * kRigidity_n_mm2)); });
  sim::ChainProblem& problem = wire.chain.problem;
  // It starts as if it had slid before: without the friction of the wall at its back it would unwind.
  contact::FrictionMemory memory;
  for (int i = 0; i < kLockRods; ++i) {
    const double x = (i + 0.5) * wire.chain.rod_length_mm;
    memory.arc_mm.push_back(x);
    memory.normal_n_per_mm.push_back(kClearance_mm * force_n(x) * force_n(x) / (4.0 * kRigidity_n_mm2));
    memory.traction_n_per_mm.emplace_back(Eigen::Vector2d::Zero());
  }
  solve::NewtonSpec spec = statics_spec();
  spec.correction_tolerance_mm = 1e-5;
  spec.max_iterations = 1000;
  solve::Newton newton;
  double failed = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    problem.contact.begin(wire.seen(), memory);
    problem.contact.place(wire.seen(), kLockRods - 1, wire.tube, wire.spec);
    if (step > 0) {
      std::vector<Eigen::Vector3d> joints = problem.shape.joints_mm;
      for (Eigen::Vector3d& x : joints) x.x() += kStep_mm;
      wire.chain.move_joints(joints);
    }
    problem.contact.detect(wire.seen(), wire.tube, wire.spec);
    failed += nan_unless_converged(newton.minimise(problem, spec));
    problem.contact.remember(problem.shape, memory);
  }
  for (int i = 0; i + 2 < kLockRods; ++i) {
    result.from_tip_mm.push_back((i + 0.5) * wire.chain.rod_length_mm);
    result.compression_n.push_back(wire.compression_n(result.from_tip_mm.back()) + failed);
  }
  return result;
}

double Lock::compression_at_n(double from_mm) const {
  std::size_t i = 1;
  while (i + 1 < from_tip_mm.size() && from_tip_mm[i] < from_mm) ++i;
  const double w = (from_mm - from_tip_mm[i - 1]) / (from_tip_mm[i] - from_tip_mm[i - 1]);
  return compression_n[i - 1] + w * (compression_n[i] - compression_n[i - 1]);
}

Checks helix_in_a_cylinder() {
  const Helix helix = helix_without_friction();
  return {{"V9", "compression by the pitch of the helix [mN]", "8π²EI/p²", 1e3 * kTip_n,
           8e3 * kPi * kPi * kRigidity_n_mm2 / (helix.pitch_mm * helix.pitch_mm), 1e-3, ErrorKind::relative,
           "Lubinski1962"},
          {"V9", "wall force per length [mN/m]", "rF²/4EI",
           1e6 * helix.clearance_mm * kTip_n * kTip_n / (4.0 * kRigidity_n_mm2), 1e6 * helix.wall_n_per_mm,
           1e-2, ErrorKind::relative, "Mitchell1986"}};
}

Checks locking_helix() {
  const Lock lock = helix_with_friction();
  const double behind_mm = 2.0 * 2.0 * kPi / kWave_per_mm;
  const double there_n = lock.compression_at_n(behind_mm);
  const double lock_from_there_mm = lock.lock_mm * kTip_n / there_n;
  Checks checks;
  for (const double share : {0.25, 0.5, 0.75}) {
    const std::string at = ", x = " + std::to_string(share).substr(0, 4) + " of the length of lock-up";
    checks.push_back({"V9", "compression over that at the tip" + at, "1/(1 − μrF₀x/4EI)", 1.0 / (1.0 - share),
                      lock.compression_at_n(share * lock.lock_mm) / kTip_n, 5e-2, ErrorKind::relative,
                      "Mitchell1986"});
    // At the tip itself the wire is no helix yet, and presses harder.
    checks.push_back({"V9", "the same over that two pitches behind the tip" + at, "1/(1 − μrF₀x/4EI)",
                      1.0 / (1.0 - share),
                      lock.compression_at_n(behind_mm + share * lock_from_there_mm) / there_n, 1e-2,
                      ErrorKind::relative, "Mitchell1986"});
  }
  return checks;
}

Figure helix_figure() {
  const Helix helix = helix_without_friction();
  Figure figure{"v9", "V9  Helix without friction, from its middle to the tip", "x/p", "height/r", {}};
  Series exact{Mark::line, {}, ""};
  Series ours{Mark::rings, {}, ""};
  const double pitch_mm = 2.0 * kPi / kWave_per_mm;
  // In phase with the closed form where the height is greatest next to the middle of the wire.
  const std::size_t middle = helix.joints_mm.size() / 2;
  std::size_t top = middle;
  constexpr std::size_t kRound = 80;  // rods of a turn
  for (std::size_t i = middle; i > middle - kRound; --i)
    if (helix.joints_mm[i].y() > helix.joints_mm[top].y()) top = i;
  const double from_mm = helix.joints_mm[top].x();
  constexpr int kEvery = 4;
  for (std::size_t i = top; i < helix.joints_mm.size(); i -= kEvery) {
    ours.points.push_back(
        {(helix.joints_mm[i].x() - from_mm) / pitch_mm, helix.joints_mm[i].y() / helix.clearance_mm});
  }
  constexpr double kStep = 0.01;
  for (double x = 0.0; x < ours.points.back().x; x += kStep)
    exact.points.push_back({x, std::cos(2.0 * kPi * x)});
  figure.series = {exact, ours};
  return figure;
}

Figure locking_helix_figure() {
  const Lock lock = helix_with_friction();
  Figure figure{"v9_friction",
                "V9  Compression along a helix that slides with friction",
                "x/length of lock-up",
                "F/F₀",
                {}};
  Series exact{Mark::line, {}, ""};
  Series ours{Mark::rings, {}, ""};
  constexpr int kEvery = 12;
  for (std::size_t i = 0; i < lock.from_tip_mm.size(); i += kEvery) {
    const double share = lock.from_tip_mm[i] / lock.lock_mm;
    exact.points.push_back({share, 1.0 / (1.0 - share)});
    ours.points.push_back({share, lock.compression_n[i] / kTip_n});
  }
  figure.series = {exact, ours};
  return figure;
}

}  // namespace endowire::test

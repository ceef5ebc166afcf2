// V8a  Torque whip with a prescribed centreline: a wire of rest curvature κ0 on a circle of curvature κt, only its spins free.
//
//   GJ α'' = EI κ0 κt sin α,  α' = 0 at the tip,  Λ = L √(EI κ0 κt/GJ)
//
// α is the angle of the rest curvature against the inside of the curve. Rods have their spin at their middles, and each joint gives half of
// its bending energy to either rod, so L runs from the middle of the first rod to that of the last.
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "cases.hpp"
#include "figures.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kTolerance_deg = 2.0;

/// A wire on an arc, its rest curvature towards the inside of the arc where the spins are 0. The hand's spin is held.
class Whip {
 public:
  Whip(double lambda, int rods) : rods_(rods) {
    constexpr double kTubeRadius_mm = 40.0;
    constexpr double kRestCurvature_per_mm = 1.0 / 30.0;
    constexpr double kRigidity_n_mm2 = 10.0;
    rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 1e3);
    wire.sections[0].rest_curvature_per_mm = kRestCurvature_per_mm;
    const double twisted_n_mm2 = wire.sections[0].torsional_rigidity_n_mm2.at_tip_side;
    const double bent_n = kRigidity_n_mm2 * kRestCurvature_per_mm / kTubeRadius_mm;
    const double rod_mm = lambda * std::sqrt(twisted_n_mm2 / bent_n) / (rods - 1);
    chain_ = std::make_unique<Chain>(wire, rods, rod_mm);
    // Chords of the circle; it bends towards y, where the first directors point.
    const double angle = 2.0 * std::asin(0.5 * rod_mm / kTubeRadius_mm);
    std::vector<Eigen::Vector3d> joints;
    for (int i = 0; i <= rods; ++i) {
      const double a = (rods - i) * angle;
      joints.emplace_back(kTubeRadius_mm * std::sin(a), kTubeRadius_mm * (1.0 - std::cos(a)), 0.0);
    }
    chain_->lay_untwisted(joints);
    for (int i = 0; i < rods; ++i) chain_->problem.hold_joint(i, true, true, true);
    chain_->problem.hold_spin(rods - 1);
  }

  void turn_hand(double angle_rad) { turn(rods_ - 1, angle_rad); }

  [[nodiscard]] double tip_rad() const { return chain_->problem.shape.spin_rad.front(); }

  [[nodiscard]] bool settle() { return newton_.minimise(chain_->problem, statics_spec()).converged(); }

  /// Torque that the tip must be held with where the hand stands at one angle and the tip at another [N·mm].
  double tip_torque_n_mm(double hand_rad, double tip_rad) {
    sim::ChainProblem& problem = chain_->problem;
    for (int i = 0; i < rods_; ++i) turn(i, tip_rad + (hand_rad - tip_rad) * i / (rods_ - 1));
    problem.hold_spin(0);
    if (!settle()) return std::numeric_limits<double>::quiet_NaN();
    problem.held[3] = 0;
    math::BandMatrix hessian;
    hessian.resize(problem.unknowns());
    hessian.set_zero();
    std::vector<double> gradient(static_cast<std::size_t>(problem.unknowns()), 0.0);
    problem.linearise(hessian, gradient);
    return gradient[3];
  }

 private:
  void turn(int rod, double angle_rad) {
    chain_->spin(rod, angle_rad - chain_->problem.shape.spin_rad[static_cast<std::size_t>(rod)]);
  }

  int rods_;
  std::unique_ptr<Chain> chain_;
  solve::Newton newton_;
};

/// The hand's angle for an angle of the tip: where nothing needs to hold the tip. Holding it keeps the equilibria that a
/// turning hand would jump over within reach.
double hand_for_tip_rad(Whip& whip, double tip_rad) {
  double low = tip_rad;  // the hand leads, by less than three quarters of a turn
  double high = tip_rad + 1.5 * kPi;
  // Held back by a hand that does not lead, the tip wants to turn back: its torque is positive.
  if (!(whip.tip_torque_n_mm(low, tip_rad) > 0.0 && whip.tip_torque_n_mm(high, tip_rad) < 0.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  constexpr int kHalvings = 24;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (whip.tip_torque_n_mm(middle, tip_rad) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Turns the hand from rest in small steps; where the tip jumps furthest.
double snap_rad(double lambda, int rods) {
  constexpr double kStep = 0.5 * kDegree;
  Whip whip(lambda, rods);
  double before = 0.0;
  double furthest = 0.0;
  double where = 0.0;
  for (double hand = kStep; hand < 1.5 * kPi; hand += kStep) {
    whip.turn_hand(hand);
    if (!whip.settle()) return std::numeric_limits<double>::quiet_NaN();
    const double jump = whip.tip_rad() - before;
    if (jump > furthest) {
      furthest = jump;
      where = hand - 0.5 * kStep;
    }
    before = whip.tip_rad();
  }
  constexpr double kSnap = 45.0 * kDegree;
  return furthest > kSnap ? where : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Checks whip_on_a_given_curve(int rods) {
  const char* const kFormula = "GJ α'' = EI κ0 κt sin α";
  const char* const kSource = "first variation";
  Checks checks;
  for (const double lambda : {0.5, 1.0, 1.5, 2.0}) {
    Whip whip(lambda, rods);
    const std::string name = "Λ = " + std::to_string(lambda).substr(0, 3);
    for (const int tip_deg : {30, 60, 90, 120, 150}) {
      const double tip = tip_deg * kDegree;
      checks.push_back({"V8",
                        "hand angle, given curve, " + name + ", tip " + std::to_string(tip_deg) + "° [°]",
                        kFormula, whip_hand_angle_rad(lambda, tip) / kDegree,
                        hand_for_tip_rad(whip, tip) / kDegree, kTolerance_deg, ErrorKind::absolute, kSource});
    }
  }
  checks.push_back({"V8", "hand angle at which the tip snaps, Λ = 2.0 [°]", kFormula,
                    whip_snap_angle_rad(2.0) / kDegree, snap_rad(2.0, rods) / kDegree, kTolerance_deg,
                    ErrorKind::absolute, kSource});
  return checks;
}

Figure whip_figure() {
  Figure figure{
      "v8", "V8  Torque whip on a given curve, by Λ", "angle at the tip [°]", "angle at the hand [°]", {}};
  for (const double lambda : {0.5, 1.0, 1.5, 2.0}) {
    Whip whip(lambda, kRods);
    // All end at 180°: the outermost names them.
    Series exact{Mark::line, {{0.0, 0.0}}, lambda == 2.0 ? "Λ = 0.5, 1, 1.5, 2" : ""};
    Series ours{Mark::rings, {}, ""};
    constexpr int kHalfTurn_deg = 180;
    for (int tip = 3; tip <= kHalfTurn_deg; tip += 3)
      exact.points.push_back(
          {static_cast<double>(tip), whip_hand_angle_rad(lambda, tip * kDegree) / kDegree});
    for (int tip = 15; tip < kHalfTurn_deg; tip += 15)
      ours.points.push_back({static_cast<double>(tip), hand_for_tip_rad(whip, tip * kDegree) / kDegree});
    figure.series.push_back(exact);
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

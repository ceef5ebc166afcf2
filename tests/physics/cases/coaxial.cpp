// V14  Two instruments within each other: one centreline, each with its own frames, rest curvatures κ̄₁, κ̄₂, rigidities B in bending and
// C in torsion. Without load, α the angle between their planes:
//
//   shared curvature |B₁κ̄₁ + B₂κ̄₂|/(B₁ + B₂),  energy ½ B₁B₂/(B₁ + B₂) |κ̄₁ − κ̄₂|² per length
//   α'' = c sin α,  α' = 0 at the tip,  c = B₁B₂/(B₁ + B₂) κ̄₁κ̄₂ (1/C₁ + 1/C₂)
//
// which is the equation of torque whip with Λ = L√c: from Λ = ½π on the hand cannot hold them turned by π, the one snaps round the
// other. As in V8, L runs from the middle of the rod at the hand to that of the rod at the tip.
#include "coaxial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cases.hpp"
#include "endowire/math/transport.hpp"
#include "endowire/rod/coaxial.hpp"
#include "figures.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kTolerance = 1e-3;
constexpr double kLength_mm = 100.0;
const char* const kSource = "Dupont2010";

/// A wire and the catheter around it.
constexpr double kWire_n_mm2 = 10.0;
constexpr double kCatheter_n_mm2 = 30.0;
constexpr double kSum_n_mm2 = kWire_n_mm2 + kCatheter_n_mm2;
constexpr double kMean_n_mm2 = kWire_n_mm2 * kCatheter_n_mm2 / kSum_n_mm2;

rod::Instrument instrument(double rigidity_n_mm2, double rest_curvature_per_mm) {
  rod::Instrument made = uniform_wire(rigidity_n_mm2, 5e3);
  made.sections[0].rest_curvature_per_mm = rest_curvature_per_mm;
  return made;
}

double torsional(const rod::Instrument& made) {
  return made.sections[0].torsional_rigidity_n_mm2.at_tip_side;
}

/// Both pre-curved alike where one alone would be: together they are straight when turned by π.
struct Opposed {
  static constexpr double kWireCurvature_per_mm = 0.03;
  rod::Instrument wire = instrument(kWire_n_mm2, kWireCurvature_per_mm);
  rod::Instrument catheter =
      instrument(kCatheter_n_mm2, kWireCurvature_per_mm* kWire_n_mm2 / kCatheter_n_mm2);

  /// 1/C of both in series.
  [[nodiscard]] double torsion_n_mm2() const {
    return 1.0 / (1.0 / torsional(wire) + 1.0 / torsional(catheter));
  }
  /// c
  [[nodiscard]] double pull_per_mm2() const {
    return kMean_n_mm2 * wire.sections[0].rest_curvature_per_mm * catheter.sections[0].rest_curvature_per_mm /
           torsion_n_mm2();
  }
  /// Whose Λ is given.
  [[nodiscard]] CoaxialChain chain(double lambda, int rods, double turned_rad = 0.0) const {
    return {wire, catheter, rods, lambda / std::sqrt(pull_per_mm2()) / (rods - 1), 0.0, turned_rad};
  }
};

/// The closed form's angle at the tip for an angle at the hand, on the branch from rest.
double tip_angle_rad(double lambda, double hand_rad) {
  double low = 0.0;
  double high = std::min(hand_rad, kPi);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (whip_hand_angle_rad(lambda, middle) < hand_rad ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Checks aligned(int rods) {
  constexpr double kWireCurvature_per_mm = 1.0 / 30.0;
  constexpr double kCatheterCurvature_per_mm = 1.0 / 80.0;
  CoaxialChain chain(instrument(kWire_n_mm2, kWireCurvature_per_mm),
                     instrument(kCatheter_n_mm2, kCatheterCurvature_per_mm), rods, kLength_mm / rods);
  const double failed = chain.settle();
  const rod::ChainShape& shape = chain.problem().shape;
  const double shared =
      (kWire_n_mm2 * kWireCurvature_per_mm + kCatheter_n_mm2 * kCatheterCurvature_per_mm) / kSum_n_mm2;
  double worst = shared;
  for (std::size_t j = 1; j < shape.frames.size(); ++j) {
    const double chord = (shape.frames[j].col(2) - shape.frames[j - 1].col(2)).norm();
    const double curvature = 2.0 * std::asin(0.5 * chord) / (kLength_mm / rods);
    if (!(std::abs(curvature - shared) <= std::abs(worst - shared))) worst = curvature;
  }
  return {{"V14", "worst curvature, rest curves aligned [1/m]", "Σ(EI κ0)/ΣEI", 1e3 * shared,
           1e3 * worst + failed, 1e-6, ErrorKind::relative, "first variation"}};
}

Checks loaded(int rods) {
  Checks checks;
  {
    constexpr double kAlpha = 2.0;
    CoaxialChain chain(instrument(kWire_n_mm2, 0.0), instrument(kCatheter_n_mm2, 0.0), rods,
                       kLength_mm / (rods - 0.5));
    chain.problem().loads.tip_force_n.y() = kAlpha * kSum_n_mm2 / (kLength_mm * kLength_mm);
    const double failed = chain.settle();
    checks.push_back({"V14", "deflection δ/L of both under a dead end force, P L²/ΣEI = 2",
                      "elastica, EI = ΣEI", tip_loaded_elastica(kAlpha).deflection,
                      chain.problem().shape.joints_mm[0].y() / kLength_mm + failed, kTolerance,
                      ErrorKind::relative, "BisshoppDrucker1945"});
  }
  {
    // Small: beam theory is linear.
    constexpr double kForce_n = 1e-5;
    CoaxialChain chain(instrument(kWire_n_mm2, 0.0), instrument(kCatheter_n_mm2, 0.0), rods,
                       kLength_mm / (rods - 0.5), 0.4 * kLength_mm);
    chain.problem().loads.tip_force_n.y() = kForce_n;
    const double failed = chain.settle();
    const double bare = std::pow(chain.behind_mm(), 3);
    const double exact =
        kForce_n / 3.0 * ((std::pow(kLength_mm, 3) - bare) / kSum_n_mm2 + bare / kWire_n_mm2);
    checks.push_back({"V14", "deflection [µm], the catheter ending two fifths of the length behind the tip",
                      "P/3 ((L³ − a³)/ΣEI + a³/EI₁)", 1e3 * exact,
                      1e3 * chain.problem().shape.joints_mm[0].y() + failed, kTolerance, ErrorKind::relative,
                      "linear beam theory"});
  }
  return checks;
}

/// So short and so stiff in torsion that the angle between them is that of the hands all along.
Checks turned_stiff(int rods) {
  constexpr double kShort_mm = 20.0;
  Checks checks;
  Opposed pair;
  for (rod::Instrument* made : {&pair.wire, &pair.catheter}) {
    const double stiff_n_mm2 = 3e3 * torsional(*made);
    made->sections[0].torsional_rigidity_n_mm2 = {stiff_n_mm2, stiff_n_mm2};
  }
  const double wire = pair.wire.sections[0].rest_curvature_per_mm;
  const double catheter = pair.catheter.sections[0].rest_curvature_per_mm;
  for (const int degrees : {60, 120}) {
    const double angle = degrees * kDegree;
    CoaxialChain chain(pair.wire, pair.catheter, rods, kShort_mm / (rods - 1), 0.0, angle);
    const double failed = chain.settle();
    const std::string name = ", turned by " + std::to_string(degrees) + "°";
    const double apart = wire * wire + catheter * catheter - 2.0 * wire * catheter * std::cos(angle);
    checks.push_back({"V14", "energy [mJ]" + name, "½ B₁B₂/(B₁ + B₂) ∣κ̄₁ − κ̄₂∣² L",
                      0.5 * kMean_n_mm2 * apart * kShort_mm,
                      rod::chain_energy(chain.problem().material, chain.problem().shape) + failed, kTolerance,
                      ErrorKind::relative, kSource});
    checks.push_back({"V14", "torque between them [N·mm]" + name, "B₁B₂/(B₁ + B₂) κ̄₁κ̄₂ L sin α",
                      kMean_n_mm2 * wire * catheter * kShort_mm * std::sin(angle),
                      chain.hand_torque_n_mm(1) + failed, kTolerance, ErrorKind::relative, kSource});
  }
  return checks;
}

Checks turned_soft(int rods) {
  constexpr double kLambda = 1.0;
  Checks checks;
  const Opposed pair;
  for (const int degrees : {60, 120}) {
    const double hand = degrees * kDegree;
    CoaxialChain chain = pair.chain(kLambda, rods, hand);
    const double failed = chain.settle();
    const double tip = tip_angle_rad(kLambda, hand);
    const std::string name = ", L√c = 1, the hands at " + std::to_string(degrees) + "°";
    checks.push_back({"V14", "angle at the tip [°]" + name, "α'' = c sin α", tip / kDegree,
                      chain.angle_rad(0) / kDegree + failed, kTolerance, ErrorKind::relative, "Rucker2010"});
    checks.push_back(
        {"V14", "torque of the hand on the catheter [N·mm]" + name, "√(2c (cos α_L − cos α₀))/(1/C₁ + 1/C₂)",
         pair.torsion_n_mm2() * std::sqrt(2.0 * pair.pull_per_mm2() * (std::cos(tip) - std::cos(hand))),
         chain.hand_torque_n_mm(1) + failed, kTolerance, ErrorKind::relative, "Rucker2010"});
  }
  return checks;
}

/// Turned by π: unstable modes of the straight pair, by its Λ.
int unstable_modes(double lambda, int rods) {
  CoaxialChain chain = Opposed{}.chain(lambda, rods, kPi);
  solve::Newton newton;
  return newton.inertia(chain.problem());
}

Checks onset(int rods) {
  double low = 0.9 * 0.5 * kPi;
  double high = 1.1 * 0.5 * kPi;
  const bool bracketed = unstable_modes(low, rods) == 0 && unstable_modes(high, rods) == 1;
  constexpr int kHalvings = 26;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (unstable_modes(middle, rods) == 0 ? low : high) = middle;
  }
  return {{"V14", "L√c at which they no longer stay turned by 180°, by inertia count", "½π", 0.5 * kPi,
           bracketed ? 0.5 * (low + high) : std::numeric_limits<double>::quiet_NaN(), kTolerance,
           ErrorKind::relative, kSource}};
}

/// Turns the hand from rest in small steps; where the tip jumps furthest.
Checks snap(int rods) {
  constexpr double kLambda = 2.0;
  constexpr double kStep = 0.5 * kDegree;
  constexpr double kTolerance_deg = 2.0;
  CoaxialChain chain = Opposed{}.chain(kLambda, rods);
  double failed = 0.0;
  double before = 0.0;
  double furthest = 0.0;
  double where = 0.0;
  for (double hand = kStep; hand < 1.25 * kPi; hand += kStep) {
    chain.turn(kStep);
    failed += chain.settle();
    const double jump = chain.angle_rad(0) - before;
    if (jump > furthest) {
      furthest = jump;
      where = hand;
    }
    before = chain.angle_rad(0);
  }
  return {{"V14", "angle of the hands at the snap [°], L√c = 2", "α'' = c sin α",
           whip_snap_angle_rad(kLambda) / kDegree, where / kDegree + failed, kTolerance_deg,
           ErrorKind::absolute, "Rucker2010"}};
}

}  // namespace

CoaxialChain::CoaxialChain(const rod::Instrument& first, const rod::Instrument& second, int rods,
                           double rod_length_mm, double behind_mm, double turned_rad)
    : chain_(std::make_unique<Chain>(first, rods, rod_length_mm)),
      second_(std::make_unique<rod::MaterialLine>(second)) {
  sim::ChainProblem& problem = chain_->problem;
  if (behind_mm > 0.0) behind_mm_ = rod::nearest_rod_middle_mm(problem.material, behind_mm);
  rod::add_coaxial({second_.get(), 0.0, 0.0}, behind_mm_, problem.material);
  rod::add_coaxial_frames(turned_rad, problem.shape);
  problem.release_all();
  problem.clamp_hand_end();
}

sim::ChainProblem& CoaxialChain::problem() {
  return chain_->problem;
}

void CoaxialChain::turn(double angle_rad) {
  rod::RodFrames& second = problem().shape.coaxial[0];
  rod::Frame& frame = second.frames.back();
  frame.col(0) = math::spin_about(frame.col(0), frame.col(2), angle_rad);
  frame.col(1) = frame.col(2).cross(frame.col(0));
  second.spin_rad.back() += angle_rad;
  second.twist_rad[second.frames.size() - 1] -= angle_rad;
}

double CoaxialChain::angle_rad(int rod) const {
  const rod::ChainShape& shape = chain_->problem.shape;
  const auto i = static_cast<std::size_t>(rod);
  // Spins are about the rod as it moves, the same for both.
  return shape.coaxial[0].spin_rad[i] - shape.spin_rad[i];
}

double CoaxialChain::hand_torque_n_mm(int instrument) const {
  return rod::end_torque_n_mm(chain_->problem.material, chain_->problem.shape, instrument);
}

double CoaxialChain::settle() {
  solve::Newton newton;
  return nan_unless_converged(newton.minimise(chain_->problem, statics_spec()));
}

Checks coaxial_instruments(int rods) {
  Checks all;
  for (const auto& part : {aligned, loaded, turned_soft, onset}) {
    const Checks some = part(rods);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Checks coaxial_stiff_in_torsion() {
  return turned_stiff(kRods);
}

Checks coaxial_snap() {
  return snap(kRods);
}

Figure coaxial_figure() {
  Figure figure{"v14",
                "V14  Turned against each other, hands and tip; L√c = 1, 1.5, 2",
                "angle of the hands [°]",
                "angle at the tip [°]",
                {}};
  constexpr double kStep = 0.5 * kDegree;
  constexpr int kEvery = 20;
  for (const double lambda : {1.0, 1.5, 2.0}) {
    Series exact{Mark::line, {}, ""};
    for (double tip = 0.0; tip <= kPi + 1e-9; tip += kPi / 180.0)
      exact.points.push_back({whip_hand_angle_rad(lambda, tip) / kDegree, tip / kDegree});
    Series ours{Mark::rings, {}, ""};
    CoaxialChain chain = Opposed{}.chain(lambda, kRods);
    double failed = 0.0;
    const int last = static_cast<int>((lambda > 0.5 * kPi ? whip_snap_angle_rad(lambda) : kPi) / kStep);
    for (int i = 0; i <= last; ++i) {
      if (i > 0) chain.turn(kStep);
      failed += chain.settle();
      if (i % kEvery == 0)
        ours.points.push_back({i * kStep / kDegree, chain.angle_rad(0) / kDegree + failed});
    }
    figure.series.push_back(exact);
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

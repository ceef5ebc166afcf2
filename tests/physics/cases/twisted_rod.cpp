// V7  A long rod, twisted under tension, buckles and localises.
//
//   onset M² = 4EI T;  then M² = 2EI T (1 + cos φ₀),  (cos φ − cos φ₀)/(1 − cos φ₀) = tanh²(s/s*)      [vanderHeijdenThompson2000]
//
// Onset: both ends clamped, the tension dead, the ends turned against each other. The rod is of finite length, whose onset is known as
// well (see twisted_rod_onset); the limit is reached by two lengths, from which the square of the inverse length is taken out.
//
// Localised: the ends are held where the closed form has them, at their distance and turned, for under a dead load and a dead torque
// that shape is no minimum. Tension, moment and the angle in the middle are what the rod answers with. The bend may slide
// along the rod and turn round it at next to no cost: its middle is kept from that, at no force.
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

constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kTension_n = 0.1;
constexpr double kUnit_mm = 10.0;  // √(EI/T)
constexpr double kTolerance = 1e-3;
const char* const kSource = "vanderHeijdenThompson2000";
constexpr double kDegree = std::numbers::pi / 180.0;

void clamp_tip(sim::ChainProblem& problem, bool slides) {
  problem.hold_joint(0, !slides, true, true);
  problem.hold_joint(1, !slides, true, true);
  problem.hold_spin(0);
}

/// Moment over 2√(EI T) at which a straight rod, clamped in the middles of its end rods, becomes unstable.
double onset(int rods, double length) {
  const double rod_mm = length * kUnit_mm / (rods - 1);
  Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * rod_mm * rods), rods, rod_mm);
  sim::ChainProblem& problem = chain.problem;
  std::vector<Eigen::Vector3d> joints = problem.shape.joints_mm;
  for (int i = rods - 2; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    joints[k].x() = joints[k + 1].x() + rod_mm + kTension_n / problem.material.stretch_n_per_mm[k];
  }
  chain.lay_untwisted(joints);
  problem.loads.tip_force_n.x() = kTension_n;
  problem.clamp_hand_end();
  clamp_tip(problem, true);
  const double twisted_n_mm2 = uniform_section(kRigidity_n_mm2, 1.0).torsional_rigidity_n_mm2.at_tip_side;
  double applied = 0.0;
  const auto unstable_modes = [&](double relative_moment) {
    const double moment_n_mm = 2.0 * relative_moment * std::sqrt(kRigidity_n_mm2 * kTension_n);
    for (int i = 0; i < rods; ++i)
      chain.spin(i, (moment_n_mm - applied) / twisted_n_mm2 * rod_mm * (rods - 1 - i));
    applied = moment_n_mm;
    solve::Newton newton;
    return newton.inertia(problem);
  };
  const double exact = twisted_rod_onset(length);
  double low = 0.95 * exact;
  double high = 1.05 * exact;
  if (unstable_modes(low) != 0 || unstable_modes(high) == 0) return std::numeric_limits<double>::quiet_NaN();
  constexpr int kHalvings = 26;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (unstable_modes(middle) == 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A rod laid on the localised shape of the closed form, and left to find its own.
class Localised {
 public:
  Localised(int rods, double middle_rad)
      : exact_(localised_buckling(kRigidity_n_mm2, kTension_n, middle_rad)) {
    constexpr double kExtents = 16.0;  // at their ends the angle has fallen to 1e-3 rad
    const double rod_mm = kExtents * exact_.extent_mm / (rods - 1);
    chain_ = std::make_unique<Chain>(uniform_wire(kRigidity_n_mm2, 2.0 * rod_mm * rods), rods, rod_mm);
    std::vector<Eigen::Vector3d> joints(static_cast<std::size_t>(rods + 1), Eigen::Vector3d::Zero());
    for (int i = rods - 1; i >= 0; --i) {
      const bool clamped = i == rods - 1 || i == 0;
      joints[static_cast<std::size_t>(i)] =
          joints[static_cast<std::size_t>(i + 1)] +
          (rod_mm + kTension_n / chain_->problem.material.stretch_n_per_mm[1]) *
              (clamped ? Eigen::Vector3d::UnitX() : tangent(place_mm(i), middle_rad));
    }
    chain_->lay_untwisted(joints);
    const double twist_rad = exact_.moment_n_mm * rod_mm / chain_->problem.material.joints[1].twist_n_mm2;
    for (int i = 0; i < rods; ++i) chain_->spin(i, twist_rad * (rods - 1 - i));
    chain_->problem.clamp_hand_end();
    clamp_tip(chain_->problem, false);
    chain_->problem.hold_joint(rods / 2, true, true, false);  // it deflects along z
    solve::Newton newton;
    failed_ = nan_unless_converged(newton.minimise(chain_->problem, statics_spec()));
  }

  [[nodiscard]] const LocalisedBuckling& exact() const { return exact_; }
  /// Where the middle of a rod is, from the middle of the chain.
  [[nodiscard]] double place_mm(int rod) const {
    return (0.5 * (chain_->problem.shape.rods() - 1) - rod) * chain_->rod_length_mm;
  }
  [[nodiscard]] double angle_rad(int rod) const {
    return std::acos(chain_->problem.shape.frames[static_cast<std::size_t>(rod)].col(2).x()) + failed_;
  }
  /// Where the shape has hardly a deflection.
  [[nodiscard]] double tension_n() const {
    return rod::axial_force_n(chain_->problem.material, chain_->problem.shape, 1) + failed_;
  }
  [[nodiscard]] double moment_n_mm() const {
    const rod::JointMaterial& joint = chain_->problem.material.joints[1];
    return joint.twist_n_mm2 * chain_->problem.shape.twist_rad[1] / joint.span_mm + failed_;
  }
  /// Cosine of the angle in the middle, which is even in s: from the two rods next to it on one side.
  [[nodiscard]] double middle_cosine() const {
    const int next = rods() / 2 - 1;
    const double c = std::cos(angle_rad(next));
    return c - (std::cos(angle_rad(next - 1)) - c) / 8.0;
  }
  [[nodiscard]] int rods() const { return chain_->problem.shape.rods(); }

 private:
  /// The tangent turns about the axis by ψ' = M/(EI (1 + cos φ)), which integrates to ψ = Ms/2EI + atan(tan(φ₀/2) tanh(s/s*)).
  [[nodiscard]] Eigen::Vector3d tangent(double s_mm, double middle_rad) const {
    const double t = std::tanh(s_mm / exact_.extent_mm);
    const double c = std::cos(middle_rad) + (1.0 - std::cos(middle_rad)) * t * t;
    const double turn =
        exact_.moment_n_mm * s_mm / (2.0 * kRigidity_n_mm2) + std::atan(std::tan(0.5 * middle_rad) * t);
    const double s = std::sqrt(1.0 - c * c);
    return {c, s * std::cos(turn), s * std::sin(turn)};
  }

  LocalisedBuckling exact_;
  std::unique_ptr<Chain> chain_;
  double failed_ = 0.0;
};

}  // namespace

Checks twisted_rod(int rods) {
  const auto check = [](const std::string& quantity, const char* formula, double exact, double ours,
                        const char* source) {
    return Check{"V7", quantity, formula, exact, ours, kTolerance, ErrorKind::relative, source};
  };
  Checks checks;
  for (const double length : {3.0, 5.0}) {
    checks.push_back(check("onset M/2√(EI T), length " + std::to_string(static_cast<int>(length)) + "√(EI/T)",
                           "EI w'''' − iM w''' − T w'' = 0", twisted_rod_onset(length), onset(rods, length),
                           "first variation"));
  }
  // The longer the rod, the more rods: 20 to a length of √(EI/T).
  const double half = onset(10 * rods, 0.5 * rods);
  const double whole = onset(20 * rods, rods);
  checks.push_back(
      check("onset M²/4EI T, length → ∞", "1", 1.0, std::pow(whole + (whole - half) / 3.0, 2), kSource));
  return checks;
}

Checks localised_rod(int rods) {
  Checks checks;
  for (const int degrees : {60, 75}) {
    const Localised rod(rods, degrees * kDegree);
    const std::string name = ", φ₀ = " + std::to_string(degrees) + "°";
    const double c = rod.middle_cosine();
    const double moment_n_mm = rod.moment_n_mm();
    checks.push_back({"V7", "M²/2EI T" + name, "1 + cos φ₀", 1.0 + c,
                      moment_n_mm * moment_n_mm / (2.0 * kRigidity_n_mm2 * rod.tension_n()), kTolerance,
                      ErrorKind::relative, kSource});
    const double extent_mm = 2.0 * kRigidity_n_mm2 / moment_n_mm * std::sqrt((1.0 + c) / (1.0 - c));
    double worst = 0.0;
    for (int i = 1; i + 1 < rod.rods(); ++i) {
      const double t = std::tanh(rod.place_mm(i) / extent_mm);
      const double miss = (std::cos(rod.angle_rad(i)) - c) / (1.0 - c) - t * t;
      if (!(std::abs(miss) <= std::abs(worst))) worst = miss;
    }
    checks.push_back({"V7", "worst miss of (cos φ − cos φ₀)/(1 − cos φ₀)" + name, "tanh²(s/s*)", 0.0, worst,
                      kTolerance, ErrorKind::absolute, kSource});
  }
  return checks;
}

Figure localised_rod_figure() {
  Figure figure{"v7", "V7  Angle of a localised bend to the axis of the rod", "s/s*", "φ [°]", {}};
  constexpr int kEvery = 8;
  constexpr double kDrawn = 5.0;  // extents to either side
  for (const int degrees : {60, 75}) {
    const Localised rod(kLocalisedRods, degrees * kDegree);
    Series exact{Mark::line, {}, ""};
    Series ours{Mark::rings, {}, ""};
    for (double s = -kDrawn; s <= kDrawn; s += 0.1) {
      const double c = std::cos(degrees * kDegree);
      exact.points.push_back({s, std::acos(c + (1.0 - c) * std::pow(std::tanh(s), 2)) / kDegree});
    }
    for (int i = 1; i + 1 < rod.rods(); i += kEvery) {
      const double s = rod.place_mm(i) / rod.exact().extent_mm;
      if (std::abs(s) < kDrawn) ours.points.push_back({s, rod.angle_rad(i) / kDegree});
    }
    figure.series.push_back(exact);
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

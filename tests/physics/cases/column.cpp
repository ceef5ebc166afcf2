// V4  Column clamped at one end, free at the other: P = π² EI/4L².              [Euler1744]
// V5  Column with pinned ends after buckling, by its end angle.                  [TimoshenkoGere1961 §2.7]
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "cases.hpp"
#include "figures.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kTolerance = 1e-3;
constexpr double kPi = std::numbers::pi;

/// Negative eigenvalues of the straight column, compressed by the load.
int buckled_modes(Chain& chain, double load_n) {
  rod::ChainShape& shape = chain.problem.shape;
  for (int i = shape.rods() - 2; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const double shorter = load_n / chain.problem.material.stretch_n_per_mm[k];
    shape.joints_mm[k].x() = shape.joints_mm[k + 1].x() + chain.rod_length_mm - shorter;
  }
  chain.problem.loads.tip_force_n.x() = -load_n;
  solve::Newton newton;
  return newton.inertia(chain.problem);
}

}  // namespace

Checks euler_column(int rods) {
  Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / (rods - 0.5));
  chain.problem.clamp_hand_end();
  const double exact = kPi * kPi * kRigidity_n_mm2 / (4.0 * kLength_mm * kLength_mm);
  double low = 0.9 * exact;
  double high = 1.1 * exact;
  // A round column buckles in both planes at once.
  const bool bracketed = buckled_modes(chain, low) == 0 && buckled_modes(chain, high) == 2;
  constexpr int kHalvings = 30;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (buckled_modes(chain, middle) == 0 ? low : high) = middle;
  }
  return {{"V4", "critical load by inertia count [mN]", "π²EI/4L²", 1e3 * exact,
           bracketed ? 1e3 * 0.5 * (low + high) : std::numeric_limits<double>::quiet_NaN(), kTolerance,
           ErrorKind::relative, "Euler1744"}};
}

namespace {

/// A column with pinned ends that stands on the buckled branch; joint n at the origin, the load along −x.
class Arch {
 public:
  Arch(int rods, double end_angle_rad)
      : chain_(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / rods) {
    // Start on a cosine arch: the straight column is an equilibrium too.
    std::vector<Eigen::Vector3d> joints(static_cast<std::size_t>(rods + 1), Eigen::Vector3d::Zero());
    for (int i = rods - 1; i >= 0; --i) {
      const double angle = end_angle_rad * std::cos(kPi * (rods - i - 0.5) / rods);
      joints[static_cast<std::size_t>(i)] =
          joints[static_cast<std::size_t>(i + 1)] +
          chain_.rod_length_mm * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    }
    chain_.lay_untwisted(joints);
    chain_.problem.hold_joint(0, false, true, true);
    chain_.keep_plane();
  }

  /// Angle of the curve at its end under a load, in units of Pcr.
  double end_angle_rad(double load) {
    chain_.problem.loads.tip_force_n.x() = -load * kPi * kPi * kRigidity_n_mm2 / (kLength_mm * kLength_mm);
    const double failed = nan_unless_converged(newton_.minimise(chain_.problem, statics_spec()));
    const auto angle = [&](int rod) {
      const Eigen::Vector3d& e = chain_.problem.shape.frames[static_cast<std::size_t>(rod)].col(2);
      return std::atan2(e.y(), e.x());
    };
    // Rods have the angle of the curve at their middles, and no moment acts at the end: θ = θ₀ + O(s²).
    const int n = chain_.problem.shape.rods();
    return angle(n - 1) + (angle(n - 1) - angle(n - 2)) / 8.0 + failed;
  }

  [[nodiscard]] double span() const { return chain_.problem.shape.joints_mm.front().x() / kLength_mm; }
  [[nodiscard]] double deflection() const {
    return chain_.problem.shape.joints_mm[static_cast<std::size_t>(chain_.problem.shape.rods() / 2)].y() /
           kLength_mm;
  }

 private:
  Chain chain_;
  solve::Newton newton_;
};

/// The load at which the end angle is the wanted one, by the secant rule; leaves the arch there.
double load_of(Arch& arch, double end_angle_rad, double first_guess) {
  double load = first_guess;
  double before = 1.01 * first_guess;
  double miss_before = arch.end_angle_rad(before) - end_angle_rad;
  constexpr int kMost = 12;
  for (int i = 0; i < kMost; ++i) {
    const double miss = arch.end_angle_rad(load) - end_angle_rad;
    if (std::abs(miss) < 1e-7) return load;
    const double next = load - miss * (load - before) / (miss - miss_before);
    before = load;
    miss_before = miss;
    load = next;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Checks buckled_column(int rods) {
  Checks checks;
  for (const int degrees : {30, 60, 90, 120}) {
    const double end_angle = degrees * kPi / 180.0;
    const PostBuckling exact = post_buckling(end_angle);
    Arch arch(rods, end_angle);
    const double load = load_of(arch, end_angle, exact.load);
    const auto add = [&](const char* quantity, const char* formula, double reference, double ours) {
      checks.push_back({"V5", std::string(quantity) + ", end angle " + std::to_string(degrees) + "°", formula,
                        reference, ours, kTolerance, ErrorKind::relative, "TimoshenkoGere1961"});
    };
    const double failed = 0.0 * load;
    add("P/Pcr", "(2K/π)²", exact.load, load);
    add("span/L", "2E/K − 1", exact.span, arch.span() + failed);
    add("mid deflection/L", "k/K", exact.deflection, arch.deflection() + failed);
  }
  return checks;
}

Figure column_figure() {
  Figure figure{
      "v4", "V4  Modes in which a clamped column is unstable, two to a load", "P/Pcr", "unstable modes", {}};
  Series exact{Mark::line, {{0.0, 0.0}}, ""};
  for (int mode = 1; mode <= 3; ++mode) {
    const double load = std::pow(2.0 * mode - 1.0, 2);
    exact.points.push_back({load, 2.0 * (mode - 1)});
    exact.points.push_back({load, 2.0 * mode});
  }
  constexpr double kMost = 30.0;
  exact.points.push_back({kMost, exact.points.back().y});
  Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), kRods, kLength_mm / (kRods - 0.5));
  chain.problem.clamp_hand_end();
  Series ours{Mark::rings, {}, ""};
  for (double load = 0.5; load < kMost; load += 1.0) {
    const double load_n = load * kPi * kPi * kRigidity_n_mm2 / (4.0 * kLength_mm * kLength_mm);
    ours.points.push_back({load, static_cast<double>(buckled_modes(chain, load_n))});
  }
  figure.series = {exact, ours};
  return figure;
}

Figure buckled_column_figure() {
  Figure figure{"v5", "V5  Column with pinned ends after buckling", "span/L", "P/Pcr", {}};
  Series exact{Mark::line, {}, ""};
  Series ours{Mark::rings, {}, ""};
  constexpr int kMost_deg = 120;
  for (int degrees = 2; degrees <= kMost_deg; degrees += 2) {
    const PostBuckling column = post_buckling(degrees * kPi / 180.0);
    exact.points.push_back({column.span, column.load});
  }
  for (int degrees = 15; degrees <= kMost_deg; degrees += 15) {
    const double end_angle = degrees * kPi / 180.0;
    Arch arch(kRods, end_angle);
    const double load = load_of(arch, end_angle, post_buckling(end_angle).load);
    ours.points.push_back({arch.span(), load});
  }
  figure.series = {exact, ours};
  return figure;
}

}  // namespace endowire::test

// Newton on small problems whose minima are known: in the band, indefinite, stubborn and broken ones.
#include "endowire/solve/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/frames.hpp"

namespace endowire::solve {
namespace {

/// A chain of unknowns y in the potential of single wells or double wells, tied to their neighbours:
///
///   E = Σ (a yᵢ⁴/4 + b yᵢ²/2 − fᵢ yᵢ) + ½c Σ (yᵢ − yᵢ₊₄)²
///
/// Convex for b ≥ 0; for b < 0 indefinite around y = 0, with minima around ±√(−b/a).
class QuarticChain : public Problem {
 public:
  QuarticChain(int joints, double quartic, double well, double spring)
      : y(static_cast<std::size_t>(4 * joints), 0.0), f(y.size(), 0.0), a_(quartic), b_(well), c_(spring) {}

  [[nodiscard]] int unknowns() const override { return static_cast<int>(y.size()); }
  double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) override {
    ++linearised;
    for (std::size_t i = 0; i < y.size(); ++i) {
      gradient[i] += a_ * y[i] * y[i] * y[i] + b_ * y[i] - f[i];
      hessian.lower(static_cast<int>(i), static_cast<int>(i)) += 3.0 * a_ * y[i] * y[i] + b_;
      if (i < 4) continue;
      const double stretch = y[i] - y[i - 4];
      gradient[i] += c_ * stretch;
      gradient[i - 4] -= c_ * stretch;
      hessian.add(static_cast<int>(i), static_cast<int>(i), c_);
      hessian.add(static_cast<int>(i) - 4, static_cast<int>(i) - 4, c_);
      hessian.add(static_cast<int>(i), static_cast<int>(i) - 4, -c_);
    }
    return energy(y);
  }
  double try_step(const std::vector<double>& d, double alpha) override {
    trial = y;
    for (std::size_t i = 0; i < y.size(); ++i) trial[i] += alpha * d[i];
    return energy(trial);
  }
  void accept_step() override { y = trial; }
  [[nodiscard]] ForceScales scales() const override { return {1.0, 1.0, 0.0}; }
  [[nodiscard]] double lag_error() const override { return lag; }
  void renew_lagged() override {
    ++renewed;
    lag *= lag_shrinks;
  }
  [[nodiscard]] bool inside_region() const override {
    for (const double v : y)
      if (std::abs(v) > region) return false;
    return true;
  }

  [[nodiscard]] virtual double energy(const std::vector<double>& at) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double q = at[i] * at[i];
      sum += 0.25 * a_ * q * q + 0.5 * b_ * q - f[i] * at[i];
      if (i >= 4) sum += 0.5 * c_ * (at[i] - at[i - 4]) * (at[i] - at[i - 4]);
    }
    return sum;
  }
  /// Largest component of the gradient, computed here and not by the solver.
  [[nodiscard]] double residual() {
    math::BandMatrix unused;
    unused.resize(unknowns());
    std::vector<double> gradient(y.size(), 0.0);
    linearise(unused, gradient);
    double largest = 0.0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    return largest;
  }

  std::vector<double> y, f, trial;
  double lag = 0.0, lag_shrinks = 0.0, region = 1e9;
  int linearised = 0, renewed = 0;

 private:
  double a_, b_, c_;
};

NewtonSpec generous() {
  NewtonSpec spec;
  spec.max_step_mm = 1e3;
  spec.max_turn_rad = 1e3;
  return spec;
}

// A quadratic is solved in one step: breaks with any wrong sign or factor between gradient, matrix and step.
TEST(Newton, AQuadraticTakesOneStep) {
  QuarticChain problem(20, 0.0, 0.5, 3.0);
  test::Random random(81);
  for (double& f : problem.f) f = random.normal();
  Newton newton;
  const SolveReport report = newton.minimise(problem, generous());
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(report.regularised_iterations, 0);
  EXPECT_EQ(report.factorisations, 2);
  EXPECT_LT(problem.residual(), 1e-12);
  EXPECT_NEAR(report.merit_mj, problem.energy(problem.y), 1e-12);
}

// A convex quartic far from its minimum. Breaks when the line search accepts an increase, or the test of convergence looks
// at the step alone.
TEST(Newton, AConvexQuarticConverges) {
  QuarticChain problem(30, 1.0, 0.1, 2.0);
  test::Random random(82);
  for (double& f : problem.f) f = random.normal();
  for (double& y : problem.y) y = 5.0 * random.normal();
  Newton newton;
  const SolveReport report = newton.minimise(problem, generous());
  EXPECT_TRUE(report.converged());
  EXPECT_LT(report.iterations, 25);
  EXPECT_LT(problem.residual(), 1.1e-6);
  EXPECT_EQ(newton.inertia(problem), 0);
  EXPECT_LE(report.correction_mm, 1e-3);
  EXPECT_LE(report.correction_rad, 1.7453e-4);
  // The report's residual is the problem's, in norm over the three coordinates of a joint.
  EXPECT_LE(report.force_residual_n, std::sqrt(3.0) * problem.residual() + 1e-15);
  EXPECT_DOUBLE_EQ(report.force_scale_n, 1.0);
}

// From a maximum the proximal term leads down to a minimum, and has no force at the end. Breaks when the wrong inertia is
// not seen (the saddle is stationary), or when a drag remains in the answer.
TEST(Newton, LeavesASaddleForAMinimum) {
  QuarticChain problem(10, 1.0, -1.0, 0.05);
  test::Random random(83);
  for (double& y : problem.y) y = 1e-3 * random.normal();
  Newton newton;
  EXPECT_EQ(newton.inertia(problem), 40) << "the start is not a maximum: nothing is tested";
  const SolveReport report = newton.minimise(problem, generous());
  EXPECT_TRUE(report.converged());
  EXPECT_GT(report.regularised_iterations, 0);
  EXPECT_EQ(newton.inertia(problem), 0);
  EXPECT_LT(problem.residual(), 1.1e-6);
  for (const double y : problem.y) EXPECT_NEAR(std::abs(y), 1.0, 0.3);
}

// The answer does not depend on the proximal weight, only the way does.
// From a saddle with a proximal weight ten thousand times too large steps are short: they are lengthened while the merit falls.
// Breaks when a bent step is taken as it is: the way takes hundreds of iterations.
TEST(Newton, ALargeProximalWeightDoesNotMakeItCreep) {
  NewtonSpec spec = generous();
  spec.proximal_scale = 1e10;
  spec.max_iterations = 2000;
  QuarticChain problem(10, 1.0, -1.0, 0.01);
  test::Random random(86);
  for (double& y : problem.y) y = 1e-6 * random.normal();
  Newton newton;
  const SolveReport report = newton.minimise(problem, spec);
  EXPECT_TRUE(report.converged());
  EXPECT_LT(report.iterations, 60);
  EXPECT_LT(problem.residual(), 1e-6);
}

TEST(Newton, TheProximalWeightDoesNotShapeTheResult) {
  std::vector<std::vector<double>> results;
  for (const double scale : {0.1, 1.0, 10.0}) {
    QuarticChain problem(10, 1.0, -1.0, 0.05);
    test::Random random(84);
    for (double& y : problem.y) y = 1e-2 * random.normal();
    for (double& f : problem.f) f = 0.2;  // one of the two wells is lower: the start leans to it
    NewtonSpec spec = generous();
    spec.proximal_scale = scale;
    Newton newton;
    ASSERT_TRUE(newton.minimise(problem, spec).converged());
    results.push_back(problem.y);
  }
  for (std::size_t i = 0; i < results[0].size(); ++i) {
    EXPECT_NEAR(results[1][i], results[0][i], 1e-6);
    EXPECT_NEAR(results[2][i], results[0][i], 1e-6);
  }
}

// No joint moves further in one iteration than it may. Breaks when the trust radius is only a wish.
TEST(Newton, StepsAreLimited) {
  class Watched final : public QuarticChain {
   public:
    using QuarticChain::QuarticChain;
    void accept_step() override {
      for (std::size_t i = 0; i + 3 < y.size(); i += 4) {
        longest =
            std::max(longest, std::hypot(trial[i] - y[i], trial[i + 1] - y[i + 1], trial[i + 2] - y[i + 2]));
        widest = std::max(widest, std::abs(trial[i + 3] - y[i + 3]));
      }
      QuarticChain::accept_step();
    }
    double longest = 0.0, widest = 0.0;
  };
  Watched problem(10, 0.0, 1.0, 0.1);
  for (double& f : problem.f) f = 20.0;
  NewtonSpec spec;
  spec.max_step_mm = 2.0;
  spec.max_turn_rad = 0.5;
  spec.max_iterations = 200;
  Newton newton;
  EXPECT_TRUE(newton.minimise(problem, spec).converged());
  EXPECT_LE(problem.longest, 2.0 + 1e-9);
  EXPECT_LE(problem.widest, 0.5 + 1e-9);
  EXPECT_GT(problem.longest, 0.5);
  EXPECT_NEAR(problem.y[0], 20.0, 1e-4);
}

// Not converging is data: each way to fail has its own word.
TEST(Newton, StopsAtTheIterationLimit) {
  QuarticChain problem(10, 1.0, 0.1, 2.0);
  for (double& y : problem.y) y = 50.0;
  NewtonSpec spec = generous();
  spec.max_iterations = 3;
  Newton newton;
  const SolveReport report = newton.minimise(problem, spec);
  EXPECT_EQ(report.termination, Termination::iteration_limit);
  EXPECT_FALSE(report.converged());
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(report.correction_mm, 1e-3);
}

TEST(Newton, StallsWhenNothingDecreases) {
  class Uphill final : public QuarticChain {
   public:
    using QuarticChain::QuarticChain;
    double try_step(const std::vector<double>& d, double alpha) override {
      return QuarticChain::try_step(d, alpha) + 100.0;
    }
  };
  Uphill problem(5, 0.0, 1.0, 1.0);
  for (double& f : problem.f) f = 1.0;
  Newton newton;
  const SolveReport report = newton.minimise(problem, generous());
  EXPECT_EQ(report.termination, Termination::stalled);
  EXPECT_EQ(problem.y[0], 0.0) << "a refused step was taken";
}

TEST(Newton, LeavesTheDomain) {
  QuarticChain problem(5, 0.0, 1.0, 1.0);
  for (double& f : problem.f) f = 1.0;
  problem.region = 0.5;
  Newton newton;
  EXPECT_EQ(newton.minimise(problem, generous()).termination, Termination::left_domain);
  QuarticChain broken(5, 0.0, 1.0, 1.0);
  broken.f[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(newton.minimise(broken, generous()).termination, Termination::left_domain);
}

// An infinite trial energy is a wall for the line search, not an end. Breaks when infinity is accepted or given up on.
TEST(Newton, BacksAwayFromInfiniteEnergies) {
  class Barrier final : public QuarticChain {
   public:
    using QuarticChain::QuarticChain;
    [[nodiscard]] double energy(const std::vector<double>& at) const override {
      for (const double v : at)
        if (v > 1.05) return std::numeric_limits<double>::infinity();
      return QuarticChain::energy(at);
    }
  };
  Barrier problem(5, 1.0, 0.0, 0.0);
  for (double& f : problem.f) f = 1.0;  // minimum at y = 1
  for (double& y : problem.y) y = 0.2;  // where Newton's step leads far beyond the barrier
  NewtonSpec spec = generous();
  Newton newton;
  EXPECT_TRUE(newton.minimise(problem, spec).converged());
  for (const double y : problem.y) EXPECT_NEAR(y, 1.0, 1e-5);
}

// Forces that lag are renewed before a state counts as converged; while they are off, nothing has converged.
TEST(Newton, WaitsForLaggedQuantities) {
  QuarticChain problem(5, 1.0, 1.0, 1.0);
  for (double& f : problem.f) f = 1.0;
  problem.lag = 1.0;
  problem.lag_shrinks = 0.1;
  Newton newton;
  SolveReport report = newton.minimise(problem, generous());
  EXPECT_TRUE(report.converged());
  EXPECT_GE(problem.renewed, 3);
  EXPECT_LE(problem.lag, 2e-3);
  problem.lag = 1.0;
  problem.lag_shrinks = 1.0;
  report = newton.minimise(problem, generous());
  EXPECT_FALSE(report.converged());
}

// The same problem gives the same bits, also on a solver that has solved another one before.
TEST(Newton, HasNoMemory) {
  Newton fresh, used;
  QuarticChain other(25, 1.0, -1.0, 0.3);
  for (double& y : other.y) y = 0.1;
  other.y[3] = -0.2;
  static_cast<void>(used.minimise(other, generous()));
  std::vector<double> results[2];
  for (int k = 0; k < 2; ++k) {
    QuarticChain problem(12, 1.0, -0.5, 0.7);
    test::Random random(85);
    for (double& y : problem.y) y = random.normal();
    static_cast<void>((k == 0 ? fresh : used).minimise(problem, generous()));
    results[k] = problem.y;
  }
  EXPECT_EQ(results[0], results[1]);
}

/// A quadratic chain over one-sided springs, its contacts, at every unknown:
///
///   E = Σ (½ b yᵢ² − fᵢ yᵢ) + ½ c Σ (yᵢ − yᵢ₊₄)² + Σ ½ k ⟨−gap − yᵢ⟩²
class ChainOverFloor final : public QuarticChain {
 public:
  ChainOverFloor(int joints, double stiffness) : QuarticChain(joints, 0.0, 0.5, 3.0), k_(stiffness) {}

  double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) override {
    static_cast<void>(QuarticChain::linearise(hessian, gradient));
    for (std::size_t i = 0; i < y.size(); ++i) gradient[i] -= k_ * pressed(y[i]);
    return energy(y);
  }
  ContactPart add_contacts(const std::vector<double>& step, ContactHessian /*kind*/,
                           math::BandMatrix& hessian, std::vector<double>& gradient) override {
    ++models;
    ContactPart part;
    closed_.resize(y.size(), 0);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double before = pressed(y[i]);
      const double now = pressed(y[i] + step[i]);
      part.value_mj += 0.5 * k_ * (now * now - before * before) + k_ * before * step[i];
      gradient[i] -= k_ * (now - before);
      if (now > 0.0) hessian.lower(static_cast<int>(i), static_cast<int>(i)) += k_;
      part.changed = part.changed || (now > 0.0) != (closed_[i] != 0);
      closed_[i] = static_cast<char>(now > 0.0);
    }
    return part;
  }
  [[nodiscard]] double energy(const std::vector<double>& at) const override {
    double sum = QuarticChain::energy(at);
    for (const double v : at) sum += 0.5 * k_ * pressed(v) * pressed(v);
    return sum;
  }
  [[nodiscard]] int touching() const {
    int count = 0;
    for (const double v : y) count += pressed(v) > 0.0 ? 1 : 0;
    return count;
  }
  int models = 0;

 private:
  static constexpr double kGap_mm = 0.1;
  static double pressed(double v) { return std::max(0.0, -kGap_mm - v); }
  double k_;
  std::vector<char> closed_;
};

// The model holds the contacts exactly here, so that one iteration finds which of them close, however stiff they are.
// Breaks when contacts enter as they are at the base state: each iteration would then close or open some more.
TEST(Newton, OneIterationFindsWhatTouches) {
  for (const double stiffness : {1.0, 1e3, 1e6}) {
    ChainOverFloor problem(40, stiffness);
    test::Random random(85);
    for (double& f : problem.f) f = random.normal();
    Newton newton;
    const SolveReport report = newton.minimise(problem, generous());
    EXPECT_TRUE(report.converged()) << stiffness;
    EXPECT_EQ(report.iterations, 1) << stiffness;
    EXPECT_LE(report.factorisations, 12) << stiffness;
    EXPECT_LT(problem.residual(), 1e-9 * stiffness + 1e-9);
    EXPECT_GT(problem.touching(), 20);
    EXPECT_LT(problem.touching(), 140);
    EXPECT_NEAR(report.merit_mj, problem.energy(problem.y), 1e-9);
  }
}

/// A quadratic chain that rubs at every unknown:  E = Σ (½ b yᵢ² − fᵢ yᵢ) + ½ c Σ (yᵢ − yᵢ₊₄)² + Σ ψ(yᵢ),  ψ = min over sticking,
/// ½ k y², and sliding, L (|y| − L/2k).  What sticks and what slides changes from round to round of the model.
class RubbingChain final : public QuarticChain {
 public:
  RubbingChain(int joints, double stick_stiffness)
      : QuarticChain(joints, 0.0, 0.02, 30.0), k_(stick_stiffness) {}

  double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) override {
    static_cast<void>(QuarticChain::linearise(hessian, gradient));
    for (std::size_t i = 0; i < y.size(); ++i) gradient[i] += force(y[i]);
    return energy(y);
  }
  ContactPart add_contacts(const std::vector<double>& step, ContactHessian kind, math::BandMatrix& hessian,
                           std::vector<double>& gradient) override {
    ContactPart part;
    sticks_.resize(y.size(), 0);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double now = y[i] + step[i];
      part.value_mj += law(now) - law(y[i]) - force(y[i]) * step[i];
      gradient[i] += force(now) - force(y[i]);
      const bool sticks = k_ * std::abs(now) <= kLimit_n;
      if (sticks) hessian.lower(static_cast<int>(i), static_cast<int>(i)) += k_;
      if (!sticks && kind == ContactHessian::majorant)
        hessian.lower(static_cast<int>(i), static_cast<int>(i)) += kLimit_n / std::abs(now);
      part.changed = part.changed || sticks != (sticks_[i] != 0);
      sticks_[i] = static_cast<char>(sticks);
    }
    return part;
  }
  [[nodiscard]] double energy(const std::vector<double>& at) const override {
    double sum = QuarticChain::energy(at);
    for (const double v : at) sum += law(v);
    return sum;
  }
  [[nodiscard]] int sticking() const {
    int count = 0;
    for (const double v : y) count += k_ * std::abs(v) <= kLimit_n ? 1 : 0;
    return count;
  }

 private:
  static constexpr double kLimit_n = 0.5;
  [[nodiscard]] double force(double v) const { return std::clamp(k_ * v, -kLimit_n, kLimit_n); }
  [[nodiscard]] double law(double v) const {
    return k_ * std::abs(v) <= kLimit_n ? 0.5 * k_ * v * v : kLimit_n * (std::abs(v) - 0.5 * kLimit_n / k_);
  }
  double k_;
  std::vector<char> sticks_;
};

// Rounds of the model that do not descend may end where none of what sticks and slides changes any more and yet higher than
// they began. Breaks when such an end is taken for the minimum: the direction ascends and Newton stalls.
TEST(Newton, AModelThatRubsIsMinimisedFromAnywhere) {
  Newton newton;
  int iterations = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RubbingChain problem(30, 1e4);
    test::Random random(seed);
    for (double& f : problem.f) f = 1.2 * random.normal();
    for (double& y : problem.y) y = 5e-5 * random.normal();
    const double before = problem.energy(problem.y);
    const SolveReport report = newton.minimise(problem, generous());
    ASSERT_TRUE(report.converged()) << "seed " << seed;
    iterations += report.iterations;
    EXPECT_LT(problem.residual(), 1e-6) << "seed " << seed;
    EXPECT_LE(problem.energy(problem.y), before);
    EXPECT_GT(problem.sticking(), 0);
    EXPECT_LT(problem.sticking(), 120);
  }
  EXPECT_LT(iterations, 200 * 12);
}

/// A point pulled along the inside of a round, stiff wall:  E = −f·x + ½ k ⟨|x| − R⟩².  The Hessian is that of a spring, so that
/// a step is short against the radius; the model sees a flat wall.
class PointInARoundWall final : public Problem {
 public:
  explicit PointInARoundWall(bool corrects) : corrects_(corrects) {}
  [[nodiscard]] int unknowns() const override { return 4; }
  double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) override {
    normal_ = x_.normalized();
    depth_ = x_.norm() - kRadius_mm;
    for (int c = 0; c < 4; ++c) hessian.lower(c, c) += 10.0;
    const Eigen::Vector3d g = -kPull_n + kStiffness * std::max(0.0, depth_) * normal_;
    for (std::size_t c = 0; c < 3; ++c) gradient[c] += g[static_cast<Eigen::Index>(c)];
    return energy(x_);
  }
  ContactPart add_contacts(const std::vector<double>& step, ContactHessian /*kind*/,
                           math::BandMatrix& hessian, std::vector<double>& gradient) override {
    const Eigen::Vector3d d(step[0], step[1], step[2]);
    const double before = std::max(0.0, x_.norm() - kRadius_mm);
    const double now = std::max(0.0, depth_ + normal_.dot(d));
    for (int r = 0; r < 3; ++r) {
      gradient[static_cast<std::size_t>(r)] += kStiffness * (now - before) * normal_[r];
      if (!(now > 0.0)) continue;
      for (int c = 0; c <= r; ++c) hessian.lower(r, c) += kStiffness * normal_[r] * normal_[c];
    }
    const bool changed = (now > 0.0) != closed_;
    closed_ = now > 0.0;
    return {0.5 * kStiffness * (now * now - before * before) - kStiffness * before * normal_.dot(d), changed};
  }
  bool correct_contacts(const std::vector<double>& step) override {
    if (!corrects_) return false;
    ++corrections;
    depth_ = trial_.norm() - kRadius_mm - normal_.dot(Eigen::Vector3d(step[0], step[1], step[2]));
    return true;
  }
  double try_step(const std::vector<double>& d, double alpha) override {
    trial_ = x_ + alpha * Eigen::Vector3d(d[0], d[1], d[2]);
    return energy(trial_);
  }
  void accept_step() override { x_ = trial_; }
  [[nodiscard]] ForceScales scales() const override { return {1.0, 1.0, 0.0}; }
  [[nodiscard]] const Eigen::Vector3d& position_mm() const { return x_; }
  int corrections = 0;

 private:
  static constexpr double kRadius_mm = 2.0;
  static constexpr double kStiffness = 1e8;
  const Eigen::Vector3d kPull_n{0.0, 1.0, 0.0};
  static double energy_of(double depth) { return depth > 0.0 ? 0.5 * kStiffness * depth * depth : 0.0; }
  [[nodiscard]] double energy(const Eigen::Vector3d& at) const {
    return -kPull_n.dot(at) + energy_of(at.norm() - kRadius_mm);
  }
  Eigen::Vector3d x_{kRadius_mm, 0.0, 0.0}, trial_{0, 0, 0}, normal_{1, 0, 0};
  double depth_ = 0.0;
  bool corrects_, closed_ = false;
};

// Along a curved wall a whole step ends in the wall and raises the energy. Corrected for the gap that it found there, it is
// taken; uncorrected it is halved again and again, the effect that Maratos described.
TEST(Newton, ACorrectedStepFollowsACurvedWall) {
  NewtonSpec spec = generous();
  spec.max_iterations = 2000;
  Newton newton;
  PointInARoundWall corrected(true);
  const SolveReport report = newton.minimise(corrected, spec);
  EXPECT_TRUE(report.converged());
  EXPECT_LT((corrected.position_mm() - Eigen::Vector3d(0.0, 2.0, 0.0)).norm(), 2e-3);
  EXPECT_GT(corrected.corrections, 30);
  PointInARoundWall uncorrected(false);
  EXPECT_GT(newton.minimise(uncorrected, spec).iterations, 3 * report.iterations);
}

}  // namespace
}  // namespace endowire::solve

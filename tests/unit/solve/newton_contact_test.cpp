// Newton on problems whose contacts live in the model: what touches, what rubs, and walls that are round.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "endowire/solve/newton.hpp"
#include "support/frames.hpp"
#include "support/quartic_chain.hpp"

namespace endowire::solve {
namespace {

using test::generous;
using test::QuarticChain;

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

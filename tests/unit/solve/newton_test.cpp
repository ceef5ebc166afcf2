// Newton on small problems whose minima are known: in the band, indefinite, stubborn and broken ones.
#include "endowire/solve/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/frames.hpp"
#include "support/quartic_chain.hpp"

namespace endowire::solve {
namespace {

using test::generous;
using test::QuarticChain;

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

}  // namespace
}  // namespace endowire::solve

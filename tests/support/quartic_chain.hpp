#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "endowire/solve/newton.hpp"

namespace endowire::test {

/// A chain of unknowns y in the potential of single wells or double wells, tied to their neighbours:
///
///   E = Σ (a yᵢ⁴/4 + b yᵢ²/2 − fᵢ yᵢ) + ½c Σ (yᵢ − yᵢ₊₄)²
///
/// Convex for b ≥ 0; for b < 0 indefinite around y = 0, with minima around ±√(−b/a).
class QuarticChain : public solve::Problem {
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
  [[nodiscard]] solve::ForceScales scales() const override { return {1.0, 1.0, 0.0}; }
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

/// No limit to steps.
inline solve::NewtonSpec generous() {
  solve::NewtonSpec spec;
  spec.max_step_mm = 1e3;
  spec.max_turn_rad = 1e3;
  return spec;
}

}  // namespace endowire::test

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace endowire::test {

/// Holds a Taylor remainder r(h) against its order: r ~ hᵖ over decades of the step size.
///
/// A wrong derivative makes the slope at the smallest steps fall to the order of the wrong term, one or two below.
/// Remainders below `noise` are rounding and are left out; at least two decades have to remain, unless every one is
/// rounding already at the largest step (a function that is itself a polynomial).
/// @param first_step  the largest step; the others are a tenth, a hundredth, …
inline void expect_order(const std::function<double(double)>& remainder, double order, double noise,
                         const std::string& what, double first_step = 0.1, int decades = 4) {
  std::vector<double> log_h, log_r;
  std::string table;
  for (int k = 0; k < decades; ++k) {
    const double h = first_step * std::pow(10.0, -k);
    const double r = std::abs(remainder(h));
    table += "  h " + std::to_string(h) + ": " + std::to_string(r / std::pow(h, order)) + " h^p\n";
    ASSERT_TRUE(std::isfinite(r)) << what << ": the function is not finite at step " << h;
    if (r <= noise) break;
    log_h.push_back(std::log10(h));
    log_r.push_back(std::log10(r));
  }
  if (log_h.empty()) return;
  ASSERT_GE(log_h.size(), 2U) << what << ": too much rounding to see a slope\n" << table;
  // The slope over the last decade that rounding leaves.
  const std::size_t n = log_h.size();
  const double slope = (log_r[n - 2] - log_r[n - 1]) / (log_h[n - 2] - log_h[n - 1]);
  EXPECT_GT(slope, order - 0.2) << what << ": the remainder falls with a lower power of the step\n" << table;
}

/// Gradient and Hessian of `value` along one direction.
/// @param value      f(h) along the direction
/// @param slope      gᵀv
/// @param curvature  vᵀHv
/// @param scale      size of the terms that f is summed from: what its rounding is relative to
inline void expect_taylor(const std::function<double(double)>& value, double slope, double curvature,
                          double scale, const std::string& what, double first_step = 0.1) {
  const double f = value(0.0);
  const double noise = 2e-14 * (std::abs(f) + scale);
  expect_order([&](double h) { return value(h) - f - h * slope; }, 2.0, noise, what + ", gradient",
               first_step);
  expect_order([&](double h) { return value(h) - f - h * slope - 0.5 * h * h * curvature; }, 3.0, noise,
               what + ", Hessian", first_step);
}

}  // namespace endowire::test

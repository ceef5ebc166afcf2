#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace endowire::test {

/// Holds a Taylor remainder r(h) against its order: r(h) ≤ C hᵖ + noise over decades of the step size.
///
/// C comes from the two largest steps. A wrong derivative leaves a remainder of a lower power, which grows
/// tenfold against hᵖ with each decade: a thousandfold over the four decades, where five times C is allowed.
/// @param noise       rounding of the remainder
/// @param first_step  the largest step; the others are a tenth, a hundredth, …
inline void expect_order(const std::function<double(double)>& remainder, double order, double noise,
                         const std::string& what, double first_step = 0.1, int decades = 4) {
  double constant = 0.0;
  std::string table;
  for (int k = 0; k < decades; ++k) {
    const double h = first_step * std::pow(10.0, -k);
    const double r = std::abs(remainder(h));
    ASSERT_TRUE(std::isfinite(r)) << what << ": the function is not finite at step " << h;
    const double power = std::pow(h, order);
    table += "  h " + std::to_string(h) + ": " + std::to_string(r / power) + " h^p, rounding " +
             std::to_string(noise / power) + " h^p\n";
    if (k < 2) {
      constant = std::max(constant, r / power);
    } else {
      EXPECT_LE(r, 5.0 * constant * power + noise)
          << what << ": the remainder falls with a lower power of the step\n"
          << table;
    }
  }
}

/// Gradient and Hessian of `value` along one direction.
/// @param value      f(h) along the direction
/// @param slope      gᵀv
/// @param curvature  vᵀHv
/// @param scale      size of the terms that f is summed from: what its rounding is relative to
inline void expect_taylor(const std::function<double(double)>& value, double slope, double curvature,
                          double scale, const std::string& what, double first_step = 0.1) {
  const double f = value(0.0);
  const double noise = 1e-14 * (std::abs(f) + scale);
  expect_order([&](double h) { return value(h) - f - h * slope; }, 2.0, noise, what + ", gradient",
               first_step);
  expect_order([&](double h) { return value(h) - f - h * slope - 0.5 * h * h * curvature; }, 3.0, noise,
               what + ", Hessian", first_step);
}

}  // namespace endowire::test

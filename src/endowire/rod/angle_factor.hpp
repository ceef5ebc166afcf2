#pragma once

#include <cmath>

namespace endowire::rod {

/// φ/sin φ and its derivatives by c = cos φ.
struct AngleFactor {
  double value, first, second;
};

/// k(c) = φ/sin φ obeys (1 − c²) k' = c k − 1; near c = 1 its series in y = 1 − c has the coefficients
/// a₀ = 1, aₙ₊₁ = aₙ (n + 1)/(2n + 3), which halve at each term.
inline AngleFactor angle_factor(double c) {
  const double y = 1.0 - c;
  if (y < 0.05) {
    double value = 0.0, first = 0.0, second = 0.0, a = 1.0, power = 1.0;  // power = yⁿ⁻² from n = 2 on
    constexpr int kTerms = 14;                                            // (0.05/2)¹⁴ < 1e-22
    double y_n = 1.0, y_n1 = 0.0;
    for (int n = 0; n < kTerms; ++n) {
      value += a * y_n;
      if (n >= 1) first -= n * a * y_n1;
      if (n >= 2) {
        second += n * (n - 1) * a * power;
        power *= y;
      }
      y_n1 = y_n;
      y_n *= y;
      a *= (n + 1.0) / (2.0 * n + 3.0);
    }
    return {value, first, second};
  }
  const double s2 = (1.0 - c) * (1.0 + c);
  const double value = std::acos(c) / std::sqrt(s2);
  const double first = (c * value - 1.0) / s2;
  const double second = (value + 3.0 * c * first) / s2;
  return {value, first, second};
}

}  // namespace endowire::rod

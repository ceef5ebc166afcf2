#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

// x = quarter·π/2 + rest with |rest| ≤ π/4; π/2 in two parts, the first with 20 trailing zero bits, so that the
// product with a small whole number is exact.
constexpr double half_pi_high = 0x1.921fb544p+0;
constexpr double half_pi_low = 0x1.0b4611a626331p-34;

double rest_of(double angle_rad, int& quarter) {
  const double count = std::floor(angle_rad / (0.5 * std::numbers::pi) + 0.5);
  quarter = static_cast<int>(count - 4.0 * std::floor(0.25 * count));
  return (angle_rad - count * half_pi_high) - count * half_pi_low;
}

/// Σ (−1)ᵏ x^(2k + first) / (2k + first)!, summed from the smallest term.
double series(double x, int first) {
  double sum = 1.0;
  for (int k = 8; k >= 1; --k) {
    const double n = 2.0 * k + first;
    sum = 1.0 - sum * x * x / (n * (n - 1.0));
  }
  return first == 1 ? x * sum : sum;
}

}  // namespace

double sine(double angle_rad) {
  int quarter = 0;
  const double rest = rest_of(angle_rad, quarter);
  const double value = series(rest, quarter % 2 == 0 ? 1 : 0);
  return quarter < 2 ? value : -value;
}

double cosine(double angle_rad) {
  int quarter = 0;
  const double rest = rest_of(angle_rad, quarter);
  const double value = series(rest, quarter % 2 == 0 ? 0 : 1);
  return quarter == 0 || quarter == 3 ? value : -value;
}

Eigen::Vector3d turned(const Eigen::Vector3d& v, const Eigen::Vector3d& axis, double angle_rad) {
  const double c = cosine(angle_rad);
  const double s = sine(angle_rad);
  return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

}  // namespace endowire::vessel::anatomy

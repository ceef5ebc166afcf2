#include "endowire/rod/taper.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/base/contract.hpp"

namespace endowire::rod {

namespace {

double root_of(double value, int power) {
  switch (power) {
    case 2:
      return std::sqrt(value);
    case 4:
      return std::sqrt(std::sqrt(value));
    case -1:
      return 1.0 / value;
    default:
      return value;
  }
}

}  // namespace

Profile::Profile(const Taper& taper) : power_(taper.power) {
  ENDOWIRE_EXPECTS(power_ == 1 || power_ == 2 || power_ == 4 || power_ == -1, "a known power");
  base_ = power_ == 1 ? 0.0 : taper.base;  // a linear taper has no need of one
  sign_ = power_ != 1 && taper.at_tip_side < base_ ? -1.0 : 1.0;
  first_ = root_of(sign_ * (taper.at_tip_side - base_), power_);
  last_ = root_of(sign_ * (taper.at_hand_side - base_), power_);
  if ((power_ == 2 || power_ == 4) && sign_ * base_ < 0.0) vanishes_at_ = root_of(-sign_ * base_, power_);
}

double Profile::value_of(double root) const {
  switch (power_) {
    case 2:
      return base_ + sign_ * root * root;
    case 4:
      return base_ + sign_ * root * root * (root * root);
    case -1:
      return base_ + sign_ / root;
    default:
      return root;
  }
}

double Profile::at(double fraction) const {
  return value_of(root_at(fraction));
}

double Profile::integral(double length_mm, double first, double last) const {
  const double a = root_at(first);
  const double b = root_at(last);
  switch (power_) {
    case 2:
      return length_mm * (base_ + sign_ * (a * a + a * b + b * b) / 3.0);
    case 4: {
      const double a2 = a * a;
      const double b2 = b * b;
      return length_mm * (base_ + sign_ * (a2 * a2 + a2 * a * b + a2 * b2 + a * b * b2 + b2 * b2) / 5.0);
    }
    default:
      return length_mm * 0.5 * (a + b);
  }
}

double Profile::compliance(double length_mm, double first, double last) const {
  const double a = root_at(first);
  const double b = root_at(last);
  const double nearest = std::min(std::abs(a - vanishes_at_), std::abs(b - vanishes_at_));
  if (std::abs(b - a) < 1e-6 * nearest) return length_mm / value_of(0.5 * (a + b));
  if (power_ == 1) return length_mm * std::log1p(b / a - 1.0) / (b - a);
  if (base_ != 0.0) return compliance_by_gauss(length_mm, a, b);
  if (power_ == 2) return length_mm / (a * b);
  return length_mm * (a * a + a * b + b * b) / (3.0 * a * a * a * b * b * b);
}

/// Five points on pieces over which the distance to the root at which the rigidity vanishes changes by 3/2 at most: the wall of a tube may thin
/// away within a few micrometres of bore. Poles off the real axis are never nearer to a root r than r/√2, so each piece is right to nine digits.
double Profile::compliance_by_gauss(double length_mm, double a, double b) const {
  constexpr double kInner = 0.53846931010568309;
  constexpr double kOuter = 0.90617984593866399;
  constexpr std::array<double, 5> places{-kOuter, -kInner, 0.0, kInner, kOuter};
  constexpr double kOuterWeight = 0.23692688505618909;
  constexpr double kInnerWeight = 0.47862867049936647;
  constexpr std::array<double, 5> weights{kOuterWeight, kInnerWeight, 128.0 / 225.0, kInnerWeight,
                                          kOuterWeight};
  constexpr double kMostRatio = 1.5;
  const double ratio = (b - vanishes_at_) / (a - vanishes_at_);
  const int pieces =
      std::max(1, static_cast<int>(std::ceil(std::abs(std::log(ratio)) / std::log(kMostRatio))));
  const double grow = std::pow(ratio, 1.0 / pieces);
  double sum = 0.0;
  double from = a;
  for (int i = 0; i < pieces; ++i) {
    const double to = i + 1 == pieces ? b : vanishes_at_ + (from - vanishes_at_) * grow;
    double mean = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k)
      mean += weights[k] / value_of(0.5 * (from + to) + 0.5 * (to - from) * places[k]);
    sum += 0.5 * mean * (to - from) / (b - a);
    from = to;
  }
  return length_mm * sum;
}

}  // namespace endowire::rod

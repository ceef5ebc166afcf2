#pragma once

namespace endowire::rod {

/// A quantity along a section, from its tip side (fraction 0) to its hand side (fraction 1):
///
///   v(f) = base ± (a + (b − a) f)ᵖ
///
/// with a and b, both positive, such that v takes the two values given. p = 1 is linear. A core whose diameter grows linearly bends and twists with p = 4, stretches and
/// weighs with p = 2, kinks with p = −1, each on top of what its coat adds, which does not vary: the base.
struct Taper {
  Taper() = default;
  Taper(double value) : at_tip_side(value), at_hand_side(value) {}  ///< the same all along
  Taper(double tip_side, double hand_side, int with_power = 1, double with_base = 0.0)
      : at_tip_side(tip_side), at_hand_side(hand_side), power(with_power), base(with_base) {}

  double at_tip_side = 0.0;
  double at_hand_side = 0.0;
  int power = 1;      ///< 1, 2, 4 or −1
  double base = 0.0;  ///< below both values or above both; of no effect where p = 1

  friend bool operator==(const Taper& left, const Taper& right) = default;
};

/// A taper with its roots taken once: cheap to evaluate and to integrate.
class Profile {
 public:
  explicit Profile(const Taper& taper);

  [[nodiscard]] double at(double fraction) const;
  /// ∫ v ds over a stretch of this length between two fractions, in closed form. Not for p = −1.
  [[nodiscard]] double integral(double length_mm, double first, double last) const;
  /// ∫ ds / v: in closed form where the base is 0, else by Gauss's rule to nine digits. Not for p = −1.
  [[nodiscard]] double compliance(double length_mm, double first, double last) const;

 private:
  [[nodiscard]] double root_at(double fraction) const {
    return first_ == last_ ? first_ : first_ + (last_ - first_) * fraction;  // also where both are infinite
  }
  [[nodiscard]] double value_of(double root) const;
  [[nodiscard]] double compliance_by_gauss(double length_mm, double a, double b) const;

  double base_ = 0.0;
  double sign_ = 1.0;   ///< of what is added to the base
  double first_ = 0.0;  ///< root at the tip side
  double last_ = 0.0;
  double vanishes_at_ = 0.0;  ///< the root at which the value would be 0, as where a tube has no wall; else 0
  int power_ = 1;
};

}  // namespace endowire::rod

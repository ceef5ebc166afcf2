#pragma once

#include <vector>

namespace endowire::vessel::anatomy {

/// A local change of calibre: a stenosis or an aneurysm.
struct Lesion {
  double centre_arc_mm = 0.0;
  double length_mm = 0.0;      ///< of the whole lesion, shoulders included
  double radius_factor = 1.0;  ///< of the lumen's radius in the middle; below 1 a stenosis, above an aneurysm
};

/// How long a lesion is whose shoulders reach a slope: that of (1 - u²)³ is 96 / (25 √5) at most, at u² = 1/5.
/// @param depth_mm  what the radius in the middle is less, or more
/// @param slope     change of the radius along the axis [-]
[[nodiscard]] double lesion_length_mm(double depth_mm, double slope);

/// The lumen's radius along an axis: twice continuously differentiable, without overshoot.
///
///   r(s) = r₀ + Σᵢ (mᵢ − mᵢ₋₁) ramp(s − sᵢ; wᵢ),   ramp(x; w) = ½ (x + w σ(x / w))
///
/// Symbols  mᵢ  slope between marks i and i + 1, zero before the first and behind the last           [-]
///          σ   |u| rounded between −1 and 1: 3/8 + 3/4 u² − 1/8 u⁴, twice differentiable at ±1
///          w   half the length over which a change of slope is spread: half the nearer interval,
///              at most 12 mm                                                                       [mm]
/// At a mark the radius misses the mark's by 3/16 w Δm, which is about 1 % for the tapers of vessels.
class RadiusProfile {
 public:
  struct Mark {
    double arc_mm;
    double radius_mm;
  };
  struct Value {
    double radius_mm;
    double slope;        ///< dr/ds
    double bend_per_mm;  ///< d²r/ds²
  };

  RadiusProfile() = default;
  /// @param marks  at ascending arc lengths, at least one
  explicit RadiusProfile(std::vector<Mark> marks);
  void add(const Lesion& lesion) { lesions_.push_back(lesion); }

  [[nodiscard]] Value at(double arc_mm) const;

 private:
  struct Bend {
    double arc_mm;
    double half_width_mm;
    double slope_change;
  };
  double first_radius_mm_ = 0.0;
  std::vector<Bend> bends_;
  std::vector<Lesion> lesions_;
};

}  // namespace endowire::vessel::anatomy

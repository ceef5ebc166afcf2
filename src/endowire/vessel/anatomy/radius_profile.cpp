#include "endowire/vessel/anatomy/radius_profile.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/contract.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Value = RadiusProfile::Value;

/// Wider, calibres at marks would be missed by more than a hundredth; narrower, tapers would show edges.
constexpr double widest_bend_mm = 12.0;

/// ramp(x; w) with its derivatives: 0 before −w, x behind w.
Value ramp(double x, double w) {
  if (x <= -w) return {0.0, 0.0, 0.0};
  if (x >= w) return {x, 1.0, 0.0};
  const double u = x / w;
  return {0.5 * (x + w * (0.375 + u * u * (0.75 - 0.125 * u * u))), 0.5 * (1.0 + u * (1.5 - 0.5 * u * u)),
          0.75 * (1.0 - u * u) / w};
}

/// 1 + (f − 1) (1 − u²)³, u from −1 to 1 over the lesion: both derivatives vanish at its ends.
Value factor_of(const Lesion& lesion, double arc_mm) {
  const double half = 0.5 * lesion.length_mm;
  const double u = (arc_mm - lesion.centre_arc_mm) / half;
  if (std::abs(u) >= 1.0) return {1.0, 0.0, 0.0};
  const double v = 1.0 - u * u;
  const double depth = lesion.radius_factor - 1.0;
  return {1.0 + depth * v * v * v, depth * (-6.0 * u * v * v) / half,
          depth * (-6.0 * v * v + 24.0 * u * u * v) / (half * half)};
}

}  // namespace

double lesion_length_mm(double depth_mm, double slope) {
  return 2.0 * depth_mm / slope * 96.0 / (25.0 * std::sqrt(5.0));
}

RadiusProfile::RadiusProfile(std::vector<Mark> marks) {
  ENDOWIRE_EXPECTS(!marks.empty(), "a vessel has a calibre");
  first_radius_mm_ = marks.front().radius_mm;
  double slope_before = 0.0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const bool last = i + 1 == marks.size();
    const double before = i > 0 ? marks[i].arc_mm - marks[i - 1].arc_mm : marks.back().arc_mm;
    const double behind = last ? before : marks[i + 1].arc_mm - marks[i].arc_mm;
    const double slope = last ? 0.0 : (marks[i + 1].radius_mm - marks[i].radius_mm) / behind;
    const double nearer = i > 0 ? std::min(before, behind) : behind;
    if (slope != slope_before)
      bends_.push_back({marks[i].arc_mm, std::min(0.5 * nearer, widest_bend_mm), slope - slope_before});
    slope_before = slope;
  }
}

Value RadiusProfile::at(double arc_mm) const {
  Value value{first_radius_mm_, 0.0, 0.0};
  for (const Bend& bend : bends_) {
    const Value r = ramp(arc_mm - bend.arc_mm, bend.half_width_mm);
    value.radius_mm += bend.slope_change * r.radius_mm;
    value.slope += bend.slope_change * r.slope;
    value.bend_per_mm += bend.slope_change * r.bend_per_mm;
  }
  for (const Lesion& lesion : lesions_) {
    const Value f = factor_of(lesion, arc_mm);
    value = {value.radius_mm * f.radius_mm, value.slope * f.radius_mm + value.radius_mm * f.slope,
             value.bend_per_mm * f.radius_mm + 2.0 * value.slope * f.slope + value.radius_mm * f.bend_per_mm};
  }
  return value;
}

}  // namespace endowire::vessel::anatomy

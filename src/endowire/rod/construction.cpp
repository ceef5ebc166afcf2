#include "endowire/rod/construction.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "endowire/base/error.hpp"

namespace endowire::rod {

namespace {

double fourth(double x) {
  return x * x * (x * x);
}

double square(double x) {
  return x * x;
}

/// A sum over core and coat in the power p of the diameters, `core` and `coat` their factors: a taper of that power over a base.
Taper sum_over_section(const Construction& c, double (*power)(double), int p, double core, double coat,
                       double bore = 0.0) {
  const double base = coat * power(c.outer_diameter_mm) - (core - bore) * power(c.bore_mm);
  const auto at = [&](double diameter) { return base + (core - coat) * power(diameter); };
  const double tip = at(c.core_diameter_mm.at_tip_side);
  const double hand = at(c.core_diameter_mm.at_hand_side);
  return {tip, hand, p, base};
}

double shear_modulus(const Material& m) {
  return 0.5 * m.modulus_mpa / (1.0 + m.poisson_ratio);
}

}  // namespace

void apply(const Construction& c, const std::string& where, Section& section) {
  for (const double diameter : {c.core_diameter_mm.at_tip_side, c.core_diameter_mm.at_hand_side}) {
    if (diameter > c.bore_mm && diameter <= c.outer_diameter_mm) continue;
    std::ostringstream text;
    text << where << "core_diameter_mm is " << diameter << "; must be > " << c.bore_mm
         << " and <= " << c.outer_diameter_mm << ", between the bore and the surface";
    throw base::InputError(text.str());
  }
  constexpr double kPi = std::numbers::pi;
  const double bending = kPi / 64.0;
  section.flexural_rigidity_n_mm2 =
      sum_over_section(c, fourth, 4, bending * c.core.modulus_mpa, bending * c.coat.modulus_mpa);
  section.torsional_rigidity_n_mm2 = sum_over_section(c, fourth, 4, 2.0 * bending * shear_modulus(c.core),
                                                      2.0 * bending * shear_modulus(c.coat));
  const double area = kPi / 4.0;
  section.axial_rigidity_n =
      sum_over_section(c, square, 2, area * c.core.modulus_mpa, area * c.coat.modulus_mpa);
  section.linear_density_g_per_mm =
      sum_over_section(c, square, 2, area * c.core.density_g_per_mm3, area * c.coat.density_g_per_mm3,
                       area * kBoreFluid_g_per_mm3);
  section.radiopacity = sum_over_section(c, square, 2, c.core.attenuation / square(c.outer_diameter_mm),
                                         c.coat.attenuation / square(c.outer_diameter_mm));
  section.radius_mm = 0.5 * c.outer_diameter_mm;
  const double kink = 2.0 * c.core.strain_limit;
  section.kink_curvature_per_mm =
      Taper(kink / c.core_diameter_mm.at_tip_side, kink / c.core_diameter_mm.at_hand_side, -1);
}

double flexural_rigidity_n_mm2(const Construction& c) {
  const double d = fourth(c.core_diameter_mm.at_tip_side);
  return std::numbers::pi / 64.0 *
         (c.core.modulus_mpa * (d - fourth(c.bore_mm)) +
          c.coat.modulus_mpa * (fourth(c.outer_diameter_mm) - d));
}

double core_diameter_mm(const Construction& c, double flexural_rigidity_n_mm2) {
  const double excess = 64.0 * flexural_rigidity_n_mm2 / std::numbers::pi -
                        c.coat.modulus_mpa * fourth(c.outer_diameter_mm) +
                        c.core.modulus_mpa * fourth(c.bore_mm);
  return std::sqrt(std::sqrt(excess / (c.core.modulus_mpa - c.coat.modulus_mpa)));
}

}  // namespace endowire::rod

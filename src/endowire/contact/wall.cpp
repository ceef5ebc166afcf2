#include "endowire/contact/wall.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::contact {

namespace {

constexpr double kTangentFrom = 0.9;  // of the cap

double plane_modulus(const WallSpec& spec) {
  return spec.modulus_mpa / (1.0 - spec.poisson_ratio * spec.poisson_ratio);
}

}  // namespace

double wall_stiffness_n_per_mm2(const WallSpec& spec, double lumen_radius_mm, double wire_radius_mm) {
  const double thickness = spec.thickness_over_radius * lumen_radius_mm;
  return 2.0 * wire_radius_mm * plane_modulus(spec) *
         (1.0 / thickness + thickness / (lumen_radius_mm * lumen_radius_mm));
}

double tip_cap_stiffness_n_per_mm(const WallSpec& spec, double wire_radius_mm) {
  return 2.0 * plane_modulus(spec) * wire_radius_mm;
}

double wall_cap_mm(const WallSpec& spec, double lumen_radius_mm, double tissue_mm) {
  return std::min(
      {0.5 * spec.thickness_over_radius * lumen_radius_mm, tissue_mm / 3.0, spec.max_deflection_mm});
}

WallResponse wall_response(double stiffness_n_per_mm, double cap_mm, double depth_mm) {
  if (!(depth_mm > 0.0)) return {};
  const double last = kTangentFrom * cap_mm;
  const double x = std::min(depth_mm, last);
  // ∫ kx/(1 − x/c) dx = −k c² (x/c + ln(1 − x/c))
  const double q = 1.0 - x / cap_mm;
  WallResponse w{-stiffness_n_per_mm * cap_mm * cap_mm * (x / cap_mm + std::log1p(-x / cap_mm)),
                 stiffness_n_per_mm * x / q, stiffness_n_per_mm / (q * q)};
  if (depth_mm > last) {
    const double beyond = depth_mm - last;
    w.energy_mj += w.force_n * beyond + 0.5 * w.stiffness_n_per_mm * beyond * beyond;
    w.force_n += w.stiffness_n_per_mm * beyond;
  }
  return w;
}

double wall_depth_mm(double stiffness_n_per_mm, double cap_mm, double force_n) {
  const double linear = force_n / stiffness_n_per_mm;
  return std::min(kTangentFrom * cap_mm, linear / (1.0 + linear / cap_mm));
}

}  // namespace endowire::contact

#pragma once

namespace endowire::contact {

/// The vessel wall as an elastic layer on its surroundings.
struct WallSpec {
  double modulus_mpa = 1.0;             ///< incremental modulus, 0.01 … 1000
  double poisson_ratio = 0.45;          ///< 0 … 0.49
  double thickness_over_radius = 0.15;  ///< wall thickness / lumen radius, 0.01 … 1
  double max_deflection_mm = 0.15;      ///< hard cap, 0.01 … 0.18; see wall_cap_mm
};

/// Foundation modulus of the wall under a wire, force per length of wire and deflection [N/mm²].
///
///   k = 2 r E' (1/h + h/R²),   E' = E/(1 − ν²),  h = (thickness over radius)·R
///
/// The wire's width 2r presses on a layer that is compressed against its surroundings (E'/h, Winkler) and, being
/// a ring, stretches in hoop (E' h/R²).
/// Symbols  E modulus [MPa], ν Poisson's ratio, h wall thickness, R lumen radius, r wire radius [mm]
/// Source   Winkler layer: [Johnson1985 §4.3]; hoop term: thin ring under pressure, p = E' h w/R².
/// Domain   h of the order of r or more; local indentation only, the vessel as a whole does not move.
[[nodiscard]] double wall_stiffness_n_per_mm2(const WallSpec& spec, double lumen_radius_mm,
                                              double wire_radius_mm);

/// Stiffness of the wall under the end of the wire [N/mm]: a flat punch of radius r on a half space, 2 E' r.
/// Source   [Johnson1985 §3.8]
[[nodiscard]] double tip_cap_stiffness_n_per_mm(const WallSpec& spec, double wire_radius_mm);

/// Hard cap of the deflection: min(½ wall thickness, ⅓ of the tissue to another lumen, max_deflection_mm) [mm].
[[nodiscard]] double wall_cap_mm(const WallSpec& spec, double lumen_radius_mm, double tissue_mm);

/// Energy of the wall at one sample, with its first two derivatives by the depth.
struct WallResponse {
  double energy_mj = 0.0;
  double force_n = 0.0;
  double stiffness_n_per_mm = 0.0;
};

/// Response of the wall to a depth (> 0 into the wall).
///
///   F = k δ/(1 − δ/c)
///
/// Linear with stiffness k, stiffening to the cap c; from 0.9 c on continued by its tangent, which is 100 k, so that
/// the energy is defined for every trial state. Its stiffness jumps at δ = 0, and convexity is what Newton needs there.
[[nodiscard]] WallResponse wall_response(double stiffness_n_per_mm, double cap_mm, double depth_mm);

/// The depth at which the wall pushes back with a force >= 0, within the law's own range.
[[nodiscard]] double wall_depth_mm(double stiffness_n_per_mm, double cap_mm, double force_n);

}  // namespace endowire::contact

#pragma once

#include <string>

#include "endowire/rod/instrument.hpp"

namespace endowire::rod {

/// What a core or a coat is made of.
struct Material {
  double modulus_mpa = 0.0;        ///< E; 0: carries nothing along the wire, as a coil
  double poisson_ratio = 0.3;      ///< ν; the shear modulus is E/2(1 + ν)
  double density_g_per_mm3 = 0.0;  ///< mean over the space it takes
  double strain_limit = std::numeric_limits<double>::infinity();  ///< at its surface, where the wire kinks
  double attenuation = 0.0;  ///< of X-rays, linear, relative to stainless steel
};

/// A round core, solid or with a bore, in a coat that reaches from it to the surface: how most guidewires and many microcatheters are built.
///
///   EI = π/64 (E_k (d⁴ − b⁴) + E_m (D⁴ − d⁴))      GJ = π/32 (G_k (d⁴ − b⁴) + G_m (D⁴ − d⁴))
///   EA = π/4 (E_k (d² − b²) + E_m (D² − d²))       mass per length likewise with the densities; the bore is full of fluid
///   κ_m = 2 ε/d                                     the strain limit ε reached at the surface of the core
///   radiopacity = (μ_k (d² − b²) + μ_m (D² − d²))/D²
///
/// d is linear along the section: rigidities follow its fourth power, not a straight line between their ends.
/// Symbols  d, D, b  diameters of core, surface and bore [mm];  k core, m coat;  μ attenuation relative to steel
struct Construction {
  Taper core_diameter_mm;          ///< linear
  double bore_mm = 0.0;            ///< diameter
  double outer_diameter_mm = 0.0;  ///< the same all along
  Material core;
  Material coat;
};

/// Density of what fills a bore: saline or blood.
inline constexpr double kBoreFluid_g_per_mm3 = 1.0e-3;

/// Sets what follows from how a section is built: rigidities, mass, radius, kink curvature and radiopacity.
/// @throws base::InputError  `where` + the field, its value and range: b < d ≤ D at both ends
void apply(const Construction& construction, const std::string& where, Section& section);

/// EI at the tip side.
[[nodiscard]] double flexural_rigidity_n_mm2(const Construction& construction);

/// The core diameter that gives this EI, the rest of the construction as it is.
[[nodiscard]] double core_diameter_mm(const Construction& construction, double flexural_rigidity_n_mm2);

}  // namespace endowire::rod

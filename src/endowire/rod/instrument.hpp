#pragma once

#include <limits>
#include <string>
#include <vector>

#include "endowire/rod/taper.hpp"

namespace endowire::rod {

/// A stretch of an instrument with one construction. Units are in the names; all along the material arc.
struct Section {
  double length_mm = 0.0;         ///< > 0
  Taper flexural_rigidity_n_mm2;  ///< EI₁, towards the first director, > 0
  double flexural_ratio =
      1.0;  ///< EI₂/EI₁ of a section that is not round: below 1, it is soft towards the second director
  Taper torsional_rigidity_n_mm2;      ///< GJ, > 0
  Taper axial_rigidity_n;              ///< EA, > 0
  Taper radius_mm;                     ///< outer radius, > 0
  Taper linear_density_g_per_mm;       ///< mass per length in air, a bore full; >= 0
  double friction = 0.0;               ///< Coulomb coefficient against the wall, 0 … 2
  double rest_curvature_per_mm = 0.0;  ///< κ0 of the unloaded shape; 0 is straight
  double rest_plane_rad = 0.0;  ///< direction of the rest curvature in the section plane, at the tip side
  double rest_torsion_per_mm = 0.0;  ///< turn of that direction per length towards the hand: a helix
  Taper kink_curvature_per_mm = std::numeric_limits<double>::infinity();  ///< κ_m, > 0
  Taper radiopacity =
      1.0;  ///< X-ray attenuation, mean over the cross-section, relative to stainless steel; >= 0
};

/// A guidewire or catheter as data: what a file of `instruments/` holds.
struct Instrument {
  std::string model;              ///< generic name, e.g. "hydrophilic_035_angled"
  std::vector<Section> sections;  ///< from the tip to the hand, at least one
  double grip_force_n = 2.0;      ///< F_max: push at which the wire slips in the hand, > 0
  double grip_torque_n_mm = 2.0;  ///< torque at which it slips, > 0
  double shapeable_mm = 0.0;      ///< length from the tip that the user may bend; 0: none

  [[nodiscard]] double length_mm() const;
  /// @throws base::InputError naming the section, the field, its value and the allowed range.
  void validate(const std::string& where) const;
};

}  // namespace endowire::rod

#pragma once

#include <numbers>

#include "support/wires.hpp"

namespace endowire::test {

/// A coronary wire: 0.014" thick, soft, the last 5 mm bent by 45°.
inline rod::Instrument thin_wire() {
  rod::Instrument wire = uniform_wire(0.8, 0.6, 5.0);
  rod::Section& tip = wire.sections[0];
  tip.radius_mm = {0.178, 0.178};
  tip.axial_rigidity_n = {800.0, 800.0};
  tip.linear_density_g_per_mm = 5e-4;
  tip.friction = 0.05;
  tip.rest_curvature_per_mm = 0.25 * std::numbers::pi / tip.length_mm;
  rod::Section shaft = tip;
  shaft.length_mm = 600.0;
  shaft.rest_curvature_per_mm = 0.0;
  shaft.flexural_rigidity_n_mm2 = {0.8, 8.0};
  shaft.torsional_rigidity_n_mm2 = {0.6, 6.0};
  wire.sections.push_back(shaft);
  return wire;
}

}  // namespace endowire::test

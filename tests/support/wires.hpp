#pragma once

#include <array>
#include <cmath>

#include "endowire/rod/instrument.hpp"

namespace endowire::test {

/// One uniform, straight, weightless section: the wire of closed forms.
inline rod::Instrument uniform_wire(double flexural_n_mm2, double torsional_n_mm2, double length_mm) {
  rod::Section section;
  section.length_mm = length_mm;
  section.flexural_rigidity_n_mm2 = {flexural_n_mm2, flexural_n_mm2};
  section.torsional_rigidity_n_mm2 = {torsional_n_mm2, torsional_n_mm2};
  section.axial_rigidity_n = {2000.0, 2000.0};
  section.radius_mm = {0.4445, 0.4445};
  rod::Instrument wire;
  wire.model = "uniform";
  wire.sections = {section};
  return wire;
}

/// A soft wire of 300 mm with a curved tip of 10 mm, a taper and friction: everything that one simulation uses.
inline rod::Instrument curved_tip_wire(double friction = 0.05) {
  rod::Section tip;
  tip.length_mm = 10.0;
  tip.flexural_rigidity_n_mm2 = {6.0, 6.0};
  tip.torsional_rigidity_n_mm2 = {4.6, 4.6};
  tip.axial_rigidity_n = {1900.0, 1900.0};
  tip.radius_mm = {0.4445, 0.4445};
  tip.linear_density_g_per_mm = 1.4e-3;
  tip.friction = friction;
  tip.rest_curvature_per_mm = 0.05;
  tip.kink_curvature_per_mm = 0.7;
  rod::Section shaft = tip;
  shaft.length_mm = 490.0;
  shaft.flexural_rigidity_n_mm2 = {6.0, 60.0};
  shaft.torsional_rigidity_n_mm2 = {4.6, 46.0};
  shaft.rest_curvature_per_mm = 0.0;
  rod::Instrument wire;
  wire.model = "curved_tip";
  wire.sections = {tip, shaft};
  return wire;
}

/// The wire of instruments/hydrophilic_035_angled.toml, whose sources stand there; this layer reads no files.
inline rod::Instrument hydrophilic_035_angled() {
  struct Row {
    double length, ei_tip, ei_hand, gj_tip, gj_hand, ea_tip, ea_hand, density, curvature, kink;
  };
  constexpr std::array<Row, 7> rows{{
      {10.0, 6.0, 6.0, 4.615, 4.615, 1902.0, 1902.0, 1.42e-3, 0.08727, 0.712},
      {20.0, 6.0, 6.0, 4.615, 4.615, 1902.0, 1902.0, 1.42e-3, 0.0, 0.712},
      {50.0, 6.0, 27.59, 4.615, 21.22, 1902.0, 4079.0, 1.52e-3, 0.0, 0.486},
      {50.0, 27.59, 83.03, 21.22, 63.87, 4079.0, 7077.0, 1.76e-3, 0.0, 0.369},
      {50.0, 83.03, 196.8, 63.87, 151.4, 7077.0, 10900.0, 2.07e-3, 0.0, 0.298},
      {50.0, 196.8, 400.0, 151.4, 307.7, 10900.0, 15530.0, 2.47e-3, 0.0, 0.249},
      {1570.0, 400.0, 400.0, 307.7, 307.7, 15530.0, 15530.0, 2.68e-3, 0.0, 0.249},
  }};
  rod::Instrument wire;
  wire.model = "hydrophilic_035_angled";
  for (const Row& row : rows) {
    rod::Section s;
    s.length_mm = row.length;
    s.flexural_rigidity_n_mm2 = {row.ei_tip, row.ei_hand};
    s.torsional_rigidity_n_mm2 = {row.gj_tip, row.gj_hand};
    s.axial_rigidity_n = {row.ea_tip, row.ea_hand};
    s.radius_mm = {0.4445, 0.4445};
    s.linear_density_g_per_mm = row.density;
    s.friction = 0.05;
    s.rest_curvature_per_mm = row.curvature;
    s.kink_curvature_per_mm = row.kink;
    wire.sections.push_back(s);
  }
  return wire;
}

}  // namespace endowire::test

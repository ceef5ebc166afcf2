#include "endowire/io/instrument_json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace endowire::io {

using nlohmann::json;

namespace {

json finite_or_null(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

double of_finite_or_null(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

/// [tip, hand], and for what is not linear also power and base.
json taper_json(const rod::Taper& taper) {
  json value = json::array({finite_or_null(taper.at_tip_side), finite_or_null(taper.at_hand_side)});
  if (taper.power != 1) {
    value.push_back(taper.power);
    value.push_back(taper.base);
  }
  return value;
}

/// Recordings of earlier versions hold numbers where there are tapers now.
rod::Taper taper_of(const json& value) {
  if (!value.is_array()) return of_finite_or_null(value);
  rod::Taper taper(of_finite_or_null(value.at(0)), of_finite_or_null(value.at(1)));
  if (value.size() > 2) {
    taper.power = value.at(2).get<int>();
    taper.base = value.at(3).get<double>();
  }
  return taper;
}

}  // namespace

json to_json(const rod::Instrument& instrument) {
  json sections = json::array();
  for (const rod::Section& section : instrument.sections) {
    sections.push_back({{"length_mm", section.length_mm},
                        {"flexural_rigidity_n_mm2", taper_json(section.flexural_rigidity_n_mm2)},
                        {"flexural_ratio", section.flexural_ratio},
                        {"torsional_rigidity_n_mm2", taper_json(section.torsional_rigidity_n_mm2)},
                        {"axial_rigidity_n", taper_json(section.axial_rigidity_n)},
                        {"radius_mm", taper_json(section.radius_mm)},
                        {"linear_density_g_per_mm", taper_json(section.linear_density_g_per_mm)},
                        {"friction", section.friction},
                        {"rest_curvature_per_mm", section.rest_curvature_per_mm},
                        {"rest_plane_rad", section.rest_plane_rad},
                        {"rest_torsion_per_mm", section.rest_torsion_per_mm},
                        {"kink_curvature_per_mm", taper_json(section.kink_curvature_per_mm)},
                        {"radiopacity", taper_json(section.radiopacity)}});
  }
  return {{"model", instrument.model},
          {"grip_force_n", instrument.grip_force_n},
          {"grip_torque_n_mm", instrument.grip_torque_n_mm},
          {"shapeable_mm", instrument.shapeable_mm},
          {"sections", std::move(sections)}};
}

rod::Instrument instrument_from_json(const json& value) {
  rod::Instrument instrument;
  instrument.model = value.at("model").get<std::string>();
  instrument.grip_force_n = value.at("grip_force_n").get<double>();
  instrument.grip_torque_n_mm = value.at("grip_torque_n_mm").get<double>();
  instrument.shapeable_mm = value.value("shapeable_mm", 0.0);
  for (const json& item : value.at("sections")) {
    rod::Section section;
    section.length_mm = item.at("length_mm").get<double>();
    section.flexural_rigidity_n_mm2 = taper_of(item.at("flexural_rigidity_n_mm2"));
    section.flexural_ratio = item.value("flexural_ratio", 1.0);
    section.torsional_rigidity_n_mm2 = taper_of(item.at("torsional_rigidity_n_mm2"));
    section.axial_rigidity_n = taper_of(item.at("axial_rigidity_n"));
    section.radius_mm = taper_of(item.at("radius_mm"));
    section.linear_density_g_per_mm = taper_of(item.at("linear_density_g_per_mm"));
    section.friction = item.at("friction").get<double>();
    section.rest_curvature_per_mm = item.at("rest_curvature_per_mm").get<double>();
    section.rest_plane_rad = item.at("rest_plane_rad").get<double>();
    section.rest_torsion_per_mm = item.value("rest_torsion_per_mm", 0.0);
    section.kink_curvature_per_mm = taper_of(item.at("kink_curvature_per_mm"));
    section.radiopacity = taper_of(item.at("radiopacity"));
    instrument.sections.push_back(section);
  }
  return instrument;
}

}  // namespace endowire::io

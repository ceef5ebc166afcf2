#include "endowire/io/instrument_json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace endowire::io {

using nlohmann::json;

namespace {

json taper_json(const rod::Taper& taper) {
  return json::array({taper.at_tip_side, taper.at_hand_side});
}

rod::Taper taper_of(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>()};
}

json finite_or_null(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

}  // namespace

json to_json(const rod::Instrument& instrument) {
  json sections = json::array();
  for (const rod::Section& section : instrument.sections) {
    sections.push_back({{"length_mm", section.length_mm},
                        {"flexural_rigidity_n_mm2", taper_json(section.flexural_rigidity_n_mm2)},
                        {"torsional_rigidity_n_mm2", taper_json(section.torsional_rigidity_n_mm2)},
                        {"axial_rigidity_n", taper_json(section.axial_rigidity_n)},
                        {"radius_mm", taper_json(section.radius_mm)},
                        {"linear_density_g_per_mm", section.linear_density_g_per_mm},
                        {"friction", section.friction},
                        {"rest_curvature_per_mm", section.rest_curvature_per_mm},
                        {"rest_plane_rad", section.rest_plane_rad},
                        {"kink_curvature_per_mm", finite_or_null(section.kink_curvature_per_mm)},
                        {"radiopacity", section.radiopacity}});
  }
  return {{"model", instrument.model},
          {"grip_force_n", instrument.grip_force_n},
          {"grip_torque_n_mm", instrument.grip_torque_n_mm},
          {"sections", std::move(sections)}};
}

rod::Instrument instrument_from_json(const json& value) {
  rod::Instrument instrument;
  instrument.model = value.at("model").get<std::string>();
  instrument.grip_force_n = value.at("grip_force_n").get<double>();
  instrument.grip_torque_n_mm = value.at("grip_torque_n_mm").get<double>();
  for (const json& item : value.at("sections")) {
    rod::Section section;
    section.length_mm = item.at("length_mm").get<double>();
    section.flexural_rigidity_n_mm2 = taper_of(item.at("flexural_rigidity_n_mm2"));
    section.torsional_rigidity_n_mm2 = taper_of(item.at("torsional_rigidity_n_mm2"));
    section.axial_rigidity_n = taper_of(item.at("axial_rigidity_n"));
    section.radius_mm = taper_of(item.at("radius_mm"));
    section.linear_density_g_per_mm = item.at("linear_density_g_per_mm").get<double>();
    section.friction = item.at("friction").get<double>();
    section.rest_curvature_per_mm = item.at("rest_curvature_per_mm").get<double>();
    section.rest_plane_rad = item.at("rest_plane_rad").get<double>();
    const json& kink = item.at("kink_curvature_per_mm");
    section.kink_curvature_per_mm =
        kink.is_null() ? std::numeric_limits<double>::infinity() : kink.get<double>();
    section.radiopacity = item.at("radiopacity").get<double>();
    instrument.sections.push_back(section);
  }
  return instrument;
}

}  // namespace endowire::io

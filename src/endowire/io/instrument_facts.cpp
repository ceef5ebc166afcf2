#include "endowire/io/instrument_facts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "endowire/io/instrument_json.hpp"
#include "endowire/rod/rest_shape.hpp"

namespace endowire::io {

using nlohmann::json;

namespace {

constexpr int json_samples = 200;  // of a profile: drawn on a screen, none is missed
constexpr double shape_spacing_mm = 0.25;
constexpr double least_end_mm = 40.0;  // of a straight wire, to have something to draw

}  // namespace

InstrumentFacts facts_of(const rod::MaterialLine& line) {
  InstrumentFacts facts;
  for (const rod::Section& section : line.instrument().sections)
    facts.diameter_mm = std::max(
        {facts.diameter_mm, 2.0 * section.radius_mm.at_tip_side, 2.0 * section.radius_mm.at_hand_side});
  facts.length_mm = line.length_mm();
  facts.tip_rigidity_n_mm2 = line.flexural_rigidity_n_mm2(0.0);
  facts.shaft_rigidity_n_mm2 = line.flexural_rigidity_n_mm2(line.length_mm());
  return facts;
}

std::vector<double> profile_arcs_mm(const rod::MaterialLine& line, int count) {
  std::vector<double> arcs(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    arcs[static_cast<std::size_t>(i)] = line.length_mm() * part * part;
  }
  return arcs;
}

std::vector<Eigen::Vector3d> unloaded_end_mm(const rod::MaterialLine& line) {
  const double curved = std::min(line.curved_to_mm(), line.length_mm());
  const double end = std::min(std::max(1.5 * curved, least_end_mm), line.length_mm());
  return rod::unloaded_joints_mm(line, end, shape_spacing_mm);
}

json facts_json(const InstrumentFile& file) {
  const InstrumentFacts facts = facts_of(rod::MaterialLine(file.instrument));
  return {{"model", file.instrument.model},
          {"description", file.description},
          {"file", file.path},
          {"diameter_mm", facts.diameter_mm},
          {"length_mm", facts.length_mm},
          {"tip_flexural_rigidity_n_mm2", facts.tip_rigidity_n_mm2},
          {"shaft_flexural_rigidity_n_mm2", facts.shaft_rigidity_n_mm2},
          {"shapeable_mm", file.instrument.shapeable_mm}};
}

json details_json(const InstrumentFile& file) {
  const rod::MaterialLine line(file.instrument);
  json details = facts_json(file);
  details["instrument"] = to_json(file.instrument);
  json& values = details["values"] = json::array();
  for (const SourcedValue& value : file.values)
    values.push_back({{"field", value.field}, {"value", value.value}, {"source", value.source}});
  json& profile = details["profile"] = json::array();
  for (const double arc : profile_arcs_mm(line, json_samples)) {
    const Eigen::Vector2d bending = line.flexural_rigidities_n_mm2(arc);
    profile.push_back({{"arc_mm", arc},
                       {"flexural_rigidities_n_mm2", {bending[0], bending[1]}},
                       {"torsional_rigidity_n_mm2", line.torsional_rigidity_n_mm2(arc)},
                       {"radius_mm", line.radius_mm(arc)},
                       {"linear_density_g_per_mm", line.linear_density_g_per_mm(arc)},
                       {"friction", line.friction(arc)},
                       {"radiopacity", line.radiopacity(arc)}});
  }
  json& shape = details["unloaded_end_mm"] = json::array();
  for (const Eigen::Vector3d& p : unloaded_end_mm(line)) shape.push_back({p.x(), p.y(), p.z()});
  return details;
}

}  // namespace endowire::io

#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "endowire/io/instrument_file.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::io {

/// What tells instruments apart at a glance.
struct InstrumentFacts {
  double diameter_mm = 0.0;  ///< the largest
  double length_mm = 0.0;
  double tip_rigidity_n_mm2 = 0.0;    ///< EI at the tip
  double shaft_rigidity_n_mm2 = 0.0;  ///< EI at the hand
};
[[nodiscard]] InstrumentFacts facts_of(const rod::MaterialLine& line);

/// Arcs from tip to hand at which to draw a profile: close together at the tip, where an instrument changes most.
/// @param count  of them, at least 2
[[nodiscard]] std::vector<double> profile_arcs_mm(const rod::MaterialLine& line, int count);

/// The unloaded end of an instrument: what is curved of it and some straight behind, as unloaded_joints_mm().
[[nodiscard]] std::vector<Eigen::Vector3d> unloaded_end_mm(const rod::MaterialLine& line);

/// One line of the library.
[[nodiscard]] nlohmann::json facts_json(const InstrumentFile& file);

/// Everything about an instrument: facts, sections, profiles along the arc, unloaded shape, every value with its source.
[[nodiscard]] nlohmann::json details_json(const InstrumentFile& file);

}  // namespace endowire::io

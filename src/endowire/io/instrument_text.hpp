#pragma once

#include <string>
#include <vector>

#include "endowire/io/instrument_file.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::io {

/// Bending stiffness over the distance from the tip, in characters: logarithmic upwards, closer together at the tip to the right.
[[nodiscard]] std::string profile_text(const rod::MaterialLine& line);

/// The unloaded end in characters, true to scale; the hand is on the left.
[[nodiscard]] std::string shape_text(const rod::MaterialLine& line);

/// The sections as a table, a line each.
[[nodiscard]] std::string sections_text(const rod::MaterialLine& line);

/// Every value of a file with its source, a line each.
[[nodiscard]] std::string values_text(const InstrumentFile& file);

/// The library as a table, a line for an instrument.
[[nodiscard]] std::string library_text(const std::vector<InstrumentFile>& files);

}  // namespace endowire::io

#pragma once

#include <string>

#include "endowire/rod/material_line.hpp"

namespace endowire::io {

/// Bending stiffness over the distance from the tip, in characters: logarithmic upwards, closer together at the tip to the right.
[[nodiscard]] std::string profile_text(const rod::MaterialLine& line);

/// The unloaded end in characters, true to scale; the hand is on the left.
[[nodiscard]] std::string shape_text(const rod::MaterialLine& line);

/// The sections as a table, a line each.
[[nodiscard]] std::string sections_text(const rod::MaterialLine& line);

}  // namespace endowire::io

#pragma once

#include <vector>

#include "endowire/rod/material_line.hpp"

namespace endowire::sim {

/// Material arcs [mm] of all joints of a wire, tip first, from 0 to its end: rods of `rod_length_mm`, shorter
/// where the unloaded wire would turn by more than `max_bias_rad` at one joint.
[[nodiscard]] std::vector<double> uniform_grid(const rod::MaterialLine& line, double rod_length_mm,
                                               double max_bias_rad);

}  // namespace endowire::sim

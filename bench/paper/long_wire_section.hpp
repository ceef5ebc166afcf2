#pragma once

#include "section.hpp"

namespace endowire::paper {

/// 260 cm of wire: how the time of a step grows with the rods.
[[nodiscard]] Section long_wire_section();

}  // namespace endowire::paper

#pragma once

#include <string>

#include "procedures.hpp"
#include "section.hpp"

namespace endowire::paper {

/// Bends of every curvature and calibre, each passed by wires of fixed rods of several lengths and by one of adapted rods.
[[nodiscard]] Section bends_section();

/// The line of its table for one bend.
[[nodiscard]] std::string bend_row(const Bend& bend);

}  // namespace endowire::paper

#pragma once

#include "compared.hpp"
#include "section.hpp"

namespace endowire::paper {

/// Whole procedures on fixed and on adapted rods: how many rods what accuracy takes, and which branch the tip ends in.
[[nodiscard]] Section rods_section(const std::vector<Compared>& all);

}  // namespace endowire::paper

#pragma once

#include "compared.hpp"
#include "section.hpp"

namespace endowire::paper {

/// Wide, tortuous, narrow and branching vessels: whether every step is solved and no wall crossed, and at what price.
/// @param real  runs in real vessels; may be none
[[nodiscard]] Section vessels_section(const std::vector<Compared>& generated, const std::vector<Case>& real);

}  // namespace endowire::paper

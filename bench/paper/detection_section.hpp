#pragma once

#include "compared.hpp"
#include "section.hpp"

namespace endowire::paper {

/// Gaps that follow the wire after one detection, against detection in every iteration, and against one detection that is never checked.
[[nodiscard]] Section detection_section(const std::vector<Case>& cases);

}  // namespace endowire::paper

#pragma once

#include "compared.hpp"
#include "section.hpp"

namespace endowire::paper {

/// What the largest turn at a joint and the bias angles do to shape, force and outcome.
/// @param compared  the cases to try it in, with their references
[[nodiscard]] Section sensitivity_section(const std::vector<const Compared*>& compared);

}  // namespace endowire::paper

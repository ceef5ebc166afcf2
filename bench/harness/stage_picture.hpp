#pragma once

#include <string>

#include "harness/measure.hpp"

namespace endowire::bench {

/// Step time over the travel of the hand as SVG, stacked by stage; steps with a snap as ticks, the inserted length and Newton's
/// iterations below, the shares of the stages in the legend. Colours are told apart by people who do not see red or green.
[[nodiscard]] std::string stage_picture_svg(const Measured& measured);

}  // namespace endowire::bench

#pragma once

#include <span>
#include <string>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// The aortic root with the coronary arteries of a right-dominant heart: left main, anterior descending with a
/// diagonal, circumflex with a marginal branch; right coronary with its posterior descending and posterolateral
/// branches. The access is in the ostium of the left main, or of the right coronary, where a guiding catheter ends.
///
/// Frame  x to the left, y to the back, z to the head; the middle of the heart's base lies at the origin.
[[nodiscard]] Plan coronary(const Values& values);

[[nodiscard]] std::span<const Parameter> coronary_parameters();

/// What is impossible about these numbers together: a message without its beginning; empty when nothing is.
[[nodiscard]] std::string coronary_conflict(const Values& values);

}  // namespace endowire::vessel::anatomy

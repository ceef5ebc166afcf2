#pragma once

#include <span>
#include <string>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// The infrarenal aorta, the iliac arteries and both groins with the beginnings of the superficial and deep
/// femoral arteries: for crossing from one side to the other. The access is in the right common femoral artery.
///
/// Frame  x to the left, y to the back, z to the head; the aortic bifurcation lies at the origin.
[[nodiscard]] Plan iliofemoral(const Values& values);

[[nodiscard]] std::span<const Parameter> iliofemoral_parameters();

/// What is impossible about these numbers together: a message without its beginning; empty when nothing is.
[[nodiscard]] std::string iliofemoral_conflict(const Values& values);

}  // namespace endowire::vessel::anatomy

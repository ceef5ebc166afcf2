#pragma once

#include <span>
#include <string>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// The abdominal aorta from above the renal arteries to both groins, with the renal arteries up to their division
/// in front of the kidneys. The access is in the right external iliac artery.
///
/// Frame  x to the left, y to the back, z to the head; the aortic bifurcation lies at the origin.
[[nodiscard]] Plan renal(const Values& values);

[[nodiscard]] std::span<const Parameter> renal_parameters();

/// What is impossible about these numbers together: a message without its beginning; empty when nothing is.
[[nodiscard]] std::string renal_conflict(const Values& values);

}  // namespace endowire::vessel::anatomy

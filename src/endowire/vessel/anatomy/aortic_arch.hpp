#pragma once

#include <span>
#include <string>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// Everything a wire passes between the right groin and the neck: iliac arteries, aorta, arch, the vessels of
/// the arch and the carotids up to the skull.
///
///                        left carotid
///      right carotid  │  │
///                     │  │      left subclavian
///   right subclavian  └╮ │ ╭─────
///         ─────────────┤ │ │
///       brachiocephalic│ │ │
///          trunk     ╭─┴─┴─┴─╮
///                    │ ╭───╮ │   arch: half a circle in an upright plane, φ from its top,
///       ascending    │ │   │ │   negative on the ascending side
///                   root   │ │
///                          │ │   descending
///
/// Frame  x to the left, y to the back, z to the head; the aortic bifurcation lies at the origin.
[[nodiscard]] Plan aortic_arch(const Values& values);

[[nodiscard]] std::span<const Parameter> aortic_arch_parameters();

/// In arches of type II and III the branches run to the head all the same, so that their angles with the arch
/// are smaller: by 10° a type, within their ranges, for angles that are not given.
void adjust_aortic_arch(Values& values, const Settings& given);

/// What is impossible about these numbers together: a message without its beginning; empty when nothing is.
[[nodiscard]] std::string aortic_arch_conflict(const Values& values);

}  // namespace endowire::vessel::anatomy

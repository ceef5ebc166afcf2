#pragma once

#include <span>
#include <string>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// A left internal carotid artery from the neck through the skull base and the siphon to the middle and anterior
/// cerebral arteries, with the ophthalmic artery. The access is in the neck.
///
///              ╭── middle cerebral
///       ╭──────┤      supraclinoid        front ←
///       │ ophthalmic
///       ╰──────╮      cavernous, between anterior and posterior bend
///              ╰──────╮ petrous
///                     │ cervical
///
/// Frame  x to the left, y to the back, z to the head; the access lies near the origin's height.
[[nodiscard]] Plan carotid_siphon(const Values& values);

[[nodiscard]] std::span<const Parameter> carotid_siphon_parameters();

/// What is impossible about these numbers together: a message without its beginning; empty when nothing is.
[[nodiscard]] std::string carotid_siphon_conflict(const Values& values);

}  // namespace endowire::vessel::anatomy

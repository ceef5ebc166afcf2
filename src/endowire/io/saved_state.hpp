#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "endowire/sim/event_watch.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/sim/state.hpp"

namespace endowire::io {

/// All that a steered wire remembers between two steps.
struct SavedState {
  std::optional<std::uint64_t> seed;  ///< of the variant of its scene; none: the scene as written
  sim::State state;
  sim::EventMemory events;  ///< those under way
  sim::Snapshot last;       ///< of the last step: a state that is put back has no forces of its own
};

/// The bytes of a wire between two steps, with every bit of its numbers, under a header that tells damage.
/// @param scene_key  of what the state belongs to: scene, instrument and vessel
[[nodiscard]] std::string pack_state(const SavedState& saved, std::uint64_t scene_key);

/// Reads what pack_state wrote. Whether the numbers make a wire is for Simulation::restore and EventWatch::restore to say.
/// @param label  begins messages
/// @throws base::InputError for other bytes, of any length: cut, damaged, of another scene or version, with a place or force that is
///                          not finite, or forces of another shape. Takes no more memory than a few times the bytes.
[[nodiscard]] SavedState unpack_state(const std::string& bytes, std::uint64_t scene_key,
                                      const std::string& label);

}  // namespace endowire::io

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "endowire/io/recording.hpp"
#include "endowire/io/scene_file.hpp"

namespace endowire::io {

/// The scene that a recording was made of, ready to be played again: all of it stands in the recording but the
/// vessel's mesh, which is found by its content.
///
/// The mesh is looked for where it was, seen from the present folder; where it was, seen from the recording; and
/// beside the recording. Generated vessels need no file; check_recorded_vessel tells whether they are the same.
/// @param recording_path  for the search, and for messages
/// @param vessel_file     where the mesh lies now; empty: look for it
/// @throws base::InputError one line: no file with the recorded content (which name and hash it has), or a scene or
///                          instrument in the header that is no sound one
[[nodiscard]] SceneFile recorded_scene(const RecordingHeader& header,
                                       const std::filesystem::path& recording_path,
                                       const std::filesystem::path& vessel_file = {});

/// Whether the vessel that was read or generated is the recorded one: a generator of another version may make another.
/// @throws base::InputError one line with both contents when it is not
void check_recorded_vessel(const RecordingHeader& header, const std::filesystem::path& recording_path,
                           std::uint64_t content_hash);

/// The recorded commands as they are played.
[[nodiscard]] std::vector<TimedCommand> recorded_commands(const Recording& recording);

}  // namespace endowire::io

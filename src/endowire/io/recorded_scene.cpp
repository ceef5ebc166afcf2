#include "endowire/io/recorded_scene.hpp"

#include <fmt/format.h>

#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/vessel_file.hpp"

namespace endowire::io {

namespace fs = std::filesystem;
using base::InputError;

namespace {

/// A file, or the folder of a DICOM series.
bool is_vessel(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) || (!path.empty() && fs::is_directory(path, error));
}

[[noreturn]] void refuse_content(std::uint64_t content, const RecordingHeader& header,
                                 const fs::path& recording, const std::string& vessel) {
  throw InputError(fmt::format("{}: vessel {} has content {}; must be {}, as it was recorded",
                               one_line(recording.string()), one_line(vessel), hash_text(content),
                               hash_text(header.vessel_hash)));
}

fs::path find_mesh(const RecordingHeader& header, const fs::path& recording_path, const fs::path& given) {
  const std::string recording = one_line(recording_path.string());
  const fs::path folder = recording_path.parent_path();
  const fs::path recorded = header.vessel;
  const std::vector<fs::path> places =
      given.empty() ? std::vector<fs::path>{recorded, folder / recorded, folder / recorded.filename()}
                    : std::vector<fs::path>{given};
  fs::path other;  // of that name, but not that content
  std::uint64_t content = 0;
  for (const fs::path& place : places) {
    if (!is_vessel(place)) continue;
    content = vessel_content_hash(place);
    if (content == header.vessel_hash) return place;
    other = place;
  }
  if (other.empty())
    throw InputError(fmt::format(
        "{}: vessel {} (content {}) was not found; --vessel FILE tells where it lies now", recording,
        one_line((given.empty() ? recorded : given).string()), hash_text(header.vessel_hash)));
  refuse_content(content, header, recording_path, other.string());
}

}  // namespace

SceneFile recorded_scene(const RecordingHeader& header, const fs::path& recording_path,
                         const fs::path& vessel_file) {
  const std::string recording = one_line(recording_path.string());
  const bool generated = header.vessel.starts_with(generated_prefix);
  const RecordedParts parts{generated ? fs::path() : find_mesh(header, recording_path, vessel_file),
                            header.instrument};
  SceneFile scene;
  try {
    scene = parse_scene(header.scene_text, one_line(header.scene_name), parts);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: its scene: {}", recording, error.what()));
  }
  if (generated != scene.vessel.generate.has_value())
    throw InputError(
        fmt::format("{}: vessel is {}, which is not that of its scene", recording, one_line(header.vessel)));
  return scene;
}

void check_recorded_vessel(const RecordingHeader& header, const fs::path& recording_path,
                           std::uint64_t content_hash) {
  if (content_hash != header.vessel_hash) refuse_content(content_hash, header, recording_path, header.vessel);
}

std::vector<TimedCommand> recorded_commands(const Recording& recording) {
  std::vector<TimedCommand> commands;
  commands.reserve(recording.commands.size());
  for (const RecordedCommand& recorded : recording.commands)
    commands.push_back({recorded.time_s, recorded.command});
  return commands;
}

}  // namespace endowire::io

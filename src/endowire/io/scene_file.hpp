#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "endowire/io/lumen_image.hpp"
#include "endowire/rod/instrument.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/sim/target.hpp"
#include "endowire/vessel/generate.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::io {

/// The most that a hand does in one motion of a scene, and so in one recorded step; a slip of a unit gives more.
inline constexpr double max_motion_mm = 1e4;   ///< three times the longest wire made
inline constexpr double max_motion_deg = 1e6;  ///< nearly three thousand turns

/// Where the vessel comes from: a file, or an anatomy made in code.
struct VesselSource {
  std::filesystem::path file;                       ///< as it can be opened from here; empty when generated
  std::optional<vessel::LengthUnit> unit;           ///< of the file; none: inferred
  VolumeOptions volume;                             ///< how the lumen of an image is found
  std::optional<vessel::GenerateRequest> generate;  ///< what to make; none when read from a file
};

/// A procedure as written down in a scene file; units as in sim/scene.hpp.
struct SceneFile {
  std::string name;   ///< the path as given: what messages begin with
  std::string text;   ///< the file, as read
  std::string title;  ///< for people; the file's name where the scene gives none
  VesselSource vessel;
  std::optional<int> opening;  ///< access through an opening, counted from 1
  bool access_given = true;    ///< else a generated vessel's own, which only making it tells
  sim::Access access;          ///< where given and not through an opening
  rod::Instrument instrument;
  sim::SimulationSpec simulation;
  std::optional<double> step_s;  ///< a fixed rate instead of the longest step
  std::vector<sim::Motion> motions;
  std::optional<sim::TargetSpec> target;
  std::optional<int>
      target_opening;  ///< the target is this end of the vessel, counted from 1; only the vessel tells where
  std::string perforation_source;  ///< where the threshold of a perforation comes from
};

/// Whether a scene has to say what the hands do: a script is played, a simulation that is steered from outside needs none.
enum class Script : std::uint8_t { required, optional };

/// Reads a scene. Relative vessel and instrument paths are relative to the scene's folder; an instrument is a
/// model name, searched for in `instrument_folders`, or a path that ends in `.toml`.
/// @throws base::InputError `scene.toml: motion[2].duration_s is -1; must be > 0`, for every unknown key,
/// wrong
///         type, value outside its range and missing file; indices count from 0, as in the file's lists.
[[nodiscard]] SceneFile read_scene_file(const std::filesystem::path& path,
                                        const std::vector<std::filesystem::path>& instrument_folders,
                                        Script script = Script::required);

/// Same, from text; `name` stands for the file in messages and its folder for relative paths.
[[nodiscard]] SceneFile parse_scene(const std::string& text, const std::string& name,
                                    const std::vector<std::filesystem::path>& instrument_folders,
                                    Script script = Script::required);

/// What stands in for the files that a scene names when it is read again from a recording.
struct RecordedParts {
  std::filesystem::path vessel_file;  ///< of no use to a generated vessel
  rod::Instrument instrument;         ///< as it was simulated
};

/// Same, from the text in a recording: neither the vessel nor the instrument is looked for.
/// @throws base::InputError as above, also when the instrument is no sound one
[[nodiscard]] SceneFile parse_scene(const std::string& text, const std::string& name,
                                    const RecordedParts& parts);

/// One step of a scripted procedure.
struct TimedCommand {
  double time_s = 0.0;  ///< when the step is done, from the start of the procedure
  sim::Command command;
};

/// The motions as equal steps: each motion takes as many as its larger limit asks for
/// (n = ceil(max(|advance| / max_advance, |torque| / max_torque)), at least 1), or duration / step_s.
[[nodiscard]] std::vector<TimedCommand> commands_of(const SceneFile& scene);

}  // namespace endowire::io

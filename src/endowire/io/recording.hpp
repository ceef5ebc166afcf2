#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "endowire/rod/instrument.hpp"
#include "endowire/sim/scene.hpp"

namespace endowire::io {

/// What a recording says before its first command: enough to know whether a replay can give the same states.
struct RecordingHeader {
  std::string version;            ///< of the program that recorded
  std::string scene_name;         ///< path of the scene, as given
  std::string scene_text;         ///< the scene itself
  std::string vessel;             ///< path of the mesh, or `generate:name`
  std::uint64_t vessel_hash = 0;  ///< content of the mesh file; of the generator's name when generated
  rod::Instrument instrument;     ///< as simulated, overrides included

  bool operator==(const RecordingHeader&) const;
};

struct RecordedCommand {
  std::uint64_t step = 0;  ///< counted from 1
  double time_s = 0.0;
  sim::Command command;
};

struct RecordedHash {
  std::uint64_t step = 0;
  std::uint64_t state_hash = 0;
};

/// A recording as read back.
struct Recording {
  RecordingHeader header;
  std::vector<RecordedCommand> commands;
  std::vector<RecordedHash> hashes;
  bool complete =
      false;  ///< the run came to its end; else it was cut off and holds what was written until then
};

/// Writes `recording.jsonl`: one JSON object a line, each flushed as it happens, so that a crash loses at
/// most the last line.
///
///   {"kind":"header","schema":1,"version":…,"scene":…,"scene_text":…,"scene_hash":…,"vessel":…,"vessel_hash":…,"instrument":{…}}
///   {"kind":"command","step":1,"time_s":0.1,"hands":[{"advance_mm":1.0,"torque_rad":0.0}]}
///   {"kind":"state","step":100,"state_hash":"0123456789abcdef"}
///   {"kind":"end","steps":450}
///
/// Numbers are written in the shortest form that reads back to the same bits.
class RecordingWriter {
 public:
  /// @throws base::InputError when the file cannot be written to (also by every other member).
  RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);
  void command(const RecordedCommand& command);
  void state(const RecordedHash& hash);
  void end(std::uint64_t steps);

 private:
  void line(const std::string& text);
  std::filesystem::path path_;
  std::ofstream out_;
};

/// Reads a recording; a last line without its end is left out, as a crash leaves it.
/// @throws base::InputError naming the file and line of anything else that does not fit.
[[nodiscard]] Recording read_recording(const std::filesystem::path& path);
/// Same, from text; `name` stands for the file in messages.
[[nodiscard]] Recording parse_recording(const std::string& text, const std::string& name);

}  // namespace endowire::io

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "endowire/io/recording.hpp"
#include "endowire/io/vtp.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/sim/snapshot.hpp"

namespace endowire::io {

/// The folder that one run fills:
///
///   recording.jsonl            as it happens
///   steps/wire_000001.vtp …    as it happens, with VTK
///   wire.pvd, wire.vtp         at the end, with VTK
///   wire.svg, report.html, summary.json   at the end; summary.json last: a folder without it holds a run that
///                              was cut off
///
/// Make it once the input is known to be good: it removes the files of an earlier run in the folder, by these
/// names and no others.
class RunOutput {
 public:
  /// @throws base::InputError when the folder cannot be made or written to (also by every other member).
  RunOutput(std::filesystem::path folder, const RecordingHeader& header, sim::Access access);

  /// Before the step is taken, so that the recording of a crash holds the command that caused it.
  void command(const RecordedCommand& command) { recording_.command(command); }
  void state_hash(const RecordedHash& hash) { recording_.state(hash); }
  void shape(std::uint64_t step, double time_s, const sim::Snapshot& snapshot);
  /// A shape that a step passed through in a snap; written before the step's own shape, at a time between.
  void waypoint(std::uint64_t step, int index, double time_s, const sim::Snapshot& snapshot);
  /// Ends the recording and writes wire.pvd and wire.vtp.
  void finish(std::uint64_t steps, const sim::Snapshot& last);
  /// Writes one more file of the run into the folder.
  void file(const std::string& name, std::string_view bytes);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Names of the files written, in order; the series of shapes as one.
  [[nodiscard]] const std::vector<std::string>& written() const { return written_; }

 private:
  std::filesystem::path folder_;
  sim::Access access_;
  RecordingWriter recording_;
  std::vector<SeriesEntry> series_;
  std::vector<std::string> written_;
};

/// @throws base::InputError when something that is no folder stands at the path; touches nothing.
void check_output_folder(const std::filesystem::path& folder);

}  // namespace endowire::io

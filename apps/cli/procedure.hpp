#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "endowire/io/picture.hpp"
#include "endowire/io/prepared_scene.hpp"
#include "endowire/io/run_history.hpp"
#include "endowire/io/run_output.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/sim/simulation.hpp"
#include "progress.hpp"

namespace endowire::cli {

/// What every command that plays a procedure is told.
struct RunOptions {
  std::string out;    ///< folder for the results
  std::string cache;  ///< folder of prepared vessels
  bool quiet = false;
};

/// A procedure on its way: the input, then what became of it.
struct Procedure : io::PreparedScene {
  double preparation_s = 0.0;
  io::RunStatistics statistics;
  std::vector<io::ForcePoint> forces;  ///< a point a step
  std::optional<io::RunHistory> history;
  sim::Snapshot last;
  std::uint64_t state_hash = 0;
};

/// The folder and the cache as options of a command.
void add_run_options(CLI::App& command, RunOptions& options);

/// Reads and prepares the vessel of a scene.
/// @throws base::InputError one line about the vessel, the access or the target.
[[nodiscard]] Procedure prepare(io::SceneFile scene, const std::string& cache, Progress& progress);

/// Called after each step.
using StepWatcher = std::function<void(std::uint64_t step, const sim::Simulation& simulation)>;

/// From the first command to the last file: what `simulate` and `replay` share.
/// @param header   of the new recording
/// @throws base::InputError when the wire does not fit where the scene puts it, or a file cannot be written
/// @return         exit_success or exit_not_converged, after one line on stderr
int run_procedure(Procedure& procedure, std::span<const io::TimedCommand> commands,
                  const io::RecordingHeader& header, const RunOptions& options, Progress& progress,
                  const StepWatcher& watcher = {});

}  // namespace endowire::cli

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/recorded_scene.hpp"
#include "endowire/io/version.hpp"
#include "procedure.hpp"

namespace endowire::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string recording;
  std::string vessel;  ///< where the mesh lies now; empty: where it was
  RunOptions run;
};

/// Holds the states of a replay against those of the recording.
class Comparison {
 public:
  explicit Comparison(const std::vector<io::RecordedHash>& recorded) : recorded_(recorded) {}

  void look(std::uint64_t step, const sim::Simulation& simulation) {
    if (next_ == recorded_.size() || recorded_[next_].step != step) return;
    const io::RecordedHash& expected = recorded_[next_++];
    const std::uint64_t hash = simulation.state_hash();
    if (hash == expected.state_hash) {
      ++equal_;
    } else if (!differs_) {
      differs_ = Difference{expected, hash};
    }
  }

  /// One line on stderr about the first state that differs.
  /// @param then  the exit code when none does
  [[nodiscard]] int verdict(const Options& options, const std::string& recorded_by, int then) const {
    if (!differs_) {
      if (!options.run.quiet)
        fmt::print("  {:<18} {} of {} state hashes\n", "reproduced", equal_, recorded_.size());
      return then;
    }
    fmt::print(stderr,
               "{}: step {}: state {} differs from the recorded {}; recorded by version {}, this is {}\n",
               io::one_line(options.recording), differs_->recorded.step, io::hash_text(differs_->hash),
               io::hash_text(differs_->recorded.state_hash), io::one_line(recorded_by), io::version);
    return exit_not_reproduced;
  }

 private:
  struct Difference {
    io::RecordedHash recorded;
    std::uint64_t hash = 0;
  };
  const std::vector<io::RecordedHash>& recorded_;
  std::size_t next_ = 0;
  std::size_t equal_ = 0;
  std::optional<Difference> differs_;
};

void check_not_over_itself(const Options& options) {
  std::error_code error;
  if (fs::equivalent(fs::path(options.run.out) / "recording.jsonl", options.recording, error))
    throw base::InputError(fmt::format("--out: {} holds the recording itself; must be another folder",
                                       io::one_line(options.run.out)));
}

int replay(const Options& options) {
  io::check_output_folder(options.run.out);
  const io::Recording recording = io::read_recording(options.recording);
  check_not_over_itself(options);
  Progress progress(options.run.quiet);
  Procedure procedure = prepare(io::recorded_scene(recording.header, options.recording, options.vessel),
                                options.run.cache, progress);
  io::check_recorded_vessel(recording.header, options.recording, procedure.vessel.content_hash);
  procedure.vessel.source = recording.header.vessel;  // wherever it was found: the results are the same
  io::RecordingHeader header = recording.header;
  header.version = io::version;
  Comparison comparison(recording.hashes);
  const int code = run_procedure(
      procedure, io::recorded_commands(recording), header, options.run, progress,
      [&](std::uint64_t step, const sim::Simulation& simulation) { comparison.look(step, simulation); });
  if (!recording.complete)
    fmt::print(stderr, "{}: was cut off; replayed up to step {}, its last whole one\n",
               io::one_line(options.recording), recording.commands.size());
  return comparison.verdict(options, recording.header.version, code);
}

}  // namespace

std::function<int()> add_replay(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("replay", "play a recording again: the same states, the same files");
  command->add_option("RECORDING", options->recording, "recording.jsonl of a run")->required();
  command->add_option("--vessel", options->vessel, "where the vessel's mesh lies now");
  add_run_options(*command, options->run);
  return [options] { return replay(*options); };
}

}  // namespace endowire::cli

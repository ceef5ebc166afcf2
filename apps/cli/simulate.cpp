#include <memory>

#include "commands.hpp"
#include "endowire/io/version.hpp"
#include "procedure.hpp"

namespace endowire::cli {

namespace {

struct Options {
  std::string scene;
  RunOptions run;
};

io::RecordingHeader header_of(const Procedure& procedure) {
  io::RecordingHeader header;
  header.version = io::version;
  header.scene_name = procedure.scene.name;
  header.scene_text = procedure.scene.text;
  header.vessel = procedure.vessel.source;
  header.vessel_hash = procedure.vessel.content_hash;
  header.instrument = procedure.scene.instrument;
  return header;
}

int simulate(const Options& options) {
  io::check_output_folder(options.run.out);
  Progress progress(options.run.quiet);
  Procedure procedure =
      prepare(io::read_scene_file(options.scene, instrument_folders()), options.run.cache, progress);
  const std::vector<io::TimedCommand> commands = io::commands_of(procedure.scene);
  return run_procedure(procedure, commands, header_of(procedure), options.run, progress);
}

}  // namespace

std::function<int()> add_simulate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("simulate", "play a scripted procedure");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  add_run_options(*command, options->run);
  return [options] { return simulate(*options); };
}

}  // namespace endowire::cli

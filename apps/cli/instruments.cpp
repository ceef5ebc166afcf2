#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/instrument_facts.hpp"
#include "endowire/io/instrument_file.hpp"
#include "endowire/io/instrument_picture.hpp"
#include "endowire/io/instrument_text.hpp"

namespace endowire::cli {

namespace {

struct Options {
  std::string name;
  std::string picture;
  bool json = false;
};

std::vector<io::InstrumentFile> library() {
  const auto folders = instrument_folders();
  std::vector<io::InstrumentFile> files;
  for (const std::string& name : io::list_instruments(folders))
    files.push_back(io::read_instrument_file(io::find_instrument(name, folders)));
  return files;
}

void print_library(bool as_json) {
  if (as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const io::InstrumentFile& file : library()) list.push_back(io::facts_json(file));
    fmt::print("{}\n", list.dump(1));
    return;
  }
  fmt::print("{}", io::library_text(library()));
}

/// An instrument of the library, or of a file of one's own.
io::InstrumentFile find(const std::string& name) {
  if (name.ends_with(".toml")) return io::read_instrument_file(name);
  const auto folders = instrument_folders();
  const std::filesystem::path path = io::find_instrument(name, folders);
  if (path.empty()) {
    std::string known;
    for (const std::string& one : io::list_instruments(folders)) known += (known.empty() ? "" : ", ") + one;
    throw base::InputError(fmt::format(
        "instruments: NAME is \"{}\"; must be one of {}, or the path of a .toml file", name, known));
  }
  return io::read_instrument_file(path);
}

void print_instrument(const io::InstrumentFile& file) {
  const rod::MaterialLine line(file.instrument);
  fmt::print("{}\n{}\n{}\n\n", file.instrument.model, file.description, file.path);
  fmt::print("{}\n{}\n{}\n", io::sections_text(line), io::profile_text(line), io::shape_text(line));
  fmt::print("{}", io::values_text(file));
}

int run(const Options& options) {
  if (options.name.empty()) {
    if (!options.picture.empty())
      throw base::InputError(
          "instruments: --picture is given without NAME; must be left out, or drawn of one");
    print_library(options.json);
    return exit_success;
  }
  if (!options.picture.empty() && !options.picture.ends_with(".svg"))
    throw base::InputError(
        fmt::format("instruments: --picture is \"{}\"; must end in .svg", options.picture));
  const io::InstrumentFile file = find(options.name);
  if (!options.picture.empty()) io::write_file_atomically(options.picture, io::instrument_picture_svg(file));
  if (options.json)
    fmt::print("{}\n", io::details_json(file).dump(1));
  else
    print_instrument(file);
  return exit_success;
}

}  // namespace

std::function<int()> add_instruments(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "instruments",
      "the library of real wires and catheters, or one of them: sections, stiffness, shape, sources");
  command->add_option("NAME", options->name, "an instrument of the library, or the path of a .toml file");
  command->add_option("--picture", options->picture,
                      "also draw stiffness and unloaded shape into this SVG file");
  command->add_flag("--json", options->json, "for programs");
  return [options] { return run(*options); };
}

}  // namespace endowire::cli

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/instrument_file.hpp"

namespace endowire::cli {

namespace {

void print_library() {
  const auto folders = instrument_folders();
  for (const std::string& name : io::list_instruments(folders)) {
    const io::InstrumentFile file = io::read_instrument_file(io::find_instrument(name, folders));
    fmt::print("{:<28} {}\n", name, file.description);
  }
}

void print_instrument(const std::string& name) {
  const auto folders = instrument_folders();
  const std::filesystem::path path = io::find_instrument(name, folders);
  if (path.empty()) {
    std::string known;
    for (const std::string& one : io::list_instruments(folders)) known += (known.empty() ? "" : ", ") + one;
    throw base::InputError(fmt::format("instruments: NAME is \"{}\"; must be one of {}", name, known));
  }
  const io::InstrumentFile file = io::read_instrument_file(path);
  fmt::print("{}\n{}\n{}\n\n", file.instrument.model, file.description, file.path);
  for (const io::SourcedValue& value : file.values)
    fmt::print("{:<44} {:<18} {}\n", value.field, value.value, value.source);
}

}  // namespace

std::function<int()> add_instruments(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("instruments", "the library of real wires, or one of them with its sources");
  command->add_option("NAME", *name, "an instrument of the library");
  return [name] {
    name->empty() ? print_library() : print_instrument(*name);
    return exit_success;
  };
}

}  // namespace endowire::cli

// endowire: guidewires through vessels. One subcommand a file; see commands.hpp for the exit codes.

#include <cstdio>
#include <exception>
#include <new>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/version.hpp"

int main(int argc, char** argv) {
  using namespace endowire;
  CLI::App app("endowire: a guidewire simulator. Not a medical device.", "endowire");
  app.set_version_flag("--version", std::string("endowire ") + io::version);
  app.require_subcommand(1);
  std::vector<std::pair<const char*, std::function<int()>>> commands;
  commands.emplace_back("generate", cli::add_generate(app));
  commands.emplace_back("inspect", cli::add_inspect(app));
  commands.emplace_back("instruments", cli::add_instruments(app));
  commands.emplace_back("prepare", cli::add_prepare(app));
  commands.emplace_back("simulate", cli::add_simulate(app));
  commands.emplace_back("replay", cli::add_replay(app));
  const auto complain = [](const std::string& message) {
    std::fprintf(stderr, "%s\n", io::one_line(message).c_str());
    return cli::exit_bad_input;
  };
  try {
    app.parse(argc, argv);
    for (const auto& [name, run] : commands)
      if (app.got_subcommand(name)) return run();
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RequiredError& error) {
    if (argc > 1 && app.get_subcommands().empty())
      return complain(
          std::string("endowire: \"") + argv[1] +
          "\" is no subcommand; must be generate, inspect, instruments, prepare, simulate or replay");
    return complain(std::string("endowire: ") + error.what());
  } catch (const CLI::ParseError& error) {
    return complain(std::string("endowire: ") + error.what());
  } catch (const base::InputError& error) {
    return complain(error.what());
  } catch (const std::bad_alloc&) {
    return complain("endowire: not enough memory for this input");
  }
  return cli::exit_success;
}

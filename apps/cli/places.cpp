#include "endowire/io/places.hpp"

#include <system_error>

#include "commands.hpp"

namespace endowire::cli {

namespace fs = std::filesystem;

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

std::vector<fs::path> instrument_folders() {
#ifdef ENDOWIRE_SOURCE_DIR
  return io::instrument_folders(program_folder(), ENDOWIRE_SOURCE_DIR);
#else
  return io::instrument_folders(program_folder(), {});
#endif
}

}  // namespace endowire::cli

#include <cstdlib>
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
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("ENDOWIRE_INSTRUMENTS"); own != nullptr && *own != '\0')
    folders.emplace_back(own);
  if (const fs::path here = program_folder(); !here.empty()) {
    folders.push_back(here / "instruments");
    folders.push_back(here / ".." / "share" / "endowire" / "instruments");
  }
#ifdef ENDOWIRE_SOURCE_DIR
  folders.emplace_back(fs::path(ENDOWIRE_SOURCE_DIR) / "instruments");
#endif
  return folders;
}

}  // namespace endowire::cli

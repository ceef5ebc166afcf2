#include "endowire/io/places.hpp"

#include <cstdlib>

namespace endowire::io {

namespace fs = std::filesystem;

std::vector<fs::path> instrument_folders(const fs::path& program_folder, const fs::path& source_tree) {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("ENDOWIRE_INSTRUMENTS"); own != nullptr && *own != '\0')
    folders.emplace_back(own);
  if (!program_folder.empty()) {
    folders.push_back(program_folder / "instruments");
    folders.push_back(program_folder / ".." / "share" / "endowire" / "instruments");
  }
  if (!source_tree.empty()) folders.push_back(source_tree / "instruments");
  return folders;
}

}  // namespace endowire::io

// write_validation DOCS: runs the cases of physics and writes DOCS/validation.md and its pictures; when one misses its tolerance it writes
// nothing and exits with 1.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "validation.hpp"

namespace {

bool all_hold(const std::vector<endowire::test::Section>& sections) {
  bool hold = true;
  for (const endowire::test::Section& section : sections) {
    for (const endowire::test::Check& c : section.checks) {
      if (c.holds()) continue;
      hold = false;
      std::cerr << c.test << " " << c.quantity << ": error " << c.error() << ", allowed " << c.tolerance
                << "\n";
    }
  }
  return hold;
}

bool write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (file.flush()) return true;
  std::cerr << path.string() << ": cannot be written\n";
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_validation DOCS\n";
    return 2;
  }
  const std::filesystem::path docs = argv[1];
  const std::filesystem::path pictures = docs / "images" / "validation";
  const std::vector<endowire::test::Section> sections = endowire::test::validation();
  if (!all_hold(sections)) return 1;
  std::filesystem::create_directories(pictures);
  for (const endowire::test::Section& section : sections) {
    for (const endowire::test::Figure& figure : section.figures)
      if (!write(pictures / (figure.name + ".svg"), endowire::test::svg(figure))) return 2;
  }
  return write(docs / "validation.md", endowire::test::validation_document(sections)) ? 0 : 2;
}

#pragma once

#include <string>
#include <vector>

namespace endowire::paper {

struct Figure {
  std::string file;  ///< name within docs/images/paper
  std::string svg;
};

/// One claim, tried: a piece of the document with its figures.
struct Section {
  std::string markdown;
  std::vector<Figure> figures;
};

/// A figure's place in the text.
[[nodiscard]] inline std::string picture(const std::string& file, const std::string& caption) {
  return "![" + caption + "](images/paper/" + file + ")\n\n*" + caption + "*\n\n";
}

}  // namespace endowire::paper

#include "endowire/io/text_table.hpp"

#include <algorithm>

#include "endowire/base/contract.hpp"

namespace endowire::io {

namespace {

constexpr std::size_t gap = 2;  // blanks between columns

/// Characters, not bytes: what continues a character of UTF-8 does not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

void TextTable::add(std::vector<std::string> cells) {
  ENDOWIRE_EXPECTS(cells.size() == columns_.size(), "a cell for every column");
  rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
  std::vector<std::size_t> width;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    width.push_back(width_of(columns_[c].heading));
    for (const std::vector<std::string>& row : rows_) width[c] = std::max(width[c], width_of(row[c]));
  }
  std::string text;
  const auto write = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string& cell = cell_of(c);
      const std::string padding(width[c] - width_of(cell), ' ');
      if (c > 0) line.append(gap, ' ');
      line += columns_[c].align == Align::left ? cell + padding : padding + cell;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  };
  write([&](std::size_t c) -> const std::string& { return columns_[c].heading; });
  for (const std::vector<std::string>& row : rows_)
    write([&](std::size_t c) -> const std::string& { return row[c]; });
  return text;
}

}  // namespace endowire::io

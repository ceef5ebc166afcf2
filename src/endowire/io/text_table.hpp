#pragma once

#include <string>
#include <vector>

namespace endowire::io {

/// A table for people to read in a terminal: every column as wide as its longest cell, two blanks between columns, none behind the last.
class TextTable {
 public:
  enum class Align { left, right };  ///< words left, numbers right
  struct Column {
    std::string heading;  ///< with its unit
    Align align = Align::right;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// @param cells  one for every column, in UTF-8
  void add(std::vector<std::string> cells);
  /// Headings and rows, each line ended.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace endowire::io

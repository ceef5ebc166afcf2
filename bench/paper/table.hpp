#pragma once

#include <string>
#include <vector>

namespace endowire::paper {

/// A table of a Markdown document.
class Table {
 public:
  explicit Table(const std::vector<std::string>& head);
  void row(const std::vector<std::string>& cells);
  [[nodiscard]] const std::string& markdown() const { return text_; }

 private:
  std::string text_;
};

}  // namespace endowire::paper

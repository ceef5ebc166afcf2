#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace endowire::vessel {

/// The words of a text file of a mesh.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}
  /// The next word; empty at the end.
  [[nodiscard]] std::string_view next();
  void skip_line();
  /// The rest of this line, without its end; the next word is on the next line. Empty at the end too.
  [[nodiscard]] std::string_view line();
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  /// Where the next word is looked for, from the start of the text.
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Whether a word is another one, written in lower case, whatever its own case.
[[nodiscard]] bool equals(std::string_view token, std::string_view word);

/// A decimal number, independent of the locale; NaN when the text is none (the caller refuses NaN anyway).
[[nodiscard]] double parse_number(std::string_view text);

/// Text of a value that may be anything, short enough for a message of one line.
[[nodiscard]] std::string quoted(std::string_view token);

}  // namespace endowire::vessel

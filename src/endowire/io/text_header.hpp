#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace endowire::io {

/// The lines `key = value` or `key: value` that an image file begins with.
class TextHeader {
 public:
  explicit TextHeader(std::string file_label) : file_(std::move(file_label)) {}

  void set(std::string_view key, std::string_view value);
  [[nodiscard]] bool has(const std::string& key) const { return values_.contains(key); }
  /// Empty when there is none.
  [[nodiscard]] std::string text(const std::string& key) const;
  /// The numbers of a value, whatever stands between them of spaces, commas and brackets.
  /// @throws base::InputError when there are not `count` of them, all finite
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// Three whole numbers, as many digits as they have.
  [[nodiscard]] std::array<std::int64_t, 3> sizes(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::map<std::string, std::string> values_;
};

/// Without spaces at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace endowire::io

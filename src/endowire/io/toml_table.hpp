#pragma once

#include <toml++/toml.h>

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace endowire::io {

/// The values that a number may take; its text ends the message about one that it may not.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool infinite_allowed = false;

  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] std::string text() const;
};
[[nodiscard]] inline Range any_number() {
  return {};
}
[[nodiscard]] inline Range above(double low) {
  Range range;
  range.low = low;
  range.low_open = true;
  return range;
}
[[nodiscard]] inline Range at_least(double low) {
  Range range;
  range.low = low;
  return range;
}
[[nodiscard]] inline Range between(double low, double high) {
  Range range;
  range.low = low;
  range.high = high;
  return range;
}

/// The text as TOML.
/// @throws base::InputError `file: line 3, column 5: what is wrong`.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& file);

/// One table of a file while it is read: every message names the file and the whole path of the field.
/// Each getter throws base::InputError when the value has the wrong type or lies outside its range.
class TomlTable {
 public:
  /// @param keys  all that the table may hold; anything else is refused by name at once
  TomlTable(const toml::table& table, std::string file, std::string path,
            std::initializer_list<std::string_view> keys);

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
  [[nodiscard]] std::string path_of(std::string_view key) const;
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Throws `file: path is <value>; must be <allowed>`.
  [[noreturn]] void refuse(std::string_view key, std::string_view value, std::string_view allowed) const;
  /// Throws `file: path is missing; must be <allowed>`.
  [[noreturn]] void refuse_missing(std::string_view key, std::string_view allowed) const;

  [[nodiscard]] double number(std::string_view key, const Range& range) const;
  [[nodiscard]] double number_or(std::string_view key, double otherwise, const Range& range) const;
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t otherwise, std::int64_t low,
                                        std::int64_t high) const;
  [[nodiscard]] std::string string(std::string_view key, std::string_view what) const;
  [[nodiscard]] std::string string_or(std::string_view key, std::string otherwise,
                                      std::string_view what) const;
  [[nodiscard]] bool boolean_or(std::string_view key, bool otherwise) const;
  /// The entries of the table under `key`, which may have any names: numbers, or true and false for 1 and 0. None
  /// when it is absent.
  [[nodiscard]] std::vector<std::pair<std::string, double>> numbers(std::string_view key) const;
  [[nodiscard]] Eigen::Vector3d vector(std::string_view key) const;
  [[nodiscard]] Eigen::Vector3d vector_or(std::string_view key, const Eigen::Vector3d& otherwise) const;
  /// The table under `key`, if there is one.
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key,
                                               std::initializer_list<std::string_view> keys) const;
  /// The tables of the array under `key`; none when it is absent.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key,
                                              std::initializer_list<std::string_view> keys) const;
  [[nodiscard]] const toml::table& raw() const { return *table_; }

 private:
  const toml::table* table_;
  std::string file_;
  std::string path_;
};

}  // namespace endowire::io

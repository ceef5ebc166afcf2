#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "endowire/io/instrument_file.hpp"
#include "endowire/io/toml_table.hpp"

namespace endowire::io {

/// Reads values that say where they come from, `{ value = …, source = "…" }`, and keeps a note of each.
/// Everything throws base::InputError naming file, field, value and what is allowed.
class SourcedReader {
 public:
  /// @param sources  keys of [sources]
  SourcedReader(std::set<std::string> sources, std::vector<SourcedValue>& values)
      : sources_(std::move(sources)), values_(values) {}

  [[nodiscard]] double constant(const TomlTable& table, std::string_view key, const Range& range);
  [[nodiscard]] double constant_or(const TomlTable& table, std::string_view key, double otherwise,
                                   const Range& range);
  /// `{ value = … }`, or linear `{ tip = …, hand = … }`.
  [[nodiscard]] rod::Taper taper(const TomlTable& table, std::string_view key, const Range& range);
  [[nodiscard]] rod::Taper taper_or(const TomlTable& table, std::string_view key, const rod::Taper& otherwise,
                                    const Range& range);
  /// `{ value = [[x, y, z], …] }`
  [[nodiscard]] std::vector<Eigen::Vector3d> points(const TomlTable& table, std::string_view key);
  /// Notes a value that is not in the file but follows from others.
  void follows(const std::string& field, const rod::Taper& taper, const std::string& from);

 private:
  void note(const TomlTable& field, const std::string& path, std::string value);

  std::set<std::string> sources_;
  std::vector<SourcedValue>& values_;
};

/// The keys of [sources]; their citations are texts.
[[nodiscard]] std::set<std::string> read_sources(const TomlTable& root);

}  // namespace endowire::io

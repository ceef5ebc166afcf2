#include "endowire/io/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"

namespace endowire::io {

using base::InputError;

namespace {

std::string_view type_name(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_boolean()) return "a boolean";
  if (node.is_number()) return "a number";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date";
}

std::string joined(std::initializer_list<std::string_view> keys) {
  std::string text;
  for (const std::string_view key : keys) text += (text.empty() ? "" : ", ") + std::string(key);
  return text;
}

}  // namespace

bool Range::holds(double value) const {
  if (std::isnan(value)) return false;
  if (!std::isfinite(value) && !infinite_allowed) return false;
  return (low_open ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
  const std::string or_infinite = infinite_allowed ? " (inf allowed)" : "";
  if (std::isfinite(low) && std::isfinite(high)) {
    if (low_open) return fmt::format("> {} and <= {}", low, high) + or_infinite;
    return fmt::format("between {} and {}", low, high) + or_infinite;
  }
  if (std::isfinite(low)) return fmt::format("{} {}", low_open ? ">" : ">=", low) + or_infinite;
  if (std::isfinite(high)) return fmt::format("<= {}", high) + or_infinite;
  return "a finite number";
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const toml::source_position where = error.source().begin;
    throw InputError(fmt::format("{}: line {}, column {}: {}", file, where.line, where.column,
                                 one_line(error.description())));
  }
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string path,
                     std::initializer_list<std::string_view> keys)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {
  for (const auto& [key, node] : table) {
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
      throw InputError(
          fmt::format("{}: {} is unknown; known here: {}", file_, path_of(key.str()), joined(keys)));
  }
}

std::string TomlTable::path_of(std::string_view key) const {
  const std::string clean = one_line(key);
  return path_.empty() ? clean : path_ + "." + clean;
}

void TomlTable::refuse(std::string_view key, std::string_view value, std::string_view allowed) const {
  throw InputError(fmt::format("{}: {} is {}; must be {}", file_, path_of(key), one_line(value), allowed));
}

void TomlTable::refuse_missing(std::string_view key, std::string_view allowed) const {
  throw InputError(fmt::format("{}: {} is missing; must be {}", file_, path_of(key), allowed));
}

double TomlTable::number(std::string_view key, const Range& range) const {
  const toml::node* node = table_->get(key);
  const std::string allowed = range.text();
  if (node == nullptr) refuse_missing(key, allowed);
  if (!node->is_number()) refuse(key, type_name(*node), "a number, " + allowed);
  const double value = node->value<double>().value_or(std::nan(""));
  if (!range.holds(value)) refuse(key, fmt::format("{}", value), allowed);
  return value;
}

double TomlTable::number_or(std::string_view key, double otherwise, const Range& range) const {
  return has(key) ? number(key, range) : otherwise;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  const toml::node* node = table_->get(key);
  const std::string allowed =
      low == high ? fmt::format("{}", low) : fmt::format("an integer between {} and {}", low, high);
  if (node == nullptr) refuse_missing(key, allowed);
  if (node->is_floating_point()) refuse(key, fmt::format("{}", node->value<double>().value_or(0.0)), allowed);
  if (!node->is_integer()) refuse(key, type_name(*node), allowed);
  const std::int64_t value = node->value<std::int64_t>().value_or(low);
  if (value < low || value > high) refuse(key, fmt::format("{}", value), allowed);
  return value;
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t otherwise, std::int64_t low,
                                   std::int64_t high) const {
  return has(key) ? integer(key, low, high) : otherwise;
}

std::string TomlTable::string(std::string_view key, std::string_view what) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr) refuse_missing(key, what);
  if (!node->is_string()) refuse(key, type_name(*node), what);
  std::string value = node->value<std::string>().value_or("");
  if (value.empty()) refuse(key, "empty", what);
  return value;
}

std::string TomlTable::string_or(std::string_view key, std::string otherwise, std::string_view what) const {
  return has(key) ? string(key, what) : std::move(otherwise);
}

bool TomlTable::boolean_or(std::string_view key, bool otherwise) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return otherwise;
  if (!node->is_boolean()) refuse(key, type_name(*node), "true or false");
  return node->value<bool>().value_or(otherwise);
}

std::vector<std::pair<std::string, double>> TomlTable::numbers(std::string_view key) const {
  std::vector<std::pair<std::string, double>> result;
  const toml::node* node = table_->get(key);
  if (node == nullptr) return result;
  if (!node->is_table()) refuse(key, type_name(*node), "a table");
  for (const auto& [name, element] : *node->as_table()) {
    const std::string element_key = fmt::format("{}.{}", key, name.str());
    if (!element.is_number() && !element.is_boolean()) refuse(element_key, type_name(element), "a number");
    const double number = element.is_boolean() ? (element.value<bool>().value_or(false) ? 1.0 : 0.0)
                                               : element.value<double>().value_or(std::nan(""));
    result.emplace_back(one_line(name.str()), number);
  }
  return result;
}

Eigen::Vector3d TomlTable::vector(std::string_view key) const {
  const char* const allowed = "a list of three finite numbers";
  const toml::node* node = table_->get(key);
  if (node == nullptr) refuse_missing(key, allowed);
  const toml::array* list = node->as_array();
  if (list == nullptr) refuse(key, type_name(*node), allowed);
  if (list->size() != 3) refuse(key, fmt::format("a list of {}", list->size()), allowed);
  Eigen::Vector3d value;
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node& element = (*list)[i];
    const std::string element_key = fmt::format("{}[{}]", key, i);
    if (!element.is_number()) refuse(element_key, type_name(element), "a finite number");
    const double number = element.value<double>().value_or(std::nan(""));
    if (!std::isfinite(number)) refuse(element_key, fmt::format("{}", number), "a finite number");
    value[static_cast<Eigen::Index>(i)] = number;
  }
  return value;
}

Eigen::Vector3d TomlTable::vector_or(std::string_view key, const Eigen::Vector3d& otherwise) const {
  return has(key) ? vector(key) : otherwise;
}

std::optional<TomlTable> TomlTable::table(std::string_view key,
                                          std::initializer_list<std::string_view> keys) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) refuse(key, type_name(*node), "a table");
  return TomlTable(*node->as_table(), file_, path_of(key), keys);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key,
                                         std::initializer_list<std::string_view> keys) const {
  std::vector<TomlTable> result;
  const toml::node* node = table_->get(key);
  if (node == nullptr) return result;
  const toml::array* list = node->as_array();
  if (list == nullptr) refuse(key, type_name(*node), "a list of tables");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& element = (*list)[i];
    const std::string element_key = fmt::format("{}[{}]", key, i);
    if (!element.is_table()) refuse(element_key, type_name(element), "a table");
    result.emplace_back(*element.as_table(), file_, path_of(element_key), keys);
  }
  return result;
}

}  // namespace endowire::io

#include "endowire/io/sourced_reader.hpp"

#include <fmt/format.h>

namespace endowire::io {

namespace {

constexpr double max_place_mm = 5000.0;  // of a point of a shape from its origin: the longest instrument

TomlTable required(const TomlTable& table, std::string_view key, std::initializer_list<std::string_view> keys,
                   const std::string& allowed) {
  const std::optional<TomlTable> field = table.table(key, keys);
  if (!field) table.refuse_missing(key, "{ value = …, source = \"…\" } with a value " + allowed);
  return *field;
}

std::string text_of(const rod::Taper& taper) {
  return taper.at_tip_side == taper.at_hand_side
             ? fmt::format("{:.6g}", taper.at_tip_side)
             : fmt::format("{:.6g} … {:.6g}", taper.at_tip_side, taper.at_hand_side);
}

}  // namespace

double SourcedReader::constant(const TomlTable& table, std::string_view key, const Range& range) {
  const TomlTable field = required(table, key, {"value", "source"}, range.text());
  const double value = field.number("value", range);
  note(field, table.path_of(key), fmt::format("{}", value));
  return value;
}

double SourcedReader::constant_or(const TomlTable& table, std::string_view key, double otherwise,
                                  const Range& range) {
  return table.has(key) ? constant(table, key, range) : otherwise;
}

rod::Taper SourcedReader::taper(const TomlTable& table, std::string_view key, const Range& range) {
  const TomlTable field = required(table, key, {"value", "tip", "hand", "source"}, range.text());
  rod::Taper taper;
  if (field.has("value")) {
    if (field.has("tip") || field.has("hand"))
      field.refuse("value", "given beside tip and hand", "alone, or left out");
    taper = field.number("value", range);
  } else {
    taper.at_tip_side = field.number("tip", range);
    taper.at_hand_side = field.number("hand", range);
  }
  note(field, table.path_of(key), text_of(taper));
  return taper;
}

rod::Taper SourcedReader::taper_or(const TomlTable& table, std::string_view key, const rod::Taper& otherwise,
                                   const Range& range) {
  return table.has(key) ? taper(table, key, range) : otherwise;
}

std::vector<Eigen::Vector3d> SourcedReader::points(const TomlTable& table, std::string_view key) {
  const char* const allowed = "a list of at least three points [x, y, z] within 5000 mm of the origin";
  const TomlTable field = required(table, key, {"value", "source"}, allowed);
  const toml::array* list = field.raw().get_as<toml::array>("value");
  if (list == nullptr) field.refuse("value", "no list", allowed);
  if (list->size() < 3) field.refuse("value", fmt::format("a list of {}", list->size()), allowed);
  std::vector<Eigen::Vector3d> points;
  for (const toml::node& node : *list) {
    const std::string place = fmt::format("value[{}]", points.size());
    const toml::array* point = node.as_array();
    if (point == nullptr || point->size() != 3) field.refuse(place, "no point", "[x, y, z]");
    Eigen::Vector3d read;
    for (Eigen::Index c = 0; c < 3; ++c) {
      const std::optional<double> coordinate = point->get(static_cast<std::size_t>(c))->value<double>();
      if (!coordinate || !(std::abs(*coordinate) <= max_place_mm)) field.refuse(place, "no point", allowed);
      read[c] = *coordinate;
    }
    points.push_back(read);
  }
  note(field, table.path_of(key), fmt::format("{} points", points.size()));
  return points;
}

void SourcedReader::follows(const std::string& field, const rod::Taper& taper, const std::string& from) {
  values_.push_back({field, text_of(taper), "follows from " + from});
}

void SourcedReader::note(const TomlTable& field, const std::string& path, std::string value) {
  const char* const allowed = "a key of [sources] or \"estimate: reasoning\"";
  const std::string source = field.string("source", allowed);
  const std::size_t colon = source.find(':');
  const std::string key = source.substr(0, colon);
  const bool reasoned =
      colon != std::string::npos && source.find_first_not_of(' ', colon + 1) != std::string::npos;
  if (key == "estimate" ? !reasoned : !sources_.contains(key))
    field.refuse("source", '"' + source + '"', allowed);
  values_.push_back({path, std::move(value), source});
}

std::set<std::string> read_sources(const TomlTable& root) {
  std::set<std::string> keys;
  const toml::node* node = root.raw().get("sources");
  if (node == nullptr) return keys;
  if (!node->is_table()) root.refuse("sources", "no table", "a table of key = \"citation\"");
  for (const auto& [key, citation] : *node->as_table()) {
    const std::string path = fmt::format("sources.{}", key.str());
    if (!citation.is_string() || citation.value<std::string>()->empty())
      root.refuse(path, "no text", "a citation");
    keys.emplace(key.str());
  }
  return keys;
}

}  // namespace endowire::io

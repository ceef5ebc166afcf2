#include "endowire/io/instrument_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/toml_table.hpp"

namespace endowire::io {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t max_instrument_bytes = 1 << 20;  // a hand-written file; anything longer is a mistake
constexpr double max_length_mm = 10'000.0;                // three times the longest wire made

/// Reads sourced values and keeps their origins.
class SourcedReader {
 public:
  SourcedReader(std::set<std::string> sources, std::vector<SourcedValue>& values)
      : sources_(std::move(sources)), values_(values) {}

  double constant(const TomlTable& table, std::string_view key, const Range& range) {
    const TomlTable field = required(table, key, {"value", "source"}, range);
    const double value = field.number("value", range);
    note(field, table.path_of(key), fmt::format("{}", value));
    return value;
  }

  double constant_or(const TomlTable& table, std::string_view key, double otherwise, const Range& range) {
    return table.has(key) ? constant(table, key, range) : otherwise;
  }

  rod::Taper taper(const TomlTable& table, std::string_view key, const Range& range) {
    const TomlTable field = required(table, key, {"value", "tip", "hand", "source"}, range);
    rod::Taper taper;
    if (field.has("value")) {
      if (field.has("tip") || field.has("hand"))
        field.refuse("value", "given beside tip and hand", "alone, or left out");
      taper.at_tip_side = taper.at_hand_side = field.number("value", range);
    } else {
      taper.at_tip_side = field.number("tip", range);
      taper.at_hand_side = field.number("hand", range);
    }
    note(field, table.path_of(key),
         taper.at_tip_side == taper.at_hand_side
             ? fmt::format("{}", taper.at_tip_side)
             : fmt::format("{} … {}", taper.at_tip_side, taper.at_hand_side));
    return taper;
  }

 private:
  static TomlTable required(const TomlTable& table, std::string_view key,
                            std::initializer_list<std::string_view> keys, const Range& range) {
    const std::optional<TomlTable> field = table.table(key, keys);
    if (!field) table.refuse_missing(key, "{ value = …, source = \"…\" } with a value " + range.text());
    return *field;
  }

  void note(const TomlTable& field, const std::string& path, std::string value) {
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

  std::set<std::string> sources_;
  std::vector<SourcedValue>& values_;
};

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

rod::Section read_section(const TomlTable& table, SourcedReader& reader) {
  rod::Section section;
  Range length = above(0.0);
  length.high = max_length_mm;
  Range radius = above(0.0);
  radius.high = 10.0;
  Range kink = above(0.0);
  kink.infinite_allowed = true;
  section.length_mm = reader.constant(table, "length_mm", length);
  section.radius_mm = reader.taper(table, "radius_mm", radius);
  section.flexural_rigidity_n_mm2 = reader.taper(table, "flexural_rigidity_n_mm2", above(0.0));
  section.torsional_rigidity_n_mm2 = reader.taper(table, "torsional_rigidity_n_mm2", above(0.0));
  section.axial_rigidity_n = reader.taper(table, "axial_rigidity_n", above(0.0));
  section.linear_density_g_per_mm = reader.constant(table, "linear_density_g_per_mm", at_least(0.0));
  section.friction = reader.constant(table, "friction", between(0.0, 2.0));
  section.rest_curvature_per_mm =
      reader.constant_or(table, "rest_curvature_per_mm", 0.0, between(-10.0, 10.0));
  section.rest_plane_rad =
      reader.constant_or(table, "rest_plane_deg", 0.0, between(-360.0, 360.0)) * std::numbers::pi / 180.0;
  section.kink_curvature_per_mm =
      reader.constant_or(table, "kink_curvature_per_mm", section.kink_curvature_per_mm, kink);
  section.radiopacity = reader.constant_or(table, "radiopacity", 1.0, at_least(0.0));
  return section;
}

}  // namespace

InstrumentFile parse_instrument(const std::string& text, const std::string& name) {
  const toml::table toml = parse_toml(text, name);
  const TomlTable root(toml, name, "", {"schema", "model", "description", "sources", "grip", "section"});
  static_cast<void>(root.integer("schema", 1, 1));
  InstrumentFile file;
  file.path = name;
  file.instrument.model = root.string("model", "a name");
  file.description = root.string_or("description", "", "a text");
  SourcedReader reader(read_sources(root), file.values);
  const std::optional<TomlTable> grip = root.table("grip", {"force_n", "torque_n_mm"});
  if (!grip) root.refuse_missing("grip", "a table with force_n and torque_n_mm");
  file.instrument.grip_force_n = reader.constant(*grip, "force_n", above(0.0));
  file.instrument.grip_torque_n_mm = reader.constant(*grip, "torque_n_mm", above(0.0));
  for (const TomlTable& section : root.tables(
           "section", {"length_mm", "radius_mm", "flexural_rigidity_n_mm2", "torsional_rigidity_n_mm2",
                       "axial_rigidity_n", "linear_density_g_per_mm", "friction", "rest_curvature_per_mm",
                       "rest_plane_deg", "kink_curvature_per_mm", "radiopacity"}))
    file.instrument.sections.push_back(read_section(section, reader));
  if (file.instrument.sections.empty())
    root.refuse_missing("section", "at least one [[section]], from the tip to the hand");
  file.instrument.validate(name);
  return file;
}

InstrumentFile read_instrument_file(const fs::path& path) {
  return parse_instrument(read_file(path, max_instrument_bytes), one_line(path.string()));
}

std::vector<std::string> list_instruments(const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  }
  return {names.begin(), names.end()};
}

fs::path find_instrument(const std::string& model, const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    fs::path path = folder / (model + ".toml");
    std::error_code error;
    if (fs::is_regular_file(path, error)) return path;
  }
  return {};
}

}  // namespace endowire::io

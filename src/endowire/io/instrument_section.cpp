#include "endowire/io/instrument_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace endowire::io {

namespace {

constexpr double max_length_mm = 10'000.0;  // three times the longest wire made

Range above_to(double low, double high) {
  Range range = above(low);
  range.high = high;
  return range;
}

Range kink_range() {
  Range range = above(0.0);
  range.infinite_allowed = true;
  return range;
}

std::string names_of(const FileMaterials& materials) {
  std::string names;
  for (const auto& [name, material] : materials) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "the name of a [material.NAME] of this file" : "one of " + names;
}

const FileMaterial& material_of(const TomlTable& table, std::string_view key,
                                const FileMaterials& materials) {
  const std::string name = table.string(key, names_of(materials));
  const auto found = materials.find(name);
  if (found == materials.end()) table.refuse(key, '"' + name + '"', names_of(materials));
  return found->second;
}

/// The core whose section bends as the file says.
rod::Taper core_that_bends_so(const TomlTable& table, const rod::Construction& construction,
                              SourcedReader& reader) {
  const char* const key = "flexural_rigidity_n_mm2";
  const rod::Taper asked = reader.taper(table, key, above(0.0));
  const auto rigidity = [&](double diameter) {
    rod::Construction other = construction;
    other.core_diameter_mm = diameter;
    return rod::flexural_rigidity_n_mm2(other);
  };
  const double least = rigidity(construction.bore_mm);
  const double most = rigidity(construction.outer_diameter_mm);
  for (const double value : {asked.at_tip_side, asked.at_hand_side}) {
    if (!(value > least && value <= most))
      table.refuse(key, fmt::format("{}", value),
                   fmt::format("> {:.4g} and <= {:.4g}: a core between bore and surface", least, most));
  }
  const rod::Taper diameter(rod::core_diameter_mm(construction, asked.at_tip_side),
                            rod::core_diameter_mm(construction, asked.at_hand_side));
  reader.follows(table.path_of("core_diameter_mm"), diameter, "flexural_rigidity_n_mm2");
  return diameter;
}

/// What follows from core and coat, but for what the file says itself.
void read_built(const TomlTable& table, const FileMaterials& materials, SourcedReader& reader,
                rod::Section& section) {
  rod::Construction construction;
  const FileMaterial& core = material_of(table, "core", materials);
  const FileMaterial surface = table.has("coat") ? material_of(table, "coat", materials) : core;
  construction.core = core.material;
  if (table.has("coat")) construction.coat = surface.material;
  if (section.radius_mm.at_tip_side != section.radius_mm.at_hand_side)
    table.refuse("radius_mm", "a taper", "one value in a section with a core");
  construction.outer_diameter_mm = 2.0 * section.radius_mm.at_tip_side;
  construction.bore_mm =
      reader.constant_or(table, "bore_mm", 0.0, between(0.0, construction.outer_diameter_mm));
  if (table.has("core_diameter_mm") == table.has("flexural_rigidity_n_mm2"))
    table.refuse("core_diameter_mm", table.has("core_diameter_mm") ? "given" : "missing",
                 "given, or else flexural_rigidity_n_mm2");
  construction.core_diameter_mm = table.has("core_diameter_mm")
                                      ? reader.taper(table, "core_diameter_mm", above(0.0))
                                      : core_that_bends_so(table, construction, reader);
  rod::apply(construction, table.file() + ": " + table.path_of(""), section);
  const auto give = [&](const char* key, rod::Taper rod::Section::*field, const Range& range) {
    if (table.has(key))
      section.*field = reader.taper(table, key, range);
    else
      reader.follows(table.path_of(key), section.*field, "core and coat");
  };
  if (table.has("core_diameter_mm"))
    reader.follows(table.path_of("flexural_rigidity_n_mm2"), section.flexural_rigidity_n_mm2,
                   "core and coat");
  give("torsional_rigidity_n_mm2", &rod::Section::torsional_rigidity_n_mm2, above(0.0));
  give("axial_rigidity_n", &rod::Section::axial_rigidity_n, above(0.0));
  give("linear_density_g_per_mm", &rod::Section::linear_density_g_per_mm, at_least(0.0));
  give("kink_curvature_per_mm", &rod::Section::kink_curvature_per_mm, kink_range());
  give("radiopacity", &rod::Section::radiopacity, at_least(0.0));
  if (table.has("friction") || !surface.friction) {
    section.friction = reader.constant(table, "friction", between(0.0, 2.0));
  } else {
    section.friction = *surface.friction;
    reader.follows(table.path_of("friction"), section.friction, "the material of the surface");
  }
}

void read_plain(const TomlTable& table, SourcedReader& reader, rod::Section& section) {
  for (const char* const key : {"core_diameter_mm", "bore_mm", "coat"})
    if (table.has(key)) table.refuse(key, "given", "left out in a section without a core");
  section.flexural_rigidity_n_mm2 = reader.taper(table, "flexural_rigidity_n_mm2", above(0.0));
  section.torsional_rigidity_n_mm2 = reader.taper(table, "torsional_rigidity_n_mm2", above(0.0));
  section.axial_rigidity_n = reader.taper(table, "axial_rigidity_n", above(0.0));
  section.linear_density_g_per_mm = reader.taper(table, "linear_density_g_per_mm", at_least(0.0));
  section.friction = reader.constant(table, "friction", between(0.0, 2.0));
  section.kink_curvature_per_mm =
      reader.taper_or(table, "kink_curvature_per_mm", section.kink_curvature_per_mm, kink_range());
  section.radiopacity = reader.taper_or(table, "radiopacity", section.radiopacity, at_least(0.0));
}

rod::Section read_section(const TomlTable& table, const FileMaterials& materials, SourcedReader& reader) {
  rod::Section section;
  section.length_mm = reader.constant(table, "length_mm", above_to(0.0, max_length_mm));
  section.radius_mm = reader.taper(table, "radius_mm", above_to(0.0, 10.0));
  if (table.has("core"))
    read_built(table, materials, reader, section);
  else
    read_plain(table, reader, section);
  section.flexural_ratio = reader.constant_or(table, "flexural_ratio", 1.0, between(0.01, 100.0));
  section.rest_curvature_per_mm =
      reader.constant_or(table, "rest_curvature_per_mm", 0.0, between(-10.0, 10.0));
  section.rest_plane_rad =
      reader.constant_or(table, "rest_plane_deg", 0.0, between(-360.0, 360.0)) * std::numbers::pi / 180.0;
  return section;
}

}  // namespace

FileMaterials read_materials(const TomlTable& root, SourcedReader& reader) {
  FileMaterials materials;
  const toml::node* node = root.raw().get("material");
  if (node == nullptr) return materials;
  if (!node->is_table()) root.refuse("material", "no table", "tables [material.NAME]");
  for (const auto& [key, value] : *node->as_table()) {
    const std::string path = fmt::format("material.{}", key.str());
    if (!value.is_table()) root.refuse(path, "no table", "a table [material.NAME]");
    const TomlTable table(
        *value.as_table(), root.file(), path,
        {"modulus_mpa", "poisson_ratio", "density_g_per_mm3", "strain_limit", "attenuation", "friction"});
    FileMaterial read;
    rod::Material& material = read.material;
    material.modulus_mpa = reader.constant(table, "modulus_mpa", between(0.0, 1e6));
    material.poisson_ratio =
        reader.constant_or(table, "poisson_ratio", material.poisson_ratio, between(0.0, 0.5));
    material.density_g_per_mm3 = reader.constant(table, "density_g_per_mm3", between(0.0, 0.03));
    material.strain_limit =
        reader.constant_or(table, "strain_limit", material.strain_limit, above_to(0.0, 1.0));
    material.attenuation = reader.constant(table, "attenuation", between(0.0, 100.0));
    if (table.has("friction")) read.friction = reader.constant(table, "friction", between(0.0, 2.0));
    materials.emplace(key.str(), read);
  }
  return materials;
}

std::vector<rod::Section> read_sections(const TomlTable& root, const FileMaterials& materials,
                                        SourcedReader& reader) {
  std::vector<rod::Section> sections;
  for (const TomlTable& table : root.tables(
           "section", {"length_mm", "radius_mm", "flexural_rigidity_n_mm2", "torsional_rigidity_n_mm2",
                       "axial_rigidity_n", "linear_density_g_per_mm", "friction", "rest_curvature_per_mm",
                       "rest_plane_deg", "kink_curvature_per_mm", "radiopacity", "flexural_ratio", "core",
                       "core_diameter_mm", "bore_mm", "coat"}))
    sections.push_back(read_section(table, materials, reader));
  if (sections.empty()) root.refuse_missing("section", "at least one [[section]], from the tip to the hand");
  return sections;
}

}  // namespace endowire::io

#include "endowire/io/instrument_file.hpp"

#include <fmt/format.h>

#include <set>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/instrument_section.hpp"
#include "endowire/io/instrument_shape.hpp"
#include "endowire/io/toml_table.hpp"

namespace endowire::io {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t max_instrument_bytes = 1 << 20;  // a hand-written file; anything longer is a mistake

/// The shape of [[shape]], unless the sections bend themselves.
void lay_shape(const TomlTable& root, SourcedReader& reader, rod::Instrument& instrument) {
  const std::vector<rod::RestPiece> pieces = read_shape(root, reader);
  if (pieces.empty()) return;
  for (std::size_t k = 0; k < instrument.sections.size(); ++k) {
    if (instrument.sections[k].rest_curvature_per_mm != 0.0)
      root.refuse(fmt::format("section[{}].rest_curvature_per_mm", k), "given beside [[shape]]",
                  "left out, or else the shape");
  }
  rod::lay_rest_shape(pieces, 0.0, root.file() + ": shape", instrument);
}

}  // namespace

InstrumentFile parse_instrument(const std::string& text, const std::string& name) {
  const toml::table toml = parse_toml(text, name);
  const TomlTable root(
      toml, name, "",
      {"schema", "model", "description", "sources", "grip", "shapeable_mm", "material", "section", "shape"});
  static_cast<void>(root.integer("schema", 1, 1));
  InstrumentFile file;
  file.path = name;
  rod::Instrument& instrument = file.instrument;
  instrument.model = root.string("model", "a name");
  file.description = root.string_or("description", "", "a text");
  SourcedReader reader(read_sources(root), file.values);
  const std::optional<TomlTable> grip = root.table("grip", {"force_n", "torque_n_mm"});
  if (!grip) root.refuse_missing("grip", "a table with force_n and torque_n_mm");
  instrument.grip_force_n = reader.constant(*grip, "force_n", above(0.0));
  instrument.grip_torque_n_mm = reader.constant(*grip, "torque_n_mm", above(0.0));
  const FileMaterials materials = read_materials(root, reader);
  instrument.sections = read_sections(root, materials, reader);
  lay_shape(root, reader, instrument);
  instrument.shapeable_mm = reader.constant_or(root, "shapeable_mm", 0.0, at_least(0.0));
  instrument.validate(name);
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

#pragma once

#include <map>
#include <optional>
#include <string>

#include "endowire/io/sourced_reader.hpp"
#include "endowire/rod/construction.hpp"

namespace endowire::io {

/// A material of a file: what a core or a coat is made of, and how it rubs where it is the surface.
struct FileMaterial {
  rod::Material material;
  std::optional<double> friction;
};
using FileMaterials = std::map<std::string, FileMaterial>;

/// The tables [material.NAME].
[[nodiscard]] FileMaterials read_materials(const TomlTable& root, SourcedReader& reader);

/// The tables [[section]], from the tip to the hand.
[[nodiscard]] std::vector<rod::Section> read_sections(const TomlTable& root, const FileMaterials& materials,
                                                      SourcedReader& reader);

}  // namespace endowire::io

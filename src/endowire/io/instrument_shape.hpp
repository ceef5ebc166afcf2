#pragma once

#include "endowire/io/sourced_reader.hpp"
#include "endowire/rod/rest_shape.hpp"

namespace endowire::io {

/// The tables [[shape]]: the unloaded shape from the tip on, as straights, arcs, helices and lists of points.
[[nodiscard]] std::vector<rod::RestPiece> read_shape(const TomlTable& root, SourcedReader& reader);

}  // namespace endowire::io

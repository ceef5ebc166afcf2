#pragma once

#include <nlohmann/json_fwd.hpp>

#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::io {

/// The tree as markups of 3D Slicer (`.mrk.json`): a curve for each branch, named after it, through its points, with the measurement
/// "Radius" [mm] at each of them. Coordinates are written as they are in the tree, in mm, and declared LPS: that is the frame of
/// vessels from images.
/// Source  3D Slicer, developer guide, markups JSON file format, schema 1.0.3
[[nodiscard]] nlohmann::ordered_json slicer_markups(const vessel::CentrelineTree& tree);

}  // namespace endowire::io

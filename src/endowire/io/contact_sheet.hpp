#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/vessel_ends.hpp"

namespace endowire::io {

/// A vessel from three sides at one scale, as a PNG file: the wall as tinted glass, centrelines coloured by the radius of
/// the lumen, ends with their numbers (openings filled, closed ends as rings), a scale bar and the scale of colours.
[[nodiscard]] std::string contact_sheet_png(const vessel::TriangleMesh& mesh,
                                            const vessel::CentrelineTree& tree,
                                            const std::vector<vessel::VesselEnd>& ends);

}  // namespace endowire::io

#pragma once

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"

namespace endowire::vessel {

/// Pairs of triangles that pass through each other: an edge of one crosses the inside of the other. Triangles that only
/// touch, or share an edge, do not count.
[[nodiscard]] FlawPlaces self_intersections(const TriangleMesh& mesh);

}  // namespace endowire::vessel

#pragma once

#include <array>
#include <cstdint>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"

namespace endowire::vessel {

/// Corners closer than a tolerance become one vertex. Vertices are sorted by coordinates: the result depends on no
/// order.
[[nodiscard]] TriangleMesh merge_points(const TriangleMesh& soup, double tolerance_mm);

/// Drops triangles of which two corners coincide, and all but one of those with the same corners; sorts the rest.
void drop_bad_triangles(TriangleMesh& mesh, MeshReport& report);

/// Smallest index first, cyclic order kept.
void rotate_smallest_first(std::array<std::int32_t, 3>& triangle);

}  // namespace endowire::vessel

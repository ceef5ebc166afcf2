#pragma once

#include <cstddef>

#include "endowire/vessel/brick_kernels.hpp"
#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_field.hpp"

namespace endowire::vessel {

/// Place of a node of a brick among its samples.
[[nodiscard]] inline std::size_t brick_node(int i, int j, int k) {
  return static_cast<std::size_t>((i * MeshField::nodes + j) * MeshField::nodes + k);
}

/// Puts right the signs of distances at the nodes of a brick. Where two neighbouring nodes differ in sign though their distances say that no
/// wall is between them, a flaw of the mesh misled the pseudonormal; the winding number decides for the whole connected set of nodes.
/// @param nodes       places and signed distances, as brick_node counts them
/// @param spacing_mm  of neighbouring nodes
/// @param closed      the mesh
void settle_signs(PointBlock& nodes, double spacing_mm, const TriangleMesh& closed);

}  // namespace endowire::vessel

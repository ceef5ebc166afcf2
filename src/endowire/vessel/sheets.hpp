#pragma once

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"

namespace endowire::vessel {

/// Drops what hangs on edges of three or more triangles and bounds no lumen, and counts those edges.
///
///        │ fin: has a free border            ┌───┬───┐ membrane: all its border lies on
///   ─────┴─────  and little area             │   │   │ edges of three, the rest of the mesh
///                                            └───┴───┘ encloses it
///
/// What is neither stays: vessels that touch along an edge, flaps that lie against the wall, sheets too large to be a
/// flaw.
void drop_sheets(TriangleMesh& mesh, MeshReport& report);

}  // namespace endowire::vessel

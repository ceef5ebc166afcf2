#pragma once

#include <cstddef>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// Cuts open ends whose border is ragged back to a plane across the vessel.
///
///        ragged border            cut
///     ─────────────╲  ╱─╲      ────────┐
///      lumen        ╲╱   ╲      lumen  │  plane normal to the vessel's axis: the direction that the
///     ───────────────────        ──────┘  normals around the end have least of; behind all of the border
///
/// Triangles that the plane divides are split. A border that is even to a tenth of its diameter stays, and so does one
/// where the plane would take off more than an end of the vessel.
/// @return  how many ends were cut
std::size_t cut_ragged_ends(TriangleMesh& mesh);

}  // namespace endowire::vessel

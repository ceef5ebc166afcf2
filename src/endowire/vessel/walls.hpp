#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"
#include "endowire/vessel/orientation.hpp"

namespace endowire::vessel {

/// Leaves of a vessel wall that was modelled as a solid with a thickness the surface of its lumen, facing outward.
///
///     outer surface ───────────────┐ rim        a lumen lies before the triangles of the inner surface:
///     inner surface ─────────────┐ │            most of a half ball of rays from them, out of the solid,
///        lumen                   · ·            meets the model again, and behind them, through the solid,
///     inner surface ─────────────┘ │            lies a surface of which that is not so
///     outer surface ───────────────┘
///
/// Two surfaces in separate pieces: the one that lies in the other. One piece, joined by rims or by what else the ends
/// are made of: parts between sharp edges of which the lines above hold; where the lumen's border is no sharp edge,
/// triangle by triangle. Of a mesh that is no wall nothing is changed.
/// @param mesh    faces outward, as orient_pieces leaves it
/// @param depths  what orient_pieces returned
/// @return        whether it was a wall; then the report says so
/// @throws base::InputError naming a place when the inner surface is in shreds
[[nodiscard]] bool take_lumen_of_wall(TriangleMesh& mesh, const Pieces& pieces,
                                      const std::vector<int>& depths, MeshReport& report,
                                      const std::string& file_label);

}  // namespace endowire::vessel

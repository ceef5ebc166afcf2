#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"
#include "endowire/vessel/openings.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::vessel {

/// A mesh that is indexed, consistently oriented (outward) and understood; its triangles are in an order that
/// depends on coordinates only, never on the order of the file.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Opening> openings;
  std::vector<PinHole> pin_holes;
  MeshReport report;
};

/// Index, clean, orient and classify.
///
///   corners closer than 1e-6 of the bounding box diagonal become one vertex (merge_points)
///   triangles of no extent and doubles go (drop_bad_triangles), then fins and membranes (drop_sheets)
///   neighbours agree (orient_patches); pieces face outward by the sign of their volume, or by nesting (orient_pieces)
///   of a vessel wall the surface of its lumen is left (take_lumen_of_wall); pieces too small to be vessels go
///   borders become openings and pin holes (find_borders); triangles that pass through each other are listed
///
/// @param soup        triangles as read
/// @param file_label  name for messages
/// @param unit        the unit that was applied, named when the size is absurd
/// @throws base::InputError when the extent is outside min_extent_mm … max_extent_mm, no triangle is left, or the
///                          surface has one side only; the message says where
[[nodiscard]] RepairedMesh repair(const TriangleMesh& soup, const std::string& file_label,
                                  LengthUnit unit = LengthUnit::millimetre);

}  // namespace endowire::vessel

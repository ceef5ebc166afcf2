#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::vessel {

/// An end of the vessel where the mesh is open.
struct Opening {
  int number = 0;  ///< from 1, in the order of the boundary loops' smallest vertex
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< out of the vessel, length one
  double diameter_mm = 0.0;                             ///< of the circle with the loop's area
  std::vector<std::int32_t> loop;  ///< vertices in order; the triangles lie left of it seen from outside
};

/// A small hole in the wall, treated as wall.
struct PinHole {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double diameter_mm = 0.0;
  std::vector<std::int32_t> loop;
};

/// What a mesh was and what was done to it.
struct MeshReport {
  std::size_t triangles_in_file = 0;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t merged_points = 0;  ///< corners that share a vertex after merging beyond the first of each
  std::size_t degenerate_triangles = 0;  ///< dropped: two corners coincide
  std::size_t sliver_triangles = 0;      ///< kept: no area though the corners differ
  std::size_t duplicate_triangles = 0;   ///< dropped
  std::size_t flipped_triangles = 0;     ///< turned to face outward
  bool inward_in_file = false;           ///< most triangles of the file faced inward
  std::size_t non_manifold_edges = 0;    ///< edges of three or more triangles
  std::size_t components = 0;
  bool wall_with_thickness = false;  ///< a component encloses another: the solid is a wall, not a lumen
  Eigen::AlignedBox3d bounds_mm;
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;
};

/// A mesh that is indexed, consistently oriented (outward) and understood; its triangles are in an order that
/// depends on coordinates only, never on the order of the file.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Opening> openings;
  std::vector<PinHole> pin_holes;
  MeshReport report;
};

/// Shortest and longest diagonal of the bounding box that a vessel may have: from a coronary fragment to a
/// body.
inline constexpr double min_extent_mm = 5.0;
inline constexpr double max_extent_mm = 3000.0;

/// A boundary loop is a vessel end when its diameter is at least this part of the lumen's diameter beside it;
/// smaller ones are pin holes. Vessel ends measure 0.9 to 1.1, pin holes in walls below 0.3.
inline constexpr double opening_min_lumen_fraction = 0.5;
/// A vessel end is a ring: fewer vertices, or a hole too small for any instrument, are a flaw of the mesh.
inline constexpr std::size_t opening_min_vertices = 5;
inline constexpr double opening_min_diameter_mm = 0.5;

/// Index, clean, orient and classify.
///
/// Corners closer than 1e-6 of the bounding box diagonal become one vertex. Orientation spreads over manifold
/// edges; which side is out follows from the sign of the volume, or from nesting where components enclose
/// others.
/// @param soup        triangles as read
/// @param file_label  name for messages
/// @param unit        the unit that was applied, named when the size is absurd
/// @throws InputError when the extent is outside min_extent_mm … max_extent_mm or no triangle is left
[[nodiscard]] RepairedMesh repair(const TriangleMesh& soup, const std::string& file_label,
                                  LengthUnit unit = LengthUnit::millimetre);

}  // namespace endowire::vessel

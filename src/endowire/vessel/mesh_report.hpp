#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace endowire::vessel {

/// Where flaws of one kind lie: all counted, the first few named.
struct FlawPlaces {
  static constexpr std::size_t most_named = 5;
  std::size_t count = 0;
  std::vector<Eigen::Vector3d> first_mm;

  void add(const Eigen::Vector3d& place_mm) {
    if (count++ < most_named) first_mm.push_back(place_mm);
  }
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
  FlawPlaces non_manifold_edges;         ///< edges of three or more triangles in the file
  FlawPlaces fins;                ///< dropped: sheets that hang on the wall by one edge and end in nothing
  FlawPlaces membranes;           ///< dropped: sheets across the lumen
  FlawPlaces self_intersections;  ///< kept: pairs of triangles that pass through each other
  std::size_t components_in_file = 0;  ///< pieces of surface, connected over any edge
  std::size_t components = 0;          ///< that are used
  FlawPlaces debris;                   ///< dropped: pieces too small to be vessels
  bool wall_with_thickness = false;    ///< the file is a vessel wall, not a lumen: its inner surface is used
  std::size_t wall_triangles = 0;      ///< of that wall, dropped: its outer surface and its rims
  std::size_t cut_ends = 0;            ///< of that wall, whose rim had no edge: cut back to a plane
  Eigen::AlignedBox3d bounds_mm;
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;
};

}  // namespace endowire::vessel

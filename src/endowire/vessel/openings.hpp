#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "endowire/vessel/mesh.hpp"

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

/// A boundary loop is a vessel end when its diameter is at least this part of the lumen's diameter beside it;
/// smaller ones are pin holes. Vessel ends measure 0.9 to 1.1, pin holes in walls below 0.3.
inline constexpr double opening_min_lumen_fraction = 0.5;
/// A vessel end is a ring: fewer vertices, or a hole too small for any instrument, are a flaw of the mesh.
inline constexpr std::size_t opening_min_vertices = 5;
inline constexpr double opening_min_diameter_mm = 0.5;

/// The boundary loops of a mesh that faces outward, told apart.
struct Borders {
  std::vector<Opening> openings;
  std::vector<PinHole> pin_holes;
};
[[nodiscard]] Borders find_borders(const TriangleMesh& mesh);

}  // namespace endowire::vessel

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// A named point inside a generated vessel.
struct Landmark {
  std::string name;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double lumen_radius_mm = 0.0;
};

/// A vessel made in code, and where to enter it.
struct GeneratedVessel {
  TriangleMesh mesh;  ///< closed, facing outward
  Eigen::Vector3d access_position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d access_direction = Eigen::Vector3d::Zero();  ///< into the vessel, length one
  std::vector<Landmark> landmarks;
  double route_mm = 0.0;  ///< centreline from the access to the end of the arch
};

/// A tube tree in the likeness of iliac arteries, aorta, arch and two arch branches; about 450 mm of route.
///
///   F(x) = min_i d_i(x) within a vessel, −k log Σ_v exp(−F_v(x)/k) over vessels,
///   d_i = |x − nearest point of segment i| − its radius there
///
/// The union F = 0 of tapered segments, its ostia and carinas rounded by k = 0.6 mm, is sampled on a grid of
/// 2 mm and meshed by marching tetrahedra: six to a cell, always closed and manifold. Deterministic.
[[nodiscard]] GeneratedVessel tube_tree();

}  // namespace endowire::vessel

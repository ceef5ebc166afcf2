#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "endowire/vessel/repair.hpp"

namespace endowire::vessel {

/// A virtual tube behind an opening: the loop swept along the opening's direction and capped.
struct VirtualTube {
  Eigen::Vector3d centre_mm;  ///< of the opening
  Eigen::Vector3d direction;  ///< out of the vessel
  double begin_mm = 0.0;  ///< along direction from the centre: behind the whole loop, so beyond it is outside
  double end_mm = 0.0;    ///< where the cap is
  double radius_mm = 0.0;  ///< of the cylinder around the swept loop
};

/// A vessel closed everywhere: pin holes filled, openings extended by virtual tubes.
struct ClosedSurface {
  TriangleMesh mesh;               ///< the triangles of the repaired mesh first, in their order
  std::size_t wall_triangles = 0;  ///< that are the vessel's own or fill a pin hole; the rest are virtual
  std::vector<VirtualTube> tubes;  ///< one per opening
};

/// Fans over pin holes, tubes over openings. A tube is `tube_mm` long, shorter where it would come within 2.5
/// mm of the vessel's own wall or of an earlier tube (a virtual wall must not stand in a real lumen).
[[nodiscard]] ClosedSurface close_surface(const RepairedMesh& repaired, double tube_mm);

}  // namespace endowire::vessel

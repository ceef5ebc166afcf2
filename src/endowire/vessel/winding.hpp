#pragma once

#include <Eigen/Core>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// Generalised winding number of a mesh around a point: 1 inside a closed mesh that faces outward, 0 outside.
///
///   w = Σ Ω_t / 4π,   tan(Ω/2) = a·(b×c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|)
///
/// Source  A. van Oosterom & J. Strackee, IEEE Trans. Biomed. Eng. 30:125, 1983; A. Jacobson et al., ACM
/// Trans.
///         Graph. 32(4):33, 2013. O(triangles).
[[nodiscard]] double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm);

}  // namespace endowire::vessel

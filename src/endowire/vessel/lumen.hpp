#pragma once

#include <vector>

#include "endowire/vessel/surface.hpp"

namespace endowire::vessel {

/// What stands before and behind each triangle of a closed vessel surface.
struct LumenOfTriangles {
  std::vector<double> radius_mm;  ///< of the lumen inside, median over the neighbours
  std::vector<double> tissue_mm;  ///< outside, to another lumen; infinity beyond max_tissue_mm
};

/// Tissue thicker than this counts as endless: no wire deflects a wall that far.
inline constexpr double max_tissue_mm = 5.0;

/// Measures the lumen by the largest inscribed ball found along the inward normal, and the tissue by outward
/// rays.
///
///   R = max φ(p − t n),  t ∈ {¼, ⅜, ½, ⅝} T,   T the length of the inward ray
///
/// The normal of a facet points at the axis, whatever the facet's size, so that R is exact for prisms; the
/// median over neighbours removes what rays see at ostia and caps.
[[nodiscard]] LumenOfTriangles measure_lumen(const ExactSurface& surface, std::size_t wall_triangles);

}  // namespace endowire::vessel

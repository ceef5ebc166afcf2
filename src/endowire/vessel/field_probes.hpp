#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/lumen.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire::vessel {

// What a field is measured by.

/// A point, and how far a field misses the distance to the triangles there.
struct FieldProbe {
  Eigen::Vector3d point_mm;
  double error_mm;
};

/// Probes at random near a vessel's own wall, as dense everywhere by area: up to `near_mm` of the parameters inside,
/// `near_outside_mm` outside.
[[nodiscard]] std::vector<FieldProbe> probe_near_wall(const MeshField& field, const ClosedSurface& closed,
                                                      const ExactSurface& surface,
                                                      const FieldParameters& parameters, std::size_t count,
                                                      std::uint64_t seed);

/// Diameters of the lumen that 5, 25, 50, 75 and 95 % of the wall's area stay below [mm].
[[nodiscard]] std::array<double, 5> diameter_percentiles_mm(const ClosedSurface& closed,
                                                            const LumenOfTriangles& lumen);

}  // namespace endowire::vessel

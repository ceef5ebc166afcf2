#pragma once

#include <Eigen/Core>

#include "endowire/contact/sample.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::sim {

/// Whether a wire lies in the lumen all along, within what the wall may yield. Asked of shapes that are no equilibria.
[[nodiscard]] bool lies_clear(const contact::Wire& wire, const vessel::Field& field,
                              double max_deflection_mm);

/// Whether a tip, which slid along the wall, has come straight through what of it stands out: a step too long to follow it.
/// In a snap, which takes it further than twice the advance, it may; its way is that of the waypoints.
[[nodiscard]] bool cuts_corner(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                               const Eigen::Vector3d& to_mm, double radius_mm, double advance_mm);

}  // namespace endowire::sim

#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "endowire/contact/sample.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::sim {

/// Whether a wire lies in the lumen all along, within what the wall may yield. Asked of shapes that are no equilibria.
[[nodiscard]] bool lies_clear(const contact::Wire& wire, const vessel::Field& field,
                              double max_deflection_mm);

/// Whether a tip, which slid along the wall, has come straight through what of it stands out: a step too long to follow it.
/// In a snap, which takes it further than twice the advance, it may; its way is that of the waypoints, see leg_cuts_corner().
[[nodiscard]] bool cuts_corner(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                               const Eigen::Vector3d& to_mm, double radius_mm, double advance_mm);

/// The axis of a wire at one moment: joints and their material arcs, from the tip.
struct AxisShape {
  const Eigen::Vector3d* joints_mm = nullptr;
  const double* arc_mm = nullptr;
  std::size_t joints = 0;
};

/// Whether some point of the wire, on its way from one shape to the next, has come straight through what of the wall stands out:
/// nearer to it than a quarter of its radius and than at either end of its way. The shapes are those that a snap is told by.
[[nodiscard]] bool leg_cuts_corner(const vessel::Field& field, const rod::MaterialLine& line,
                                   const AxisShape& from, const AxisShape& to);

}  // namespace endowire::sim

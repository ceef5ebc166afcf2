#pragma once

#include "endowire/contact/contact_spec.hpp"
#include "endowire/contact/sample.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::contact {

/// Where a straight path through the lumen ends: at `to_mm`, or just before the wall that it would pass.
[[nodiscard]] Eigen::Vector3d reachable_point_mm(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                                                 const Eigen::Vector3d& to_mm);

/// Where a point of a wire of this radius comes to that is pushed along a straight path: at a wall it goes on along the wall.
/// It never passes one.
[[nodiscard]] Eigen::Vector3d slid_point_mm(const vessel::Field& field, const Eigen::Vector3d& from_mm,
                                            const Eigen::Vector3d& to_mm, double radius_mm);

/// Finds up to four local walls around sample.detected_at_mm, which must be set and lie in the lumen; where that is nearer to
/// the wall than the wire's radius, it is lifted to the radius first.
///
/// The nearest wall is a plane; round, where the field a little way off on both sides has the heights and slopes of a circle;
/// or two planes of a ridge, where it is convex along the wire. Where the field there is nearer than that predicts (a corner
/// between two facets, the far side of a narrow lumen, both sides of a carina), another wall is added, as a plane.
/// @param tangent  of the wire, unit
void find_local_walls(const vessel::Field& field, const ContactSpec& spec, const Eigen::Vector3d& tangent,
                      Sample& sample);

}  // namespace endowire::contact

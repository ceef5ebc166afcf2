#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/instrument.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::rod {

/// A piece of the unloaded shape: of constant curvature, whose direction turns about the wire at a constant rate. Without torsion an arc,
/// with it a helix.
struct RestPiece {
  double length_mm = 0.0;
  double curvature_per_mm = 0.0;
  double plane_rad = 0.0;       ///< direction of the curvature at the tip side
  double torsion_per_mm = 0.0;  ///< turn of that direction per length towards the hand
};

[[nodiscard]] RestPiece straight_piece(double length_mm);
/// @param angle_rad  turn over the arc; its sign is that of the curvature
[[nodiscard]] RestPiece arc_piece(double radius_mm, double angle_rad, double plane_rad = 0.0);
/// @param pitch_mm  advance in a turn; > 0 right-handed, < 0 left-handed
/// @param turns     > 0
[[nodiscard]] RestPiece helix_piece(double radius_mm, double pitch_mm, double turns, double plane_rad = 0.0);

/// Arcs through points of the unloaded wire, from the tip to the hand: at each inner point one that turns by the angle between the chords,
/// from the middle of one chord to that of the next. A circle and its length come out exactly; the plane of the turn at the last inner point
/// is 0.
/// @param points_mm  at least three; no two neighbours at one place, no turn of 150° or more
[[nodiscard]] std::vector<RestPiece> pieces_through(const std::vector<Eigen::Vector3d>& points_mm);

/// Gives the instrument this unloaded shape from the tip on, straight behind it; what was there before is forgotten over `over_mm`, at
/// least the length of the pieces. Sections are cut where pieces end.
/// @throws base::InputError  when the pieces are longer than the instrument
void lay_rest_shape(const std::vector<RestPiece>& pieces, double over_mm, const std::string& where,
                    Instrument& instrument);

/// The unloaded wire from the tip to an arc, a joint every `spacing_mm`: it comes along x to the origin at that arc; plane 0 is y.
[[nodiscard]] std::vector<Eigen::Vector3d> unloaded_joints_mm(const MaterialLine& line, double to_mm,
                                                              double spacing_mm);

/// How the user bends a tip that can be bent.
struct TipBend {
  double angle_rad = 0.0;
  double length_mm = 0.0;  ///< over which it bends, from the end of the tip
};

/// Bends the tip; the rest of what can be bent is straight.
/// @throws base::InputError  when the instrument cannot be bent so far from its tip
void bend_tip(const TipBend& bend, const std::string& where, Instrument& instrument);

}  // namespace endowire::rod

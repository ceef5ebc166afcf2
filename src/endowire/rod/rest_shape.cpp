#include "endowire/rod/rest_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "endowire/base/contract.hpp"
#include "endowire/base/error.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::rod {

namespace {

using Eigen::Vector3d;

/// Cuts shorter than this would be sections of their own; they belong to their neighbours.
constexpr double kLeastCut_mm = 0.1;

/// The same direction within half a turn of 0: a helix that goes on from section to section turns far.
double within_half_a_turn(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

/// Linear in the root of the taper, so that a part of it is a taper again.
Taper part_of(const Taper& taper, double first, double last) {
  const Profile profile(taper);
  return {first > 0.0 ? profile.at(first) : taper.at_tip_side,
          last < 1.0 ? profile.at(last) : taper.at_hand_side, taper.power, taper.base};
}

Section part_of(const Section& section, double from_mm, double to_mm) {
  const double first = from_mm / section.length_mm;
  const double last = to_mm / section.length_mm;
  Section part = section;
  part.length_mm = to_mm - from_mm;
  for (Taper Section::*taper :
       {&Section::flexural_rigidity_n_mm2, &Section::torsional_rigidity_n_mm2, &Section::axial_rigidity_n,
        &Section::radius_mm, &Section::linear_density_g_per_mm, &Section::kink_curvature_per_mm,
        &Section::radiopacity})
    part.*taper = part_of(section.*taper, first, last);
  part.rest_plane_rad = within_half_a_turn(section.rest_plane_rad + section.rest_torsion_per_mm * from_mm);
  return part;
}

/// Cuts the section that this arc lies in, unless it ends there.
void cut_at(double arc_mm, std::vector<Section>& sections) {
  double start = 0.0;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const double length = sections[k].length_mm;
    const double inside = arc_mm - start;
    if (inside < kLeastCut_mm) return;
    if (inside <= length - kLeastCut_mm) {
      const Section whole = sections[k];
      sections[k] = part_of(whole, 0.0, inside);
      sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(k) + 1, part_of(whole, inside, length));
      return;
    }
    start += length;
  }
}

}  // namespace

RestPiece straight_piece(double length_mm) {
  return {length_mm, 0.0, 0.0, 0.0};
}

RestPiece arc_piece(double radius_mm, double angle_rad, double plane_rad) {
  return {radius_mm * std::abs(angle_rad), std::copysign(1.0 / radius_mm, angle_rad), plane_rad, 0.0};
}

RestPiece helix_piece(double radius_mm, double pitch_mm, double turns, double plane_rad) {
  // κ = r/(r² + c²), τ = c/(r² + c²), c the pitch per radian; a right-handed curve turns its curvature rightwards about the tangent, which
  // points to the tip, while the arc counts to the hand.
  const double c = pitch_mm / (2.0 * std::numbers::pi);
  const double square = radius_mm * radius_mm + c * c;
  return {2.0 * std::numbers::pi * turns * std::sqrt(square), radius_mm / square, plane_rad, -c / square};
}

std::vector<RestPiece> pieces_through(const std::vector<Vector3d>& points_mm) {
  const std::size_t n = points_mm.size();
  ENDOWIRE_EXPECTS(n >= 3, "a bend has three points");
  std::vector<Vector3d> chord(n - 1);  // towards the tip
  for (std::size_t i = 0; i + 1 < n; ++i) chord[i] = points_mm[i] - points_mm[i + 1];
  // From the hand to the tip: the frame is transported, so that it twists nowhere.
  std::vector<RestPiece> pieces(n - 2);
  Vector3d plane_zero = Vector3d::Zero();
  for (std::size_t j = n - 2; j >= 1; --j) {
    const Vector3d hand = chord[j].normalized();
    const Vector3d tip = chord[j - 1].normalized();
    const double turn = std::atan2(hand.cross(tip).norm(), hand.dot(tip));
    const bool bends = turn > 1e-9;
    const Vector3d sideways = bends ? math::normal_part(tip, hand) : math::any_normal(hand);
    if (plane_zero.isZero(0.0) && bends) plane_zero = sideways;
    // An arc is longer than its chords.
    const double half = 0.5 * turn;
    const double stretch = half > 1e-6 ? half / std::sin(half) : 1.0;
    double length = 0.5 * (chord[j].norm() + chord[j - 1].norm()) * stretch;
    double angle = turn;
    // The outer half of a last chord goes on as the arc beside it.
    const double more =
        0.5 * stretch * ((j == n - 2 ? chord[j].norm() : 0.0) + (j == 1 ? chord[0].norm() : 0.0));
    angle *= 1.0 + more / length;
    length += more;
    RestPiece& piece = pieces[j - 1];
    piece.length_mm = length;
    piece.curvature_per_mm = angle / length;
    piece.plane_rad =
        bends ? std::atan2(sideways.dot(hand.cross(plane_zero)), sideways.dot(plane_zero)) : 0.0;
    if (!plane_zero.isZero(0.0)) plane_zero = math::parallel_transport(plane_zero, hand, tip);
  }
  return pieces;
}

void lay_rest_shape(const std::vector<RestPiece>& pieces, double over_mm, const std::string& where,
                    Instrument& instrument) {
  double length_mm = 0.0;
  for (const RestPiece& piece : pieces) length_mm += piece.length_mm;
  if (length_mm > instrument.length_mm()) {
    std::ostringstream text;
    text << where << " is " << length_mm << " mm long; must be at most " << instrument.length_mm()
         << " mm, the length of the instrument";
    throw base::InputError(text.str());
  }
  std::vector<Section>& sections = instrument.sections;
  const double end_mm = std::max(length_mm, over_mm);
  double border = 0.0;
  for (const RestPiece& piece : pieces) cut_at(border += piece.length_mm, sections);
  cut_at(end_mm, sections);
  double start = 0.0;
  for (Section& section : sections) {
    const double middle = start + 0.5 * section.length_mm;
    if (middle > end_mm) break;
    section.rest_curvature_per_mm = section.rest_plane_rad = section.rest_torsion_per_mm = 0.0;
    double piece_start = 0.0;
    for (const RestPiece& piece : pieces) {
      if (middle >= piece_start && middle < piece_start + piece.length_mm) {
        section.rest_curvature_per_mm = piece.curvature_per_mm;
        section.rest_plane_rad =
            within_half_a_turn(piece.plane_rad + piece.torsion_per_mm * (start - piece_start));
        section.rest_torsion_per_mm = piece.torsion_per_mm;
      }
      piece_start += piece.length_mm;
    }
    start += section.length_mm;
  }
}

std::vector<Vector3d> unloaded_joints_mm(const MaterialLine& line, double to_mm, double spacing_mm) {
  const auto rods = static_cast<std::size_t>(std::max(1.0, std::ceil(to_mm / spacing_mm)));
  const double length = to_mm / static_cast<double>(rods);
  std::vector<Vector3d> joints(rods + 1, Vector3d::Zero());
  Vector3d tangent = Vector3d::UnitX();
  Vector3d m1 = Vector3d::UnitY();
  for (std::size_t j = rods; j >= 1; --j) {
    joints[j - 1] = joints[j] + length * tangent;
    const double arc = length * static_cast<double>(j - 1);
    if (j == 1) break;
    const Eigen::Vector2d bend = line.rest_bend_rad(arc - 0.5 * length, arc + 0.5 * length);
    const double turn = bend.norm();
    if (turn == 0.0) continue;
    const Vector3d towards = (bend[0] * m1 + bend[1] * tangent.cross(m1)) / turn;
    const Vector3d next = (std::cos(turn) * tangent + std::sin(turn) * towards).normalized();
    m1 = math::normal_part(math::parallel_transport(m1, tangent, next), next);
    tangent = next;
  }
  return joints;
}

void bend_tip(const TipBend& bend, const std::string& where, Instrument& instrument) {
  std::ostringstream text;
  if (instrument.shapeable_mm <= 0.0) {
    text << where << "tip_angle_deg is " << bend.angle_rad * 180.0 / std::numbers::pi
         << "; must be left out: the tip of " << instrument.model << " cannot be shaped";
    throw base::InputError(text.str());
  }
  if (bend.length_mm > instrument.shapeable_mm) {
    text << where << "tip_length_mm is " << bend.length_mm << "; must be <= " << instrument.shapeable_mm
         << ", what can be shaped of " << instrument.model;
    throw base::InputError(text.str());
  }
  lay_rest_shape({arc_piece(bend.length_mm / std::abs(bend.angle_rad), bend.angle_rad)},
                 instrument.shapeable_mm, where, instrument);
}

}  // namespace endowire::rod

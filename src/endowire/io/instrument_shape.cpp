#include "endowire/io/instrument_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace endowire::io {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sharpest_turn_deg =
    150.0;  // of a list of points at one of them: sharper, and it says no curve

Range radius_range() {
  return between(0.5, 5000.0);
}

void check_points(const TomlTable& table, const std::vector<Eigen::Vector3d>& points) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d chord = points[i] - points[i + 1];
    if (!(chord.norm() >= 0.1))
      table.refuse(fmt::format("points_mm.value[{}]", i + 1),
                   fmt::format("{:.3g} mm from the one before", chord.norm()), ">= 0.1 mm from it");
    if (i == 0) continue;
    const Eigen::Vector3d before = points[i - 1] - points[i];
    const double turn_deg = std::atan2(before.cross(chord).norm(), before.dot(chord)) / degree;
    if (!(turn_deg < sharpest_turn_deg))
      table.refuse(fmt::format("points_mm.value[{}]", i), fmt::format("a turn of {:.0f} degrees", turn_deg),
                   fmt::format("a turn of less than {:.0f} degrees", sharpest_turn_deg));
  }
}

rod::RestPiece read_bend(const TomlTable& table, SourcedReader& reader) {
  const double radius_mm = reader.constant(table, "radius_mm", radius_range());
  const double plane_rad = degree * reader.constant_or(table, "plane_deg", 0.0, between(-360.0, 360.0));
  if (table.has("pitch_mm")) {
    if (table.has("angle_deg"))
      table.refuse("angle_deg", "given beside pitch_mm", "left out: a helix has turns");
    const double pitch_mm = reader.constant(table, "pitch_mm", between(-1000.0, 1000.0));
    Range turns = above(0.0);
    turns.high = 1000.0;
    return rod::helix_piece(radius_mm, pitch_mm, reader.constant(table, "turns", turns), plane_rad);
  }
  const double angle_deg = reader.constant(table, "angle_deg", between(-1080.0, 1080.0));
  if (angle_deg == 0.0)
    table.refuse("angle_deg.value", "0", "another angle, or straight_mm in place of an arc");
  return rod::arc_piece(radius_mm, degree * angle_deg, plane_rad);
}

}  // namespace

std::vector<rod::RestPiece> read_shape(const TomlTable& root, SourcedReader& reader) {
  std::vector<rod::RestPiece> pieces;
  for (const TomlTable& table : root.tables("shape", {"straight_mm", "radius_mm", "angle_deg", "plane_deg",
                                                      "pitch_mm", "turns", "points_mm"})) {
    const bool straight = table.has("straight_mm");
    const bool points = table.has("points_mm");
    if (static_cast<int>(straight) + static_cast<int>(points) + static_cast<int>(table.has("radius_mm")) != 1)
      table.refuse("radius_mm", "not the only one", "given, or else straight_mm, or else points_mm");
    if (straight) {
      Range length = above(0.0);
      length.high = 5000.0;
      pieces.push_back(rod::straight_piece(reader.constant(table, "straight_mm", length)));
    } else if (points) {
      const std::vector<Eigen::Vector3d> list = reader.points(table, "points_mm");
      check_points(table, list);
      for (const rod::RestPiece& piece : rod::pieces_through(list)) pieces.push_back(piece);
    } else {
      pieces.push_back(read_bend(table, reader));
    }
  }
  return pieces;
}

}  // namespace endowire::io

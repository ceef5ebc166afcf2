#include "endowire/rod/rest_shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Instrument with_shape(const std::vector<RestPiece>& pieces) {
  Instrument wire = test::uniform_wire(8.0, 6.0, 300.0);
  lay_rest_shape(pieces, 0.0, "shape", wire);
  return wire;
}

std::vector<Vector3d> laid(const std::vector<RestPiece>& pieces, double to_mm) {
  return unloaded_joints_mm(MaterialLine(with_shape(pieces)), to_mm, 0.01);
}

/// Angle between the directions at the tip and at the other end.
double turn_rad(const std::vector<Vector3d>& joints) {
  const Vector3d tip = joints[0] - joints[1];
  const Vector3d hand = joints[joints.size() - 2] - joints.back();
  return std::atan2(tip.cross(hand).norm(), tip.dot(hand));
}

TEST(RestShape, StraightsAndArcsFollowOneAnother) {
  // 10 mm straight, a quarter of a circle of 20 mm to the left, then straight: from the origin 30 mm along x.
  const std::vector<Vector3d> joints =
      laid({straight_piece(10.0), arc_piece(20.0, 0.5 * kPi)}, 10.0 + 10.0 * kPi + 30.0);
  const Vector3d tip(30.0 + 20.0, 20.0 + 10.0, 0.0);
  // The ramps blunt the ends of the arc: by Δκ (2 mm)²/24 at either of them.
  EXPECT_LT((joints.front() - tip).norm(), 0.02);
  EXPECT_NEAR(turn_rad(joints), 0.5 * kPi, 1e-4);
}

TEST(RestShape, APlaneTurnsTheBendAboutTheWire) {
  const std::vector<Vector3d> joints = laid({arc_piece(20.0, 0.5, 0.5 * kPi)}, 40.0);
  EXPECT_GT(joints.front().z(), 2.0);
  EXPECT_NEAR(joints.front().y(), 0.0, 1e-9);
  const std::vector<Vector3d> other = laid({arc_piece(20.0, -0.5)}, 40.0);
  EXPECT_LT(other.front().y(), -2.0);
}

// All points of a helix lie at its radius from a line, and it climbs by its pitch in a turn, right-handed.
TEST(RestShape, AHelixHasItsRadiusPitchAndHand) {
  for (const double pitch : {12.0, -12.0}) {
    const RestPiece helix = helix_piece(8.0, pitch, 3.0);
    const double length = helix.length_mm;
    EXPECT_NEAR(length, 3.0 * std::hypot(2.0 * kPi * 8.0, 12.0), 1e-9);
    const MaterialLine line(with_shape({helix}));
    std::vector<Vector3d> joints = unloaded_joints_mm(line, length, 0.01);
    joints.erase(joints.end() - 150, joints.end());  // the ramp at its end
    // A point a turn on lies one pitch further along the axis, whatever the frame.
    const auto turn =
        static_cast<std::size_t>(std::lround(length / 3.0 / (length / std::ceil(length / 0.01))));
    const Vector3d climb = joints[0] - joints[turn];
    EXPECT_NEAR(climb.norm(), 12.0, 0.01);
    const Vector3d axis = climb.normalized();
    const Vector3d across = joints[0] - joints[turn / 2];  // half a turn: two radii across
    EXPECT_NEAR((across - across.dot(axis) * axis).norm(), 16.0, 0.01);
    // Seen along the axis in which it climbs it turns to the right.
    const Vector3d first = joints[turn] - joints[turn + 1];
    const Vector3d later = joints[turn - turn / 8] - joints[turn - turn / 8 + 1];
    EXPECT_EQ(first.cross(later).dot(axis) > 0.0, pitch > 0.0);
  }
}

// Breaks when the turn of a helix is carried on from section to section, beyond the range of an angle.
TEST(RestShape, AHelixOfManyTurnsGoesOnOverBordersOfSections) {
  Instrument wire = test::uniform_wire(8.0, 6.0, 150.0);
  wire.sections.push_back(wire.sections[0]);
  const RestPiece helix = helix_piece(2.0, 3.0, 18.0);
  ASSERT_GT(helix.length_mm, 200.0);
  lay_rest_shape({helix}, 0.0, "shape", wire);
  const MaterialLine cut(wire);
  const MaterialLine whole(with_shape({helix}));
  for (double arc = 140.0; arc < 160.0; arc += 0.1)
    EXPECT_LT((cut.rest_curvature_per_mm(arc) - whole.rest_curvature_per_mm(arc)).norm(), 1e-12) << arc;
}

TEST(RestShape, PointsOfACircleGiveItsArc) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= 9; ++i) {
    const double a = 10.0 * i * kPi / 180.0;
    points.emplace_back(15.0 * std::sin(a), 3.0, 15.0 * std::cos(a));
  }
  const std::vector<RestPiece> pieces = pieces_through(points);
  double length = 0.0;
  double turn = 0.0;
  for (const RestPiece& piece : pieces) {
    EXPECT_NEAR(piece.curvature_per_mm, 1.0 / 15.0, 1e-12);
    EXPECT_NEAR(std::remainder(piece.plane_rad, 2.0 * kPi), 0.0, 1e-9);
    length += piece.length_mm;
    turn += piece.length_mm * piece.curvature_per_mm;
  }
  EXPECT_NEAR(length, 15.0 * 0.5 * kPi, 1e-9);
  EXPECT_NEAR(turn, 0.5 * kPi, 1e-9);
}

// Points of a curve in space: the wire laid from them passes through points at the same distances from each other.
TEST(RestShape, PointsOfAHelixGiveItBack) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= 36; ++i) {
    const double a = 10.0 * i * kPi / 180.0;
    points.emplace_back(8.0 * std::cos(a), 8.0 * std::sin(a), 2.0 * a);
  }
  const std::vector<RestPiece> pieces = pieces_through(points);
  double length = 0.0;
  for (const RestPiece& piece : pieces) length += piece.length_mm;
  const std::vector<Vector3d> joints = laid(pieces, length);
  EXPECT_NEAR((joints.front() - joints.back()).norm(), (points.front() - points.back()).norm(), 0.1);
  const std::size_t half = joints.size() / 2;
  EXPECT_NEAR((joints.front() - joints[half]).norm(), (points[0] - points[18]).norm(), 0.1);
}

// Cutting a section changes nothing else about the wire.
TEST(RestShape, CutsLeaveTheMaterialAsItWas) {
  Instrument wire = test::uniform_wire(8.0, 6.0, 300.0);
  wire.sections[0].flexural_rigidity_n_mm2 = {4.0, 100.0, 4, 1.0};
  wire.sections[0].linear_density_g_per_mm = {1e-3, 2e-3, 2};
  const MaterialLine before(wire);
  lay_rest_shape({straight_piece(7.0), arc_piece(30.0, 1.0), arc_piece(20.0, -1.0)}, 0.0, "shape", wire);
  EXPECT_EQ(wire.sections.size(), 4U);
  const MaterialLine after(wire);
  EXPECT_NEAR(after.length_mm(), 300.0, 1e-12);
  for (double arc = 0.0; arc < 290.0; arc += 3.7) {
    EXPECT_NEAR(
        after.flexural_rigidity_n_mm2(arc, arc + 9.0) / before.flexural_rigidity_n_mm2(arc, arc + 9.0), 1.0,
        1e-8);
    EXPECT_NEAR(after.mass_g(arc, arc + 9.0), before.mass_g(arc, arc + 9.0), 1e-15);
  }
}

TEST(RestShape, LongerThanTheInstrumentIsRefused) {
  Instrument wire = test::uniform_wire(8.0, 6.0, 30.0);
  EXPECT_EQ(test::message_of<base::InputError>(
                [&] { lay_rest_shape({straight_piece(31.0)}, 0.0, "w.toml: shape", wire); }),
            "w.toml: shape is 31 mm long; must be at most 30 mm, the length of the instrument");
}

TEST(TipBend, ReplacesTheShapeOfWhatCanBeShaped) {
  Instrument wire = test::curved_tip_wire();  // curved over 10 mm
  wire.shapeable_mm = 20.0;
  bend_tip({0.6, 4.0}, "", wire);
  const MaterialLine line(wire);
  EXPECT_NEAR(line.rest_bend_rad(0.0, 5.0).x(), 0.6, 1e-12);
  EXPECT_EQ(line.rest_bend_rad(5.0, 30.0).norm(), 0.0);
}

TEST(TipBend, IsRefusedWhereTheTipDoesNotAllowIt) {
  Instrument wire = test::curved_tip_wire();
  EXPECT_EQ(
      test::message_of<base::InputError>([&] {
        bend_tip({0.5 * kPi, 4.0}, "s.toml: instrument[0].", wire);
      }),
      "s.toml: instrument[0].tip_angle_deg is 90; must be left out: the tip of curved_tip cannot be shaped");
  wire.shapeable_mm = 20.0;
  EXPECT_EQ(test::message_of<base::InputError>([&] {
              bend_tip({0.5, 21.0}, "s.toml: instrument[0].", wire);
            }),
            "s.toml: instrument[0].tip_length_mm is 21; must be <= 20, what can be shaped of curved_tip");
}

}  // namespace
}  // namespace endowire::rod

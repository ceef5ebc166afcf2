// Local walls against the field that they were taken from, and paths that must not pass a wall.
#include "endowire/contact/detect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>

#include "endowire/vessel/analytic_field.hpp"
#include "support/fields.hpp"
#include "support/frames.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector3d;

struct Case {
  std::string name;
  std::shared_ptr<const vessel::Field> field;
  Vector3d inside_mm;  ///< a point on the axis of the lumen
  double lumen_mm;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class Fields : public testing::TestWithParam<Case> {};

/// A point at a given height over the wall, in a random direction from the axis.
Vector3d point_at_height(const Case& c, double height, test::Random& random) {
  Vector3d p = c.inside_mm + 0.3 * random.unit();
  for (int k = 0; k < 50; ++k) {
    const vessel::WallDistance w = c.field->at(p);
    p += (height - w.distance_mm) * w.gradient;
  }
  return p;
}

// The heart of the force correction: gaps follow the displacement with no new detection. Breaks with planes (0.04 mm off
// in the narrowest tube here), with curvatures of the wrong sign, or with ghost walls. Gaps matter where the wire touches:
// places are judged where the wall or the model of it comes within reach of the wire's surface.
TEST_P(Fields, LocalWallsFollowTheFieldForHalfAMillimetre) {
  test::Random random(61);
  const ContactSpec spec;
  double worst = 0.0;
  int touched = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Sample s;
    s.radius_mm = 0.4445;
    s.detected_at_mm = point_at_height(GetParam(), s.radius_mm + random.uniform(-0.05, 0.5), random);
    find_local_walls(*GetParam().field, spec, random.unit(), s);
    ASSERT_GE(s.walls, 1);
    ASSERT_GE(GetParam().field->at(s.detected_at_mm).distance_mm,
              s.radius_mm - 1e-6);  // lifted out of the wall
    for (int k = 0; k < 20; ++k) {
      const Vector3d u = random.uniform(0.0, 0.5) * random.unit();
      const double exact = GetParam().field->at(s.detected_at_mm + u).distance_mm;
      double model = HUGE_VAL;
      for (int w = 0; w < s.walls; ++w)
        model = std::min(model, local_height_mm(s.wall[static_cast<std::size_t>(w)], u));
      if (std::min(exact, model) > s.radius_mm) continue;
      ++touched;
      worst = std::max(worst, std::abs(model - exact));
    }
  }
  EXPECT_GT(touched, 300);
  EXPECT_LE(worst, 0.02);
  RecordProperty("worst_gap_error_um", static_cast<int>(1000.0 * worst));
}

// The first wall is the nearest one: its height is the field's, its normal the gradient.
TEST_P(Fields, TheFirstWallIsTheNearest) {
  test::Random random(62);
  for (int trial = 0; trial < 50; ++trial) {
    Sample s;
    s.radius_mm = 0.4445;
    s.detected_at_mm = point_at_height(GetParam(), 0.6, random);
    find_local_walls(*GetParam().field, ContactSpec{}, random.unit(), s);
    const vessel::WallDistance w = GetParam().field->at(s.detected_at_mm);
    ASSERT_GE(s.walls, 1);
    EXPECT_NEAR(s.wall[0].height_mm, w.distance_mm, 1e-12);
    EXPECT_LT((s.wall[0].normal - w.gradient).norm(), 1e-9);
    EXPECT_NEAR(s.clearance_mm, w.distance_mm - s.radius_mm, 1e-12);
    const rod::Frame axes = (rod::Frame() << s.wall[0].normal, s.wall[0].first, s.wall[0].second).finished();
    EXPECT_LT((axes.transpose() * axes - rod::Frame::Identity()).norm(), 1e-9);
  }
}

// A path ends before the wall it would pass, whatever its length. Breaks when a far step jumps to the other side, from
// where the wall would push the wire out of the vessel.
TEST_P(Fields, PathsNeverPassAWall) {
  test::Random random(63);
  const vessel::Field& field = *GetParam().field;
  int stopped = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d from = point_at_height(GetParam(), random.uniform(0.03, 0.9), random);
    const Vector3d to = from + random.uniform(0.0, 12.0) * random.unit();
    for (const Vector3d& end :
         {reachable_point_mm(field, from, to), slid_point_mm(field, from, to, 0.4445)}) {
      ASSERT_GT(field.at(end).distance_mm, 0.0) << from.transpose() << " to " << to.transpose();
    }
    const Vector3d end = reachable_point_mm(field, from, to);
    const double length = (to - from).norm();
    // On the segment, and everything before it inside.
    ASSERT_NEAR((end - from).norm() + (to - end).norm(), length, 1e-9);
    for (int k = 0; k <= 40; ++k) {
      ASSERT_GT(field.at(from + k / 40.0 * (end - from)).distance_mm, 0.0);
    }
    if ((end - to).norm() > 1e-9) {
      ++stopped;
      // It stops only where a wall is: not further from it than a hair.
      ASSERT_LT(field.at(end).distance_mm, 0.03);
    }
  }
  EXPECT_GT(stopped, 100);
}

INSTANTIATE_TEST_SUITE_P(
    All, Fields,
    testing::Values(
        Case{"tube_3", std::make_shared<vessel::TubeField>(Vector3d::Zero(), Vector3d(1, 2, 1), 3.0),
             Vector3d::Zero(), 3.0},
        Case{"tube_1_5", std::make_shared<vessel::TubeField>(Vector3d::Zero(), Vector3d(0, 0, 1), 1.5),
             Vector3d::Zero(), 1.5},
        Case{"tube_10", std::make_shared<vessel::TubeField>(Vector3d::Zero(), Vector3d(0, 1, 0), 10.0),
             Vector3d::Zero(), 10.0},
        Case{"torus", std::make_shared<vessel::TorusField>(Vector3d::Zero(), Vector3d::UnitZ(), 20.0, 3.0),
             Vector3d(20, 0, 0), 3.0},
        Case{"bent_torus",
             std::make_shared<vessel::TorusField>(Vector3d::Zero(), Vector3d::UnitZ(), 12.0, 3.0),
             Vector3d(12, 0, 0), 3.0},
        Case{"sphere", std::make_shared<vessel::SphereField>(Vector3d::Zero(), 5.0), Vector3d::Zero(), 5.0},
        Case{"dead_end", std::make_shared<test::DeadEndField>(3.0, 0.0), Vector3d(0, 0, -0.5), 3.0},
        Case{"plane", std::make_shared<vessel::HalfSpaceField>(Vector3d::Zero(), Vector3d(1, -1, 2), 5.0),
             Vector3d(2, -2, 4), 5.0}),
    [](const auto& instance) { return instance.param.name; });

// Two lumens 0.2 mm apart: a path from one may end in it only. Breaks when only the ends of the path are looked at, both
// of which lie in a lumen.
TEST(Paths, StayInTheirLumen) {
  const test::TwinTubesField twins(2.0, 4.2);
  test::Random random(64);
  int would_cross = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d from(-2.1 + random.uniform(-1.3, 1.3), random.uniform(-1.2, 1.2), 0.0);
    const Vector3d to(2.1 + random.uniform(-1.3, 1.3), random.uniform(-1.2, 1.2), random.uniform(-3.0, 3.0));
    if (twins.at(from).distance_mm < 0.03 || twins.at(to).distance_mm < 0.03) continue;
    ++would_cross;
    const Vector3d end = reachable_point_mm(twins, from, to);
    ASSERT_LT(end.x(), 0.0);
    ASSERT_GT(twins.at(end).distance_mm, 0.0);
    const Vector3d slid = slid_point_mm(twins, from, to, 0.3);
    ASSERT_LT(slid.x(), 0.0);
    ASSERT_GT(twins.at(slid).distance_mm, 0.0);
  }
  EXPECT_GT(would_cross, 1500);
}

// Where nothing is in the way the path is not cut short, and one along a wall may start low over it.
TEST(Paths, AreNotStoppedWithoutAWall) {
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 3.0);
  EXPECT_EQ(reachable_point_mm(tube, {0, 0, 0}, {0, 0, 500}), Vector3d(0, 0, 500));
  EXPECT_EQ(reachable_point_mm(tube, {2.5, 0, 0}, {2.5, 0, 40}), Vector3d(2.5, 0, 40));
  EXPECT_EQ(reachable_point_mm(tube, {2.99, 0, 0}, {0, 0, 1}), Vector3d(0, 0, 1));
  EXPECT_EQ(reachable_point_mm(tube, {1, 1, 1}, {1, 1, 1}), Vector3d(1, 1, 1));
}

// A wire out of reach of every wall has none: no ghost walls in a wide vessel.
TEST(FindLocalWalls, NoneOutOfReach) {
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 10.0);
  Sample s;
  s.radius_mm = 0.4;
  s.detected_at_mm = {3.0, 0.0, 0.0};
  find_local_walls(tube, ContactSpec{}, Vector3d::UnitZ(), s);
  EXPECT_EQ(s.walls, 0);
  EXPECT_NEAR(s.clearance_mm, 6.6, 1e-12);
}

// Between two walls that face each other both are found. Breaks when only the nearest is: the wire would be pushed
// through the other.
TEST(FindLocalWalls, BothSidesOfANarrowLumen) {
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 0.6);
  Sample s;
  s.radius_mm = 0.4445;
  s.detected_at_mm = {0.1, 0.0, 0.0};
  find_local_walls(tube, ContactSpec{}, Vector3d::UnitZ(), s);
  ASSERT_GE(s.walls, 1);
  for (double angle = 0.0; angle < 6.28; angle += 0.1) {
    const Vector3d u = 0.3 * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    double model = HUGE_VAL;
    for (int w = 0; w < s.walls; ++w)
      model = std::min(model, local_height_mm(s.wall[static_cast<std::size_t>(w)], u));
    EXPECT_NEAR(model, tube.at(s.detected_at_mm + u).distance_mm, 0.02) << angle;
  }
}

}  // namespace
}  // namespace endowire::contact

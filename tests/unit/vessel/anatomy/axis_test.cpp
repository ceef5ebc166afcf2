#include "endowire/vessel/anatomy/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/vessel/anatomy/course.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

Axis wavy() {
  return Axis::spline({Vector3d(0, 0, 0), Vector3d::UnitZ(), Vector3d::Zero()},
                      {Vector3d(3, 1, 20), Vector3d(-2, 6, 38), Vector3d(10, 5, 60), Vector3d(14, -9, 75)},
                      {Vector3d(20, -10, 100), unit(Vector3d(0.2, 0.1, 1.0)), Vector3d(0.01, -0.02, 0.0)});
}

TEST(Axis, PassesItsPointsAndKeepsItsEnds) {
  const Axis axis = wavy();
  for (const Vector3d& p :
       {Vector3d(3, 1, 20), Vector3d(-2, 6, 38), Vector3d(10, 5, 60), Vector3d(14, -9, 75)})
    EXPECT_LT((axis.at(axis.nearest_arc_mm(p)).position_mm - p).norm(), 1e-5);
  EXPECT_LT((axis.at(0.0).tangent - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT(axis.at(0.0).curvature_per_mm.norm(), 1e-12);
  const AxisPoint end = axis.at(axis.length_mm());
  EXPECT_LT((end.position_mm - Vector3d(20, -10, 100)).norm(), 1e-9);
  EXPECT_LT((end.tangent - unit(Vector3d(0.2, 0.1, 1.0))).norm(), 1e-9);
}

TEST(Axis, IsMeasuredByItsArcLength) {
  const Axis axis = wavy();
  constexpr double h = 1e-3;
  double summed = 0.0;
  for (double s = h; s + h < axis.length_mm(); s += 0.013) {
    const double speed = (axis.at(s + h).position_mm - axis.at(s - h).position_mm).norm() / (2.0 * h);
    EXPECT_NEAR(speed, 1.0, 2e-6) << s;
  }
  for (double s = 0.0; s < axis.length_mm() - 0.01; s += 0.01)
    summed += (axis.at(s + 0.01).position_mm - axis.at(s).position_mm).norm();
  EXPECT_NEAR(summed, axis.length_mm(), 0.02);
}

/// Within a spline piece, across its knots and across stations: curvature and tangent change by little in little.
TEST(Axis, CurvatureIsContinuousEverywhere) {
  const Axis axis = wavy();
  constexpr double h = 0.01;
  double largest = 0.0;
  double largest_change = 0.0;
  for (double s = 0.0; s + h < axis.length_mm(); s += h) {
    const AxisPoint a = axis.at(s);
    const AxisPoint b = axis.at(s + h);
    largest = std::max(largest, a.curvature_per_mm.norm());
    largest_change = std::max(largest_change, (b.curvature_per_mm - a.curvature_per_mm).norm());
    EXPECT_LT(((b.tangent - a.tangent) / h - 0.5 * (a.curvature_per_mm + b.curvature_per_mm)).norm(), 1e-4)
        << s;
  }
  EXPECT_GT(largest, 0.05);  // it does bend
  EXPECT_LT(largest_change, 0.02 * largest);
}

TEST(Axis, RoundsTheBendsOfACourse) {
  Course course(Vector3d::Zero(), Vector3d::UnitZ());
  course.straight(40.0).bend(Vector3d::UnitX(), 30.0, std::numbers::pi / 2).straight(40.0);
  const std::vector<Vector3d>& p = course.points_mm();
  const Axis axis = Axis::spline({Vector3d::Zero(), Vector3d::UnitZ(), Vector3d::Zero()},
                                 {p.begin(), p.end() - 1}, {p.back(), course.direction(), Vector3d::Zero()});
  EXPECT_NEAR(axis.length_mm(), 80.0 + 15.0 * std::numbers::pi, 0.02);
  const AxisPoint middle = axis.at(0.5 * axis.length_mm());
  EXPECT_NEAR(1.0 / middle.curvature_per_mm.norm(), 30.0, 0.6);
  EXPECT_LT((middle.tangent - unit(Vector3d(1, 0, 1))).norm(), 1e-3);
}

TEST(Axis, FindsTheFootOfAPoint) {
  const Axis axis = wavy();
  SplitMix random(3);
  for (int i = 0; i < 500; ++i) {
    const double arc = random.uniform(1.0, axis.length_mm() - 1.0);
    const AxisPoint at = axis.at(arc);
    Vector3d aside(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    aside = unit(aside - dot(aside, at.tangent) * at.tangent);
    const Vector3d point = at.position_mm + random.uniform(0.0, 4.0) * aside;
    EXPECT_NEAR(axis.foot_mm(point, arc - 1.0, arc + 1.0, arc + 0.7), arc, 1e-6);
    EXPECT_NEAR(axis.nearest_arc_mm(point), arc, 1e-6);
  }
  // A bracket that does not hold the minimum gives its nearer end.
  EXPECT_NEAR(axis.foot_mm(axis.at(20.0).position_mm, 30.0, 32.0, 31.0), 30.0, 1e-6);
}

TEST(Axis, RunsOnStraightBeyondItsEnds) {
  Axis axis = wavy();
  axis.set_radius(RadiusProfile({{0.0, 4.0}, {100.0, 2.0}}));
  const AxisPoint end = axis.at(axis.length_mm());
  const AxisPoint beyond = axis.at(axis.length_mm() + 5.0);
  EXPECT_LT((beyond.position_mm - end.position_mm - 5.0 * end.tangent).norm(), 1e-12);
  EXPECT_EQ(beyond.radius_mm, end.radius_mm);
  EXPECT_EQ(beyond.radius_slope, 0.0);
  EXPECT_NEAR(
      axis.foot_mm(beyond.position_mm, axis.length_mm() - 1.0, axis.length_mm() + 9.0, axis.length_mm()),
      axis.length_mm() + 5.0, 1e-9);
}

}  // namespace
}  // namespace endowire::vessel::anatomy

#include "endowire/vessel/anatomy/lumen_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

Axis straight(const Vector3d& from, const Vector3d& to, double radius_mm) {
  Axis axis =
      Axis::spline({from, unit(to - from), Vector3d::Zero()}, {}, {to, unit(to - from), Vector3d::Zero()});
  axis.set_radius(RadiusProfile({{0.0, radius_mm}}));
  return axis;
}

/// Two planes through the z axis whose tissue wedge opens by `angle` around +x.
WallSample plane(const Vector3d& normal, const Vector3d& p) {
  return {dot(normal, p), normal, 100.0};
}

class FilletAngle : public ::testing::TestWithParam<double> {};

TEST_P(FilletAngle, TheWedgeEndsInACircleOfTheStatedRadius) {
  const double half = radians(0.5 * GetParam());
  const double rho = 1.3;
  const Fillet fillet(rho, std::cos(2.0 * half));
  // The normals of both lumens point into the wedge, which opens towards +x.
  const Vector3d above(std::sin(half), -std::cos(half), 0.0);
  const Vector3d below(std::sin(half), std::cos(half), 0.0);
  const Vector3d centre(rho / std::sin(half), 0.0, 0.0);  // of the ball that touches both
  // Points of that circle between its tangent points lie on the surface, and the gradient is radial there.
  for (double share = -0.98; share <= 0.98; share += 0.07) {
    const double angle = share * (0.5 * std::numbers::pi - half);
    const Vector3d out(-std::cos(angle), std::sin(angle), 0.0);
    const Vector3d p = centre + rho * out;
    const WallSample sample = fillet.join(plane(above, p), plane(below, p));
    EXPECT_NEAR(sample.distance_mm, 0.0, 1e-12) << angle;
    EXPECT_LT((sample.gradient + out).norm(), 1e-9) << angle;
    EXPECT_NEAR(fillet.join(plane(above, p + 0.1 * out), plane(below, p + 0.1 * out)).distance_mm, -0.1,
                1e-9);
  }
  // Beyond the tangent points nothing is changed.
  const double beyond = 1.01 * rho / std::tan(half);
  const Vector3d wall = beyond * Vector3d(std::cos(half), std::sin(half), 0.0);
  EXPECT_NEAR(fillet.join(plane(above, wall), plane(below, wall)).distance_mm, 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Degrees, FilletAngle, ::testing::Values(20.0, 45.0, 70.0, 90.0, 130.0));

TEST(Fillet, IsWiderWhereWallsMeetAtAWiderAngle) {
  const Fillet fillet(1.0, std::cos(radians(60.0)));
  const auto radius =
      [&](double angle_deg) {  // of the circle at the bisector: distance from the wedge's edge
        const double half = radians(0.5 * angle_deg);
        const Vector3d above(std::sin(half), -std::cos(half), 0.0);
        const Vector3d below(std::sin(half), std::cos(half), 0.0);
        double x = 0.0;
        for (int i = 0; i < 50; ++i)
          x -= fillet.join(plane(above, {x, 0, 0}), plane(below, {x, 0, 0})).distance_mm;
        return x / (1.0 / std::sin(half) - 1.0);
      };
  EXPECT_NEAR(radius(60.0), 1.0, 1e-6);
  EXPECT_GT(radius(100.0), 1.3);
  EXPECT_GT(radius(140.0), radius(100.0));
}

TEST(Fillet, WithoutOneTheLesserDistanceHolds) {
  const Vector3d p(0.3, 0.1, 0.0);
  const WallSample a = plane(Vector3d::UnitX(), p);
  const WallSample b = plane(Vector3d::UnitY(), p);
  EXPECT_EQ(Fillet().join(a, b).distance_mm, 0.1);
  EXPECT_EQ(Fillet().join(b, a).distance_mm, 0.1);
}

TEST(LumenShape, DistanceToATubeIsExact) {
  const LumenShape shape({{straight({0, 0, 0}, {0, 0, 50}, 5.0), {}, 0.0, 0.0}}, 6.0);
  EXPECT_NEAR(shape.at({3, 0, 20}).distance_mm, -2.0, 1e-12);
  EXPECT_NEAR(shape.at({0, 8, 31}).distance_mm, 3.0, 1e-12);
  EXPECT_NEAR(shape.at({0, 0, 50 + 7}).distance_mm, 2.0, 1e-12);  // the half ball that closes it
  EXPECT_NEAR(shape.at({3, 4, -1}).distance_mm, std::sqrt(26.0) - 5.0, 1e-12);
  EXPECT_EQ(shape.at({40, 0, 20}).distance_mm, 6.0);  // beyond reach
  EXPECT_EQ(shape.at({4000, 0, 20}).distance_mm, 6.0);
}

Axis ring(double bend_mm, double radius_mm) {  // three quarters of a circle around the origin
  std::vector<Vector3d> points;
  for (int i = 1; i < 27; ++i)
    points.emplace_back(bend_mm * std::cos(i * std::numbers::pi / 18),
                        bend_mm * std::sin(i * std::numbers::pi / 18), 0.0);
  const Vector3d toward_centre(-1.0 / bend_mm, 0.0, 0.0);
  Axis axis = Axis::spline({{bend_mm, 0, 0}, Vector3d::UnitY(), toward_centre}, points,
                           {{0, -bend_mm, 0}, Vector3d::UnitX(), {0.0, 1.0 / bend_mm, 0.0}});
  axis.set_radius(RadiusProfile({{0.0, radius_mm}}));
  return axis;
}

TEST(LumenShape, DistanceToATorusIsExact) {
  const LumenShape shape({{ring(20.0, 4.0), {}, 0.0, 0.0}}, 6.0);
  SplitMix random(5);
  for (int i = 0; i < 400; ++i) {
    const double along = random.uniform(0.2, 4.4);
    const double around = random.uniform(0.0, 6.28);
    const double d = random.uniform(0.1, 7.0);
    const double rho = 20.0 + d * std::cos(around);
    const Vector3d p(rho * std::cos(along), rho * std::sin(along), d * std::sin(around));
    const WallSample sample = shape.at(p);
    EXPECT_NEAR(sample.distance_mm, d - 4.0, 2e-3) << along << " " << around;  // the spline's own error
  }
}

TEST(LumenShape, GradientAndProjectionAgreeWithTheDistance) {
  Axis mother = ring(30.0, 8.0);
  mother.set_radius(RadiusProfile({{0.0, 8.0}, {60.0, 8.0}, {90.0, 6.0}, {200.0, 6.0}}));
  const AxisPoint at = mother.at(40.0);
  const Vector3d out = unit(unit(at.position_mm) + 0.5 * at.tangent);
  const LumenShape shape(
      {{mother, {}, 0.0, 0.0},
       {straight(at.position_mm, at.position_mm + 40.0 * out, 3.0), Fillet(1.0, 0.45), 0.0, 0.0}},
      6.0);
  SplitMix random(6);
  int near_fillet = 0;
  for (int i = 0; i < 600; ++i) {
    WallSample sample;
    const Vector3d start = at.position_mm + 8.0 * unit(at.position_mm) +
                           Vector3d(random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(-8, 8));
    if (std::abs(shape.at(start).distance_mm) > 3.0) continue;
    const Vector3d p = shape.projected(start, 1e-9, sample);
    EXPECT_LT(std::abs(shape.at(p).distance_mm), 1e-8);
    EXPECT_NEAR(sample.gradient.norm(), 1.0, 1e-12);
    constexpr double h = 1e-5;
    Vector3d difference;
    for (int k = 0; k < 3; ++k)
      difference[k] = (shape.at(p + h * Vector3d::Unit(k)).distance_mm -
                       shape.at(p - h * Vector3d::Unit(k)).distance_mm) /
                      (2.0 * h);
    if (sample.curvature_radius_mm < 2.0) ++near_fillet;
    EXPECT_LT((difference.normalized() - sample.gradient).norm(), 0.12) << p.transpose();
  }
  EXPECT_GT(near_fillet, 20);
}

TEST(LumenShape, AFilletLeavesTheCalibreAwayFromTheOstiumAlone) {
  const Axis mother = straight({0, 0, 0}, {0, 0, 100}, 10.0);
  const LumenShape shape(
      {{mother, {}, 0.0, 0.0}, {straight({0, 0, 50}, {40, 0, 70}, 3.0), Fillet(2.0, 0.45), 0.0, 0.0}}, 6.0);
  for (double z = 10.0; z < 95.0; z += 1.0)
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
      const Vector3d p(10.0 * std::cos(angle), 10.0 * std::sin(angle), z);
      const Vector3d ostium(10.0, 0.0, 55.0);
      if ((p - ostium).norm() < 3.0 + 3.0 * 2.0 + 3.0) continue;
      EXPECT_NEAR(shape.at(p).distance_mm, 0.0, 1e-12) << z << " " << angle;
    }
}

}  // namespace
}  // namespace endowire::vessel::anatomy

#include "endowire/math/transport.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/frames.hpp"

namespace endowire::math {
namespace {

using Eigen::Vector3d;

// Breaks with a wrong factor in the rotation: lengths and angles would change, or the tangent miss its target.
TEST(ParallelTransport, IsARotationThatTakesOneTangentToTheOther) {
  test::Random random(11);
  for (int n = 0; n < 500; ++n) {
    const Vector3d from = random.unit();
    const Vector3d to = random.unit();
    if (from.dot(to) < -0.99) continue;
    EXPECT_LT((parallel_transport(from, from, to) - to).norm(), 1e-12);
    const Vector3d v = random.vector();
    const Vector3d w = random.vector();
    const Vector3d v1 = parallel_transport(v, from, to);
    const Vector3d w1 = parallel_transport(w, from, to);
    EXPECT_NEAR(v1.dot(w1), v.dot(w), 1e-12 * (1.0 + v.norm() * w.norm()));
    EXPECT_NEAR(v1.norm(), v.norm(), 1e-12);
    EXPECT_NEAR(v1.cross(w1).dot(to), v.cross(w).dot(from), 1e-11);  // right-handed: no reflection
    // The axis of the smallest rotation is normal to both tangents and stays.
    const Vector3d axis = from.cross(to);
    EXPECT_LT((parallel_transport(axis, from, to) - axis).norm(), 1e-12);
  }
}

// Breaks when the rotation has a twist about the tangent: there and back would not return.
TEST(ParallelTransport, BackIsTheInverse) {
  test::Random random(12);
  for (int n = 0; n < 200; ++n) {
    const Vector3d from = random.unit();
    const Vector3d to = random.unit();
    if (from.dot(to) < -0.9) continue;
    const Vector3d v = random.vector();
    EXPECT_LT((parallel_transport(parallel_transport(v, from, to), to, from) - v).norm(), 1e-12);
  }
}

// Gauss–Bonnet: round a spherical triangle a vector turns by the triangle's area, in the sense of the triangle. Breaks
// with any other connection than the sphere's own: the twist of a bent wire would be wrong.
TEST(ParallelTransport, HolonomyOfASphericalTriangleIsItsArea) {
  const auto turned_by = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d v = any_normal(a);
    const Vector3d w = parallel_transport(parallel_transport(parallel_transport(v, a, b), b, c), c, a);
    return std::atan2(v.cross(w).dot(a), v.dot(w));
  };
  EXPECT_NEAR(turned_by(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()), 0.5 * std::numbers::pi,
              1e-12);
  EXPECT_NEAR(turned_by(Vector3d::UnitX(), Vector3d::UnitZ(), Vector3d::UnitY()), -0.5 * std::numbers::pi,
              1e-12);
  test::Random random(13);
  for (int n = 0; n < 100; ++n) {
    const Vector3d a = random.unit();
    const Vector3d b = (a + 0.8 * random.unit()).normalized();
    const Vector3d c = (a + 0.8 * random.unit()).normalized();
    // Area of a spherical triangle [van Oosterom & Strackee 1983].
    const double area = 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    EXPECT_NEAR(turned_by(a, b, c), area, 1e-11);
  }
}

// Near from = to the transport must not lose digits: a step of a settled wire turns rods by 1e-9 rad.
TEST(ParallelTransport, IsExactForTinyTurns) {
  const Vector3d from = Vector3d::UnitZ();
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12, 0.0}) {
    const Vector3d to(std::sin(angle), 0.0, std::cos(angle));
    const Vector3d v = parallel_transport(Vector3d::UnitX(), from, to);
    EXPECT_NEAR(v.z(), -std::sin(angle), 1e-16);
    EXPECT_NEAR(v.x(), std::cos(angle), 1e-15);
  }
}

// Breaks with the other sense of rotation.
TEST(SpinAbout, IsRightHandedAndAdds) {
  EXPECT_LT(
      (spin_about(Vector3d::UnitX(), Vector3d::UnitZ(), 0.5 * std::numbers::pi) - Vector3d::UnitY()).norm(),
      1e-15);
  test::Random random(14);
  for (int n = 0; n < 100; ++n) {
    const Vector3d axis = random.unit();
    const Vector3d v = any_normal(axis);
    const double a = 3.0 * random.normal();
    const double b = 3.0 * random.normal();
    EXPECT_LT((spin_about(spin_about(v, axis, a), axis, b) - spin_about(v, axis, a + b)).norm(), 1e-13);
    EXPECT_NEAR(spin_about(v, axis, a).dot(axis), 0.0, 1e-14);
    EXPECT_LT((spin_about(v, axis, a) - Eigen::AngleAxisd(a, axis) * v).norm(), 1e-13);
  }
}

// Breaks when the result is not normal to the axis, or when the same axis may give two normals.
TEST(Normals, AreUnitAndNormal) {
  test::Random random(15);
  for (int n = 0; n < 200; ++n) {
    const Vector3d axis = random.unit();
    EXPECT_NEAR(any_normal(axis).dot(axis), 0.0, 1e-15);
    EXPECT_NEAR(any_normal(axis).norm(), 1.0, 1e-15);
    EXPECT_EQ(any_normal(axis), any_normal(axis));
    const Vector3d v = random.vector();
    const Vector3d part = normal_part(v, axis);
    EXPECT_NEAR(part.dot(axis), 0.0, 1e-13);
    EXPECT_NEAR(part.norm(), 1.0, 1e-14);
    EXPECT_GT(part.dot(v), 0.0);
  }
}

}  // namespace
}  // namespace endowire::math

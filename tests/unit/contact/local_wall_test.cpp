#include "endowire/contact/local_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/frames.hpp"
#include "support/taylor.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector3d;

LocalWall wall_of(const rod::Frame& frame, double height, double first, double second) {
  return {frame.col(0), frame.col(1), frame.col(2), height, first, second};
}

// Breaks with any wrong term in gradient or Hessian.
TEST(LocalWall, TaylorSlopes) {
  test::Random random(51);
  const double curvatures[][2] = {{0.0, 0.0},  {0.3, 0.0},  {0.3, -0.05}, {-0.8, 0.0},
                                  {-2.0, 0.4}, {1e-9, 0.0}, {0.2, 0.2},   {-20.0, 0.0}};
  for (const auto& k : curvatures) {
    for (int trial = 0; trial < 10; ++trial) {
      const LocalWall wall = wall_of(random.frame(), random.uniform(0.1, 1.0), k[0], k[1]);
      const Vector3d u = 0.2 * random.vector();
      const Vector3d v = random.unit();
      const LocalHeight h = local_height_derivatives(wall, u);
      EXPECT_DOUBLE_EQ(h.value_mm, local_height_mm(wall, u));
      EXPECT_GT(h.gradient.norm(), 0.5);
      test::expect_taylor([&](double s) { return local_height_mm(wall, u + s * v); }, h.gradient.dot(v),
                          v.dot(h.hessian * v), 1.0, "local wall", 0.01);
    }
  }
}

// Inside a tube the height over the wall is R − ρ, all the way round. Breaks with a parabola in place of the circle.
TEST(LocalWall, IsExactOnACylinderFromInside) {
  test::Random random(52);
  for (int trial = 0; trial < 200; ++trial) {
    const double radius = random.uniform(0.5, 10.0);
    const rod::Frame frame = random.frame();  // normal, around, along the axis
    const double height = random.uniform(0.05, 0.8) * radius;
    const LocalWall wall = wall_of(frame, height, 1.0 / radius, 0.0);
    const Vector3d u = 0.9 * radius * random.vector();
    const Vector3d local = frame.transpose() * u;
    // The axis lies R − height from the sample, along the normal.
    const double rho = std::hypot(local[0] - (radius - height), local[1]);
    EXPECT_NEAR(local_height_mm(wall, u), radius - rho, 1e-12 * radius);
  }
}

// Over a ridge, such as a carina, it is ρ − R from outside. Breaks when the sign of κ is lost: a ghost wall.
TEST(LocalWall, IsExactOnARidgeFromOutside) {
  test::Random random(53);
  for (int trial = 0; trial < 200; ++trial) {
    const double radius = random.uniform(0.05, 3.0);
    const rod::Frame frame = random.frame();
    const double height = random.uniform(0.1, 1.0);
    const LocalWall wall = wall_of(frame, height, -1.0 / radius, 0.0);
    const Vector3d u = random.vector();
    const Vector3d local = frame.transpose() * u;
    const double rho = std::hypot(local[0] + radius + height, local[1]);
    EXPECT_NEAR(local_height_mm(wall, u), rho - radius, 1e-12 * (1.0 + rho));
  }
}

// The plane is the limit of small curvature, with no loss of digits on the way.
TEST(LocalWall, PlaneIsTheLimit) {
  test::Random random(54);
  for (const double curvature : {0.0, 1e-15, -1e-15, 1e-12, 1e-9, -1e-9}) {
    const rod::Frame frame = random.frame();
    const LocalWall wall = wall_of(frame, 0.7, curvature, 0.0);
    const Vector3d u = random.vector();
    EXPECT_NEAR(local_height_mm(wall, u), 0.7 + frame.col(0).dot(u), 1e-15 + 20.0 * std::abs(curvature));
    EXPECT_LT((local_height_derivatives(wall, u).gradient - frame.col(0)).norm(),
              1e-14 + 20.0 * std::abs(curvature));
  }
}

// On a sphere, whose curvature in the second direction is only of second order, the error is of third order.
TEST(LocalWall, IsThirdOrderOnASphere) {
  constexpr double radius = 4.0;
  const rod::Frame frame = rod::Frame::Identity();
  const LocalWall wall = wall_of(frame, 0.0, 1.0 / radius, 1.0 / radius);
  const Vector3d v = Vector3d(0.3, 0.5, 0.8).normalized();
  test::expect_order(
      [&](double h) {
        return local_height_mm(wall, h * v) - (radius - (h * v - Vector3d(radius, 0.0, 0.0)).norm());
      },
      3.0, 1e-15, "sphere", 0.5);
}

// Corrected at a place, a wall has the height and the slope found there, and both remain derivatives of one another elsewhere.
TEST(LocalWall, TakesOverWhatIsFound) {
  test::Random random(31);
  for (int trial = 0; trial < 40; ++trial) {
    LocalWall wall = wall_of(random.frame(), random.uniform(0.1, 1.0), 0.2, -0.05);
    wall.ridge = trial % 2 == 1;
    wall.other_normal = (wall.normal + 0.3 * wall.first).normalized();
    wall.other_height_mm = wall.height_mm + 0.02;
    wall.blend_mm = 0.1;
    for (int correction = 0; correction < 4; ++correction) {
      const Eigen::Vector3d at = 0.1 * random.vector();
      const Eigen::Vector3d gradient = local_height_derivatives(wall, at).gradient + 0.05 * random.vector();
      const double height = local_height_mm(wall, at) + 0.01 * random.normal();
      correct_local_wall(at, height, gradient, wall);
      const LocalHeight found = local_height_derivatives(wall, at);
      EXPECT_NEAR(found.value_mm, height, 1e-12);
      EXPECT_LT((found.gradient - gradient).norm(), 1e-10);
    }
    const Eigen::Vector3d d = random.unit();
    const LocalHeight now = local_height_derivatives(wall, {0.01, 0.02, -0.01});
    test::expect_taylor(
        [&](double h) { return local_height_mm(wall, Eigen::Vector3d(0.01, 0.02, -0.01) + h * d); },
        now.gradient.dot(d), d.dot(now.hessian * d), 1.0 + std::abs(now.value_mm), "corrected", 0.01);
  }
}

// The floor of a crease: heights whose slope across turns faster than any detected curvature. Tilts alone would swing for ever.
TEST(LocalWall, ComesToRestInACrease) {
  // H = z − ½κx² with κ = 5/mm near x = 0: a wire on it is pressed by 1 N, pulled along x by 0.05 N. Rest: κx = 0.05.
  constexpr double kCurvature_per_mm = 5.0;
  LocalWall wall;
  wall.normal = Eigen::Vector3d::UnitZ();
  wall.first = Eigen::Vector3d::UnitX();
  wall.second = Eigen::Vector3d::UnitY();
  double x = 0.2;
  for (int round = 0; round < 12; ++round) {
    const Eigen::Vector3d u(x, 0.0, 0.0);
    correct_local_wall(u, -0.5 * kCurvature_per_mm * x * x, {-kCurvature_per_mm * x, 0.0, 1.0}, wall);
    // Equilibrium of −0.05x + (−H) + ½·1·(x − x_before)² with the local wall, as Newton would find it.
    for (int k = 0; k < 20; ++k) {
      const LocalHeight h = local_height_derivatives(wall, {x, 0.0, 0.0});
      x += (0.05 + h.gradient.x()) / (0.5 - h.hessian(0, 0));
    }
  }
  EXPECT_NEAR(x, 0.05 / kCurvature_per_mm, 1e-6);
}

// A valley with a sharp floor at x = 0, slopes ∓0.04, under a wire on a spring pulled along x by a quarter of that: it rests on the floor, where
// no one slope of the field balances it.
TEST(LocalWall, RestsOnAKink) {
  LocalWall wall;
  wall.normal = Eigen::Vector3d::UnitZ();
  wall.first = Eigen::Vector3d::UnitX();
  wall.second = Eigen::Vector3d::UnitY();
  double x = 0.2;
  int rounds = 0;
  for (; rounds < 24; ++rounds) {
    const Eigen::Vector3d u(x, 0.0, 0.0);
    const Eigen::Vector3d slope(x > 0.0 ? -0.04 : 0.04, 0.0, 1.0);
    if (rests_on_kink(wall, u, slope, 1e-3, 2e-3)) break;
    correct_local_wall(u, -0.04 * std::abs(x), slope, wall);
    for (int k = 0; k < 20; ++k) {
      const LocalHeight h = local_height_derivatives(wall, {x, 0.0, 0.0});
      x += (0.01 + h.gradient.x() - 0.5 * x) / (0.5 - h.hessian(0, 0));
    }
  }
  EXPECT_LT(rounds, 16);
  EXPECT_NEAR(x, 0.0, 1e-3);
  EXPECT_NEAR(local_height_derivatives(wall, {x, 0.0, 0.0}).gradient.x(), -0.01, 2e-3);
}

// A smooth slope that a correction has missed is none.
TEST(LocalWall, DoesNotTakeAnErrorForAKink) {
  LocalWall wall;
  wall.normal = Eigen::Vector3d::UnitZ();
  wall.first = Eigen::Vector3d::UnitX();
  wall.second = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d slope(0.04, 0.0, 1.0);
  EXPECT_FALSE(rests_on_kink(wall, Eigen::Vector3d::Zero(), slope, 1e-3, 2e-3)) << "never corrected";
  correct_local_wall(Eigen::Vector3d::Zero(), 0.0, Eigen::Vector3d::UnitZ(), wall);
  EXPECT_FALSE(rests_on_kink(wall, {0.1, 0.0, 0.0}, slope, 1e-3, 2e-3)) << "elsewhere";
  wall.bend_per_mm(1, 0) = 300.0;
  EXPECT_FALSE(rests_on_kink(wall, {5e-4, 0.0, 0.0}, slope, 1e-3, 2e-3))
      << "a slope that the field has on neither side";
}

}  // namespace
}  // namespace endowire::contact

#include "endowire/contact/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace endowire::contact {
namespace {

constexpr double kStiffness = 2.0;  // N/mm
constexpr double kCap = 0.15;       // mm

// Breaks when one of the three is changed without the others: Newton then converges slowly or to a wrong place.
TEST(WallResponse, ForceAndStiffnessAreTheDerivativesOfTheEnergy) {
  constexpr double h = 1e-7;
  for (double depth = 0.0003; depth < 0.4; depth += 0.0007) {
    const WallResponse w = wall_response(kStiffness, kCap, depth);
    const WallResponse ahead = wall_response(kStiffness, kCap, depth + h);
    const WallResponse behind = wall_response(kStiffness, kCap, depth - h);
    ASSERT_NEAR((ahead.energy_mj - behind.energy_mj) / (2.0 * h), w.force_n, 1e-8 + 1e-7 * w.force_n)
        << depth;
    ASSERT_NEAR((ahead.force_n - behind.force_n) / (2.0 * h), w.stiffness_n_per_mm,
                1e-4 * w.stiffness_n_per_mm + 1e-6)
        << depth;
    ASSERT_GT(w.force_n, 0.0) << depth;
    ASSERT_GT(w.stiffness_n_per_mm, 0.0) << depth;
    ASSERT_GT(ahead.force_n, behind.force_n) << depth;
  }
}

// Energy and force are continuous where the formula changes, the stiffness where the tangent begins. At the surface it jumps
// from nothing to k, and nowhere else.
TEST(WallResponse, IsContinuousWhereItsFormulaChanges) {
  constexpr double h = 1e-9;
  for (const double border : {0.0, 0.9 * kCap}) {
    const WallResponse below = wall_response(kStiffness, kCap, border - h);
    const WallResponse above = wall_response(kStiffness, kCap, border + h);
    EXPECT_NEAR(above.energy_mj, below.energy_mj, 1e-7) << border;
    EXPECT_NEAR(above.force_n, below.force_n, 1e-6) << border;
  }
  EXPECT_NEAR(wall_response(kStiffness, kCap, h).stiffness_n_per_mm, kStiffness, 1e-6);
  EXPECT_NEAR(wall_response(kStiffness, kCap, 0.9 * kCap - h).stiffness_n_per_mm,
              wall_response(kStiffness, kCap, 0.9 * kCap + h).stiffness_n_per_mm, 1e-4);
}

// The depth of a force is where the wall pushes back with it, up to the end of the law.
TEST(WallDepth, IsTheInverseOfTheForce) {
  for (const double depth : {0.0, 1e-6, 0.01, 0.07, 0.13}) {
    EXPECT_NEAR(wall_depth_mm(kStiffness, kCap, wall_response(kStiffness, kCap, depth).force_n), depth,
                1e-12);
  }
  EXPECT_DOUBLE_EQ(wall_depth_mm(kStiffness, kCap, 1e6), 0.9 * kCap);
}

// Outside the wall there is nothing at all.
TEST(WallResponse, VanishesOutside) {
  for (const double depth : {0.0, -1e-12, -0.3, -1e9, std::numeric_limits<double>::quiet_NaN()}) {
    const WallResponse w = wall_response(kStiffness, kCap, depth);
    EXPECT_EQ(w.energy_mj, 0.0);
    EXPECT_EQ(w.force_n, 0.0);
    EXPECT_EQ(w.stiffness_n_per_mm, 0.0);
  }
}

// F = k δ/(1 − δ/c); from δ = 0.9 c on its tangent of 100 k. Breaks when the wall no longer stiffens to its cap: an
// instrument would be pushed through.
TEST(WallResponse, StiffensToItsCap) {
  for (const double depth : {0.001, 0.02, 0.07, 0.13}) {
    EXPECT_NEAR(wall_response(kStiffness, kCap, depth).force_n, kStiffness * depth / (1.0 - depth / kCap),
                1e-12)
        << depth;
  }
  const double at_tangent = kStiffness * 0.9 * kCap / 0.1;
  const double slope = 100.0 * kStiffness;
  for (const double depth : {0.95 * kCap, kCap, 3.0 * kCap}) {
    const WallResponse w = wall_response(kStiffness, kCap, depth);
    EXPECT_NEAR(w.force_n, at_tangent + slope * (depth - 0.9 * kCap), 1e-10) << depth;
    EXPECT_NEAR(w.stiffness_n_per_mm, slope, 1e-10) << depth;
  }
  // At the cap: 19 times the force of a linear wall.
  EXPECT_NEAR(wall_response(kStiffness, kCap, kCap).force_n, 19.0 * kStiffness * kCap, 1e-10);
}

// k = 2 r E' (1/h + h/R²), by hand for one set of numbers, and its dependences.
TEST(WallStiffness, FollowsItsFormula) {
  WallSpec spec;
  spec.modulus_mpa = 0.8;
  spec.poisson_ratio = 0.3;
  spec.thickness_over_radius = 0.2;
  const double modulus = 0.8 / 0.91;
  EXPECT_NEAR(wall_stiffness_n_per_mm2(spec, 5.0, 0.4), 0.8 * modulus * (1.0 + 1.0 / 25.0), 1e-12);
  EXPECT_NEAR(tip_cap_stiffness_n_per_mm(spec, 0.4), 0.8 * modulus, 1e-12);
  WallSpec ten = spec;
  ten.modulus_mpa = 8.0;
  EXPECT_NEAR(wall_stiffness_n_per_mm2(ten, 5.0, 0.4), 10.0 * wall_stiffness_n_per_mm2(spec, 5.0, 0.4),
              1e-11);
}

// Each of the three limits of the cap is reached. Breaks when tissue to another lumen is ignored: two crossing depths
// would meet.
TEST(WallCap, IsTheSmallestOfThreeLimits) {
  WallSpec spec;  // thickness 0.15 R, cap at most 0.15 mm
  constexpr double far = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(wall_cap_mm(spec, 10.0, far), 0.15);
  EXPECT_DOUBLE_EQ(wall_cap_mm(spec, 1.0, far), 0.075);
  EXPECT_DOUBLE_EQ(wall_cap_mm(spec, 10.0, 0.3), 0.1);
}

}  // namespace
}  // namespace endowire::contact

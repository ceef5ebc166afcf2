#include "endowire/contact/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace endowire::contact {
namespace {

constexpr double kStiffness = 2.0;  // N/mm
constexpr double kCap = 0.15;       // mm

/// Depths at which the law changes its formula: entry, end of the onset, begin of the tangent.
const double kBorders[] = {0.0, kWallOnset_mm, 0.9 * kCap + 0.5 * kWallOnset_mm};

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

// Energy, force and Hessian are continuous where the formula changes. Breaks with a jump of the stiffness: Newton
// then cycles between the two sides.
TEST(WallResponse, IsContinuousToTheSecondDerivative) {
  constexpr double h = 1e-9;
  for (const double border : kBorders) {
    const WallResponse below = wall_response(kStiffness, kCap, border - h);
    const WallResponse above = wall_response(kStiffness, kCap, border + h);
    EXPECT_NEAR(above.energy_mj, below.energy_mj, 1e-7) << border;
    EXPECT_NEAR(above.force_n, below.force_n, 1e-6) << border;
    EXPECT_NEAR(above.stiffness_n_per_mm, below.stiffness_n_per_mm,
                1e-4 * (kStiffness + above.stiffness_n_per_mm))
        << border;
  }
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

// F = k s/(1 − s/c), s = δ − ε/2; from s = 0.9 c on its tangent of 100 k. Breaks when the wall no longer stiffens to
// its cap: an instrument would be pushed through.
TEST(WallResponse, StiffensToItsCap) {
  for (const double depth : {0.006, 0.02, 0.07, 0.13}) {
    const double s = depth - 0.5 * kWallOnset_mm;
    EXPECT_NEAR(wall_response(kStiffness, kCap, depth).force_n, kStiffness * s / (1.0 - s / kCap), 1e-12)
        << depth;
  }
  const double at_tangent = kStiffness * 0.9 * kCap / 0.1;
  const double slope = 100.0 * kStiffness;
  for (const double s : {0.95 * kCap, kCap, 3.0 * kCap}) {
    const WallResponse w = wall_response(kStiffness, kCap, s + 0.5 * kWallOnset_mm);
    EXPECT_NEAR(w.force_n, at_tangent + slope * (s - 0.9 * kCap), 1e-10) << s;
    EXPECT_NEAR(w.stiffness_n_per_mm, slope, 1e-10) << s;
    EXPECT_NEAR(w.bounded_force_n, at_tangent, 1e-10) << s;
  }
  // At the cap: 19 times the force of a linear wall.
  EXPECT_NEAR(wall_response(kStiffness, kCap, kCap + 0.5 * kWallOnset_mm).force_n, 19.0 * kStiffness * kCap,
              1e-10);
}

// Beyond the linear range the bounded force is the force itself.
TEST(WallResponse, BoundedForceIsTheForceWithinTheLaw) {
  for (double depth = 0.0005; depth < 0.9 * kCap; depth += 0.001) {
    const WallResponse w = wall_response(kStiffness, kCap, depth);
    EXPECT_DOUBLE_EQ(w.bounded_force_n, w.force_n) << depth;
  }
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

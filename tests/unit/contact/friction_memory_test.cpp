// Friction belongs to the wire, the force of the wall to the wall.
#include "endowire/contact/friction_memory.hpp"

#include <gtest/gtest.h>

namespace endowire::contact {
namespace {

/// A wall that pressed at an arc of 50 mm, and one at the tip; friction that grows along the wire.
FrictionMemory remembered() {
  FrictionMemory memory;
  for (int i = 0; i <= 100; ++i) {
    memory.arc_mm.push_back(i);
    memory.traction_n_per_mm.emplace_back(0.01 * i, -0.02 * i);
    memory.normal_n_per_mm.push_back(i == 50 ? 2.0 : i == 0 ? 1.0 : 0.0);
  }
  return memory;
}

Sample recalled(double arc_mm, double advanced_mm) {
  Sample sample;
  sample.arc_mm = arc_mm;
  sample.from_mm = arc_mm - 0.25;
  sample.to_mm = arc_mm + 0.25;
  remembered().recall(advanced_mm, sample);
  return sample;
}

TEST(FrictionMemory, TheForceIsThatOfTheWallThatTheWireHasComeTo) {
  for (const double advanced : {-2.0, -0.5, 0.0, 0.7, 3.0}) {
    const Sample there = recalled(50.0 + advanced, advanced);
    EXPECT_NEAR(there.lagged_normal_n, 2.0 * 0.5, 1e-12) << advanced;
    EXPECT_NEAR(recalled(47.0 + advanced, advanced).lagged_normal_n, 0.0, 1e-12) << advanced;
  }
  EXPECT_NEAR(recalled(50.5, 0.0).lagged_normal_n, 0.5, 1e-12);
}

TEST(FrictionMemory, FrictionIsThatOfTheMaterial) {
  for (const double advanced : {-2.0, 0.0, 3.0}) {
    const Sample s = recalled(30.25, advanced);
    EXPECT_LT((s.traction_n_per_mm - Eigen::Vector2d(0.3025, -0.605)).norm(), 1e-12) << advanced;
  }
}

// The contact of the tip goes with it.
TEST(FrictionMemory, TheTipTakesItsForceAlong) {
  for (const double advanced : {-1.0, 0.0, 1.0})
    EXPECT_NEAR(recalled(0.0, advanced).lagged_normal_n, 1.0 * 0.5, 1e-12) << advanced;
  EXPECT_NEAR(recalled(1.0, 1.0).lagged_normal_n, 0.0, 1e-12);
}

// Wire that was in the sheath remembers nothing.
TEST(FrictionMemory, NewWireHasNone) {
  const Sample s = recalled(100.5, 0.0);
  EXPECT_EQ(s.lagged_normal_n, 0.0);
  EXPECT_EQ(s.traction_n_per_mm, Eigen::Vector2d::Zero());
  Sample any;
  any.arc_mm = 5.0;
  FrictionMemory().recall(1.0, any);
  EXPECT_EQ(any.lagged_normal_n, 0.0);
}

}  // namespace
}  // namespace endowire::contact

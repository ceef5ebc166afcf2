// The shapes of a long snap: thinned evenly, never lost, never of a sub-step that failed.
#include "endowire/sim/waypoints.hpp"

#include <gtest/gtest.h>

namespace endowire::sim {
namespace {

/// Three joints that have all come to the same place.
std::vector<Eigen::Vector3d> joints_at(double x_mm) {
  return std::vector<Eigen::Vector3d>(3, Eigen::Vector3d(x_mm, 0.0, 0.0));
}

TEST(Waypoints, ALongWayIsThinnedEvenly) {
  Waypoints ways;
  ways.reserve(3);
  double last = 0.0;
  for (double x = 0.0; x <= 400.0; x += 0.1) {
    if (!ways.far_enough(x - last)) continue;
    ways.keep(joints_at(x), 10.0 + x, 1);
    last = x;
  }
  ASSERT_LE(ways.size(), 128);
  ASSERT_GE(ways.size(), 64);
  double before = 0.0;
  for (int k = 0; k < ways.size(); ++k) {
    const Waypoints::Shape& shape = ways.shape(k);
    ASSERT_EQ(shape.joints, 3U);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(ways.joints_mm(shape)[j].x(), shape.inserted_mm - 10.0, 1e-9);
    EXPECT_GT(shape.inserted_mm - 10.0, before);
    EXPECT_LE(shape.inserted_mm - 10.0 - before, 8.0 + 1e-9);
    before = shape.inserted_mm - 10.0;
  }
  EXPECT_GT(before, 392.0);
  ways.clear();
  EXPECT_EQ(ways.size(), 0);
  EXPECT_TRUE(ways.far_enough(0.5));
}

TEST(Waypoints, AFailedSubStepLeavesNone) {
  Waypoints ways;
  ways.reserve(3);
  for (int k = 0; k < 100; ++k) ways.keep(joints_at(k), 0.0, 1);
  // So many that those of the first sub-step are thinned while the second runs.
  for (int k = 100; k < 400; ++k) ways.keep(joints_at(k), 0.0, 2);
  ways.forget(2);
  ASSERT_GT(ways.size(), 2);
  for (int k = 0; k < ways.size(); ++k) {
    EXPECT_EQ(ways.shape(k).attempt, 1);
    EXPECT_LT(ways.joints_mm(ways.shape(k))->x(), 100.0);
  }
  ways.keep(joints_at(7.0), 0.0, 3);
  EXPECT_EQ(ways.last_mm(3)->x(), 7.0);
  EXPECT_EQ(ways.last_mm(4), nullptr);
}

}  // namespace
}  // namespace endowire::sim

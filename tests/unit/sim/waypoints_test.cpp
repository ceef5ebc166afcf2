// The shapes of a long snap: thinned evenly, never lost, never of a sub-step that failed.
#include "endowire/sim/waypoints.hpp"

#include <gtest/gtest.h>

namespace endowire::sim {
namespace {

/// Three joints that have all come to the same place.
std::vector<Eigen::Vector3d> joints_at(double x_mm) {
  return std::vector<Eigen::Vector3d>(3, Eigen::Vector3d(x_mm, 0.0, 0.0));
}

/// Their arcs tell where they were.
std::vector<double> arcs_at(double x_mm) {
  return {x_mm + 10.0, x_mm + 11.0, x_mm + 12.0};
}

TEST(Waypoints, ALongWayIsThinnedEvenly) {
  Waypoints ways;
  ways.reserve(3);
  double last = 0.0;
  for (double x = 0.0; x <= 400.0; x += 0.1) {
    if (!ways.far_enough(x - last)) continue;
    ways.keep(joints_at(x), arcs_at(x), 1);
    last = x;
  }
  ASSERT_LE(ways.size(), 128);
  ASSERT_GE(ways.size(), 64);
  double before = 0.0;
  for (int k = 0; k < ways.size(); ++k) {
    const Waypoints::Shape& shape = ways.shape(k);
    ASSERT_EQ(shape.joints, 3U);
    const double x = ways.joints_mm(shape)->x();
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(ways.joints_mm(shape)[j].x(), x);
      EXPECT_EQ(ways.arc_mm(shape)[j], arcs_at(x)[j]);
    }
    EXPECT_GT(x, before);
    EXPECT_LE(x - before, 8.0 + 1e-9);
    before = x;
  }
  EXPECT_GT(before, 392.0);
  ways.clear();
  EXPECT_EQ(ways.size(), 0);
  EXPECT_TRUE(ways.far_enough(0.5));
}

TEST(Waypoints, TheFirstOfASubStep) {
  Waypoints ways;
  ways.reserve(3);
  EXPECT_EQ(ways.first_of(1), nullptr);
  ways.keep(joints_at(1.0), arcs_at(1.0), 1);
  ways.keep(joints_at(2.0), arcs_at(2.0), 3);
  ways.keep(joints_at(3.0), arcs_at(3.0), 3);
  ASSERT_NE(ways.first_of(3), nullptr);
  EXPECT_EQ(ways.joints_mm(*ways.first_of(3))->x(), 2.0);
  EXPECT_EQ(ways.first_of(2), nullptr);
}

// Breaks when pieces of a long command are kept as if there were few: the first of them end up far apart.
TEST(Waypoints, PiecesOfALongCommandAreThinnedEvenly) {
  constexpr int kPieces = 3000;
  Waypoints ways;
  ways.reserve(3);
  for (int k = 0; k < kPieces; ++k) {
    if (ways.piece_is_due()) ways.keep(joints_at(k), arcs_at(k), k);
  }
  ASSERT_LE(ways.size(), 128);
  double before = 0.0;
  for (int k = 0; k < ways.size(); ++k) {
    const double x = ways.joints_mm(ways.shape(k))->x();
    EXPECT_LE(x - before, 64.0);
    before = x;
  }
  EXPECT_LE(kPieces - before, 64.0);
}

TEST(Waypoints, AFailedSubStepLeavesNone) {
  Waypoints ways;
  ways.reserve(3);
  for (int k = 0; k < 100; ++k) ways.keep(joints_at(k), arcs_at(k), 1);
  // So many that those of the first sub-step are thinned while the second runs.
  for (int k = 100; k < 400; ++k) ways.keep(joints_at(k), arcs_at(k), 2);
  ways.forget(2);
  ASSERT_GT(ways.size(), 2);
  for (int k = 0; k < ways.size(); ++k) {
    EXPECT_EQ(ways.shape(k).attempt, 1);
    EXPECT_LT(ways.joints_mm(ways.shape(k))->x(), 100.0);
  }
  ways.keep(joints_at(7.0), arcs_at(7.0), 3);
  EXPECT_EQ(ways.last_mm(3)->x(), 7.0);
  EXPECT_EQ(ways.last_mm(4), nullptr);
}

}  // namespace
}  // namespace endowire::sim

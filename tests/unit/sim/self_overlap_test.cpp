#include "endowire/sim/self_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "endowire/vessel/random.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

std::vector<SnapshotPoint> wire(int points, double radius_mm, const std::function<Vector3d(double)>& curve) {
  std::vector<SnapshotPoint> wire(static_cast<std::size_t>(points));
  for (std::size_t i = 0; i < wire.size(); ++i) {
    wire[i].position_mm = curve(static_cast<double>(i) / (points - 1.0));
    wire[i].radius_mm = radius_mm;
    if (i > 0) wire[i].arc_mm = wire[i - 1].arc_mm + (wire[i].position_mm - wire[i - 1].position_mm).norm();
  }
  return wire;
}

/// A coil of radius 10 mm whose turns are `pitch_mm` apart.
std::vector<SnapshotPoint> coil(int points, double turns, double pitch_mm) {
  return wire(points, 0.45, [=](double t) {
    const double a = 2.0 * std::numbers::pi * turns * t;
    return Vector3d(10.0 * std::cos(a), 10.0 * std::sin(a), pitch_mm * turns * t);
  });
}

TEST(SelfOverlap, AStraightWireAndAWideBendLieClear) {
  SelfOverlap overlap;
  EXPECT_TRUE(std::isinf(overlap.nearest({}).gap_mm));
  EXPECT_TRUE(
      std::isinf(overlap.nearest(wire(500, 0.45, [](double t) { return Vector3d(t * 500, 0, 0); })).gap_mm));
  // Rods far shorter than the wire is wide: neighbours always lie in each other.
  EXPECT_TRUE(
      std::isinf(overlap.nearest(wire(1000, 0.45, [](double t) { return Vector3d(0, t * 100, 0); })).gap_mm));
  EXPECT_TRUE(std::isinf(overlap.nearest(coil(40, 0.8, 0.0)).gap_mm));
}

TEST(SelfOverlap, TurnsNearerThanTheWireIsWideAreFound) {
  SelfOverlap overlap;
  EXPECT_TRUE(std::isinf(overlap.nearest(coil(600, 5.0, 1.0)).gap_mm)) << "0.1 mm apart";
  const SelfGap gap = overlap.nearest(coil(600, 5.0, 0.8));
  // Distance of two turns of a helix: pitch times the cosine of its slope.
  EXPECT_NEAR(gap.gap_mm, 0.8 * std::cos(std::atan(0.8 / (20.0 * std::numbers::pi))) - 0.9, 2e-3);
}

// Long rods that cross far from their joints: breaks when only joints are looked at.
TEST(SelfOverlap, RodsThatCrossInTheirMiddlesAreFound) {
  std::vector<SnapshotPoint> crossing(4);
  const std::vector<Vector3d> corners{{-20, 0, 0}, {20, 0, 0}, {0, 25, 0.5}, {0, -20, 0.5}};
  for (std::size_t i = 0; i < 4; ++i) {
    crossing[i].position_mm = corners[i];
    crossing[i].radius_mm = 0.45;
    if (i > 0) crossing[i].arc_mm = crossing[i - 1].arc_mm + (corners[i] - corners[i - 1]).norm();
  }
  SelfOverlap overlap;
  const SelfGap gap = overlap.nearest(crossing);
  EXPECT_NEAR(gap.gap_mm, 0.5 - 0.9, 1e-9);
  EXPECT_TRUE(gap.position_mm.isApprox(Vector3d::Zero(), 1e-9) || gap.position_mm.norm() < 1e-9);
}

/// Densely sampled, every pair: what the grid must find.
double brute_force_gap_mm(const std::vector<SnapshotPoint>& points, double least_arc_mm) {
  std::vector<std::pair<Vector3d, double>> samples;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k < 20; ++k) {
      const double w = k / 20.0;
      samples.emplace_back((1 - w) * points[i].position_mm + w * points[i + 1].position_mm,
                           (1 - w) * points[i].arc_mm + w * points[i + 1].arc_mm);
    }
  const double width = 2.0 * points.front().radius_mm;
  double least = HUGE_VAL;
  for (std::size_t a = 0; a < samples.size(); ++a)
    for (std::size_t b = a + 1; b < samples.size(); ++b)
      if (samples[b].second - samples[a].second > least_arc_mm)
        least = std::min(least, (samples[a].first - samples[b].first).norm() - width);
  return least;
}

TEST(SelfOverlap, AgreesWithEveryPairMeasuredOnRandomTangles) {
  vessel::SplitMix random(5);
  SelfOverlap overlap;
  int overlapping = 0;
  for (int round = 0; round < 250; ++round) {
    const Vector3d f(random.uniform(1, 9), random.uniform(1, 9), random.uniform(1, 9));
    const auto tangle = wire(60, 0.4, [&](double t) {
      return Vector3d(30 * std::sin(f.x() * t), 30 * std::sin(f.y() * t + 1), std::sin(f.z() * t + 2));
    });
    const double expected = brute_force_gap_mm(tangle, 0.8 * std::numbers::pi);
    // A hairpin of a few millimetres is neither one part nor two.
    if (expected != brute_force_gap_mm(tangle, 6.0)) continue;
    const SelfGap gap = overlap.nearest(tangle);
    if (expected < -0.1) {
      ++overlapping;
      EXPECT_NEAR(gap.gap_mm, expected, 0.15) << round;
    } else if (expected > 0.0) {
      EXPECT_TRUE(std::isinf(gap.gap_mm)) << round << ": " << gap.gap_mm << " against " << expected;
    }
  }
  EXPECT_GT(overlapping, 5);
}

// 2,600 rods in a winding wire: measured pairs grow with the rods, not with their square.
TEST(SelfOverlap, WorkGrowsWithTheRods) {
  const auto winding = [](int points) {
    return wire(points, 0.45,
                [](double t) { return Vector3d(2000 * t, 40 * std::sin(60 * t), 40 * std::cos(37 * t)); });
  };
  SelfOverlap overlap;
  EXPECT_TRUE(std::isinf(overlap.nearest(winding(651)).gap_mm));
  const std::size_t few = overlap.measured();
  EXPECT_TRUE(std::isinf(overlap.nearest(winding(2601)).gap_mm));
  EXPECT_LT(overlap.measured(), 10U * 2600U);
  EXPECT_LT(few, 10U * 1300U);
}

}  // namespace
}  // namespace endowire::sim

// V8: torque whip, the test made for guidewires.
#include <gtest/gtest.h>

#include <numbers>

#include "cases/cases.hpp"
#include "support/closed_forms.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

TEST(ClosedForms, TorqueWhipAgreesWithTheTable) {
  struct Row {
    double lambda;
    double hand_deg[5];
  };
  for (const Row& row : {Row{0.5, {33.646, 66.265, 97.158, 126.136, 153.516}},
                         Row{1.0, {45.353, 85.692, 118.412, 143.654, 163.294}},
                         Row{1.5, {67.324, 119.165, 151.898, 169.418, 177.094}},
                         Row{2.0, {102.342, 164.531, 191.782, 197.712, 191.601}}}) {
    for (int k = 0; k < 5; ++k) {
      EXPECT_NEAR(whip_hand_angle_rad(row.lambda, 30.0 * (k + 1) / kDegrees) * kDegrees, row.hand_deg[k],
                  1e-3);
    }
  }
}

TEST(ClosedForms, TorqueWhipSnapsAboveHalfPiOnly) {
  EXPECT_NEAR(whip_snap_angle_rad(2.0) * kDegrees, 198.0, 0.5);
  // At Λ = π/2 the hand's angle stops falling anywhere: the snap closes at 180°.
  EXPECT_NEAR(whip_snap_angle_rad(0.5 * std::numbers::pi + 1e-3) * kDegrees, 180.0, 0.1);
}

TEST(V8TorqueWhip, FollowsTheClosedFormOnAGivenCurve) {
  expect_to_hold(whip_on_a_given_curve(kRods));
}

TEST(V8TorqueWhip, FollowsTheClosedFormInATightTube) {
  expect_to_hold(whip_in_a_tube());
}

}  // namespace
}  // namespace endowire::test

// V6, V7: rods that twist buckles.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/closed_forms.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(ClosedForms, TwistedRodBucklesAsKnownWithoutTensionAndWhenLong) {
  // Without tension a clamped rod buckles at ML/EI = 2x, x = tan x.
  constexpr double kShort = 0.01;
  EXPECT_NEAR(2.0 * kShort * twisted_rod_onset(kShort), 2.0 * 4.493409, 1e-4);
  EXPECT_NEAR(twisted_rod_onset(400.0), 1.0, 1e-4);
}

TEST(ClosedForms, LocalisedBucklingBeginsWithTheOnset) {
  // No angle in the middle: M² = 4EI T, and the bend is endless.
  const LocalisedBuckling straight = localised_buckling(10.0, 0.1, 1e-4);
  EXPECT_NEAR(straight.moment_n_mm * straight.moment_n_mm, 4.0 * 10.0 * 0.1, 1e-7);
  EXPECT_GT(straight.extent_mm, 1e4);
}

TEST(V6MichellRing, LeavesItsPlaneAtTheCriticalTwist) {
  expect_to_hold(michell_ring(kRods));
}
TEST(V7TwistedRod, BucklesAtTheCriticalMoment) {
  expect_to_hold(twisted_rod(kRods));
}
TEST(V7LocalisedRod, HasTheShapeOfTheClosedForm) {
  expect_to_hold(localised_rod(kLocalisedRods));
}

TEST(V16OrderOfConvergence, IsTwoForTheMichellRing) {
  expect_second_order(michell_ring(50), michell_ring(100), 0.1, 1e-6);
  expect_second_order(michell_ring(100), michell_ring(200), 0.1, 1e-6);
}
TEST(V16OrderOfConvergence, IsTwoForTheLocalisedRod) {
  expect_second_order(localised_rod(200), localised_rod(400), 0.15, 1e-6);
}

}  // namespace
}  // namespace endowire::test

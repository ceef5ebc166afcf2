// V10, V11: forces along a wire in a bend, against closed forms for a tube without clearance.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V10Capstan, PullsWithTheExponentialOfFrictionAndAngle) {
  expect_to_hold(capstan());
}
TEST(V11Insertion, TakesInALooseTubeTheForceOfItsOuterWall) {
  expect_to_hold(insertion_into_a_torus());
}
TEST(V11Insertion, TakesTheForceThatBendingCosts) {
  expect_to_hold(insertion_into_a_bend());
}

}  // namespace
}  // namespace endowire::test

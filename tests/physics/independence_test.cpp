// V16: what must not matter, does not; what must balance, does.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V16Balance, InternalForcesAndMomentsSumToZero) {
  expect_to_hold(internal_balance());
}
TEST(V16Balance, HoldsAtEveryJointInEveryStep) {
  expect_to_hold(balance_at_rest());
}
TEST(V16Balance, WorkWithoutFrictionComesBack) {
  expect_to_hold(work_in_and_out());
}
TEST(V16RigidMotion, ChangesNothing) {
  expect_to_hold(rigid_motion());
}
TEST(V16StepSize, DoesNotMatterWithoutFriction) {
  expect_to_hold(step_size_without_friction());
}
TEST(V16StepSize, ConvergesToFirstOrderWithFriction) {
  expect_to_hold(step_size_with_friction());
}
TEST(V16RodLength, ConvergesToSecondOrderInContact) {
  expect_to_hold(rod_length_in_contact());
}
TEST(V16Remeshing, StaysWithinTheErrorOfDiscretisation) {
  expect_to_hold(remeshing());
}

}  // namespace
}  // namespace endowire::test

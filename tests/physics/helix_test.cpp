// V9: a wire compressed in a cylinder, without friction and with it.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V9Helix, HasThePitchAndTheWallForceOfItsCompression) {
  expect_to_hold(helix_in_a_cylinder());
}
TEST(V9Helix, LocksUpByFrictionAsTheClosedFormSays) {
  expect_to_hold(locking_helix());
}

}  // namespace
}  // namespace endowire::test

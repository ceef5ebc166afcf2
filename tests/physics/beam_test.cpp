// V12, V13: small deflections against beam theory, one with contact.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V12CurvedTip, PressesOnAWallAsABeam) {
  expect_to_hold(curved_tip_at_a_wall());
}
TEST(V13ThreePointBend, GivesBackTheModuliOfRealWires) {
  expect_to_hold(three_point_bend(kRods));
}

}  // namespace
}  // namespace endowire::test

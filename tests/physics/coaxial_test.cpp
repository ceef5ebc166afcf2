// V14: instruments within each other.
#include <gtest/gtest.h>

#include "cases/cases.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

TEST(V14Coaxial, ShareTheirCurvatureAndTurnOneAnother) {
  expect_to_hold(coaxial_instruments(kRods));
}
TEST(V14Coaxial, HoldEachOtherBackWhenTurned) {
  expect_to_hold(coaxial_stiff_in_torsion());
}
TEST(V14Coaxial, SecondOrderInTheRodLength) {
  expect_second_order(coaxial_instruments(kRods / 2), coaxial_instruments(kRods), 0.3, 1e-7);
}
TEST(V14Coaxial, SnapsWhereTheClosedFormDoes) {
  expect_to_hold(coaxial_snap());
}

}  // namespace
}  // namespace endowire::test

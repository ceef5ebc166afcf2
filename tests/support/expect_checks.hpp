#pragma once

#include <gtest/gtest.h>

#include "support/check.hpp"

namespace endowire::test {

inline void expect_to_hold(const Checks& checks) {
  ASSERT_FALSE(checks.empty());
  for (const Check& c : checks) {
    EXPECT_TRUE(c.holds()) << c.test << " " << c.quantity << ": " << c.ours << ", closed form " << c.reference
                           << " by " << c.formula << ", error " << c.error() << ", allowed " << c.tolerance;
  }
}

/// The errors of checks fall with the square of the rod length: between the two runs, from n to 2n rods, they must fall by a
/// factor of 4 to within the given share of an order. Errors below `floor` are left out; some must remain.
inline void expect_second_order(const Checks& coarse, const Checks& fine, double allowed_order_error,
                                double floor) {
  ASSERT_EQ(coarse.size(), fine.size());
  int measured = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    if (std::abs(fine[i].error()) < floor) continue;
    ++measured;
    EXPECT_NEAR(std::log2(coarse[i].error() / fine[i].error()), 2.0, allowed_order_error)
        << coarse[i].test << " " << coarse[i].quantity << ": errors " << coarse[i].error() << ", "
        << fine[i].error();
  }
  EXPECT_GT(measured, 0);
}

}  // namespace endowire::test

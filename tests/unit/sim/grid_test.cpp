#include "endowire/sim/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/wires.hpp"

namespace endowire::sim {
namespace {

// Breaks when a pre-curved tip gets rods too long for the angle of a joint.
TEST(UniformGrid, TurnsOfTheUnloadedWireAreLimited) {
  const rod::MaterialLine line(test::hydrophilic_035_angled());  // 5° per millimetre at the tip
  for (const double limit : {0.15, 0.08, 0.3}) {
    const std::vector<double> arcs = uniform_grid(line, 4.0, limit);
    EXPECT_EQ(arcs.front(), 0.0);
    EXPECT_GE(arcs.back(), line.length_mm());
    int shorter = 0;
    for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
      const double length = arcs[i + 1] - arcs[i];
      EXPECT_GT(length, 0.0);
      EXPECT_LE(length, 4.0);
      EXPECT_LE(line.rest_bend_rad(arcs[i], arcs[i + 1]).norm(), limit) << arcs[i];
      shorter += length < 4.0;
    }
    EXPECT_GT(shorter, 2);
    EXPECT_NEAR(arcs[arcs.size() - 1] - arcs[arcs.size() - 2], 4.0,
                1e-12);  // the straight shaft has whole rods
  }
}

TEST(UniformGrid, AStraightWireHasEqualRods) {
  const rod::MaterialLine line(test::uniform_wire(10.0, 8.0, 100.0));
  const std::vector<double> arcs = uniform_grid(line, 2.5, 0.15);
  ASSERT_EQ(arcs.size(), 41U);
  for (std::size_t i = 0; i < arcs.size(); ++i) EXPECT_NEAR(arcs[i], 2.5 * static_cast<double>(i), 1e-12);
}

// A curvature that no rod length makes gentle must not end in rods of no length.
TEST(UniformGrid, RodsAreNeverShorterThanAFifthOfAMillimetre) {
  rod::Instrument wire = test::curved_tip_wire();
  wire.sections[0].rest_curvature_per_mm = 2.0;
  wire.sections[0].kink_curvature_per_mm = 3.0;
  const std::vector<double> arcs = uniform_grid(rod::MaterialLine(wire), 4.0, 0.15);
  for (std::size_t i = 0; i + 1 < arcs.size(); ++i) EXPECT_GE(arcs[i + 1] - arcs[i], 0.2 - 1e-12);
}

}  // namespace
}  // namespace endowire::sim

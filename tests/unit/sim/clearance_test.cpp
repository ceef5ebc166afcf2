#include "endowire/sim/clearance.hpp"

#include <gtest/gtest.h>

#include "endowire/rod/chain.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "support/fields.hpp"
#include "support/simulations.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

TEST(CutsCorner, AWayThroughACarinaDoes) {
  const test::CarinaField carina(0.3, 5.0);  // tissue at x < 0, its edge on the y axis
  EXPECT_TRUE(cuts_corner(carina, {-1.0, 0.0, 0.8}, {-1.0, 0.0, -0.8}, 0.4, 1.0));
  EXPECT_FALSE(cuts_corner(carina, {1.0, 0.0, 0.8}, {1.0, 0.0, -0.8}, 0.4, 1.0)) << "past the edge";
  EXPECT_FALSE(cuts_corner(carina, {-1.0, 0.0, 0.8}, {-1.0, 0.0, -0.8}, 0.4, 0.1)) << "a snap";
  EXPECT_FALSE(cuts_corner(carina, {-0.05, 0.0, 0.1}, {-0.05, 0.0, -0.1}, 0.4, 1.0)) << "a short way";
}

TEST(LiesClear, UpToWhatTheWallYields) {
  const rod::MaterialLine line(test::uniform_wire(10.0, 8.0, 100.0));
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 2.0);
  rod::ChainMaterial material;
  rod::fill_material(line, {0.0, 10.0, 20.0, 30.0}, 0.0, 0.0, material);
  rod::ChainShape shape;
  const auto clear_at = [&](double x_mm) {
    shape.resize(3);
    for (std::size_t j = 0; j < 4; ++j)
      shape.joints_mm[j] = {j == 0 ? x_mm : 0.0, 0.0, 30.0 - 10.0 * static_cast<double>(j)};
    return lies_clear({line, material, shape}, tube, 0.2);
  };
  const double touching_mm = 2.0 - 0.4445;
  EXPECT_TRUE(clear_at(touching_mm));
  EXPECT_TRUE(clear_at(touching_mm + 0.19));
  EXPECT_FALSE(clear_at(touching_mm + 0.21));
}

}  // namespace
}  // namespace endowire::sim

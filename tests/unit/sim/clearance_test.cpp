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

// Round the carina, whose tissue is at x < 0 with its edge on the y axis, from above to below it.
TEST(LegCutsCorner, WhereAnyPointOfTheWireComesThroughWhatStandsOut) {
  const test::CarinaField carina(0.3, 5.0);
  const rod::MaterialLine line(test::uniform_wire(10.0, 8.0, 100.0));
  const std::vector<double> arcs{0.0, 4.0, 8.0, 12.0};
  const auto lying_at = [&](double x_mm, double z_mm) {
    std::vector<Vector3d> joints;
    for (const double arc : arcs) joints.emplace_back(x_mm, 0.7 * arc, z_mm);
    return joints;
  };
  const auto cuts = [&](const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
    return leg_cuts_corner(carina, line, {from.data(), arcs.data(), from.size()},
                           {to.data(), arcs.data(), to.size()});
  };
  EXPECT_TRUE(cuts(lying_at(-1.0, 0.9), lying_at(-1.0, -0.9)));
  EXPECT_FALSE(cuts(lying_at(1.0, 0.9), lying_at(1.0, -0.9))) << "past the edge";
  EXPECT_FALSE(cuts(lying_at(-1.0, 0.9), lying_at(-1.2, 0.9))) << "a short way";
  EXPECT_FALSE(cuts(lying_at(-1.0, 0.36), lying_at(-2.0, 0.66))) << "along the wall that it presses";
  // One rod only, far from the tip.
  std::vector<Vector3d> from = lying_at(1.0, 0.9);
  std::vector<Vector3d> to = lying_at(1.0, 0.8);
  from[3] = {-1.0, 8.4, 0.9};
  to[3] = {-1.0, 8.4, -0.9};
  EXPECT_TRUE(cuts(from, to));
}

// Breaks when the same joints stand for the same piece of wire in both shapes: between them the wire was pushed on.
TEST(LegCutsCorner, FollowsTheMaterialNotTheJoints) {
  const test::CarinaField carina(0.3, 5.0);
  const rod::MaterialLine line(test::uniform_wire(10.0, 8.0, 100.0));
  // A straight wire along x above the carina, pushed on by a rod: every joint is where the next one was.
  const std::vector<double> arcs{0.0, 2.0, 4.0, 6.0};
  std::vector<Vector3d> from, to;
  for (const double arc : arcs) {
    from.emplace_back(2.0 - arc, 0.0, 0.9);
    to.emplace_back(4.0 - arc, 0.0, 0.9);
  }
  const std::vector<double> later{0.0, 2.5, 4.5, 6.5};
  for (std::size_t j = 0; j < later.size(); ++j) to[j].x() = 4.0 - later[j];
  EXPECT_FALSE(leg_cuts_corner(carina, line, {from.data(), arcs.data(), 4}, {to.data(), later.data(), 4}));
  for (Vector3d& joint : to) joint.z() = -0.9;
  EXPECT_TRUE(leg_cuts_corner(carina, line, {from.data(), arcs.data(), 4}, {to.data(), later.data(), 4}));
}

// A crest narrower than half a millimetre, between points of the axis that are clear of it.
TEST(LiesClear, NotAcrossACrest) {
  const test::CarinaField carina(0.05, 5.0);
  const rod::MaterialLine line(test::uniform_wire(10.0, 8.0, 100.0));
  rod::ChainMaterial material;
  rod::fill_material(line, {0.0, 5.0, 10.0, 15.0}, 0.0, 0.0, material);
  rod::ChainShape shape;
  shape.resize(3);
  const auto clear_at = [&](double x_mm) {
    for (std::size_t j = 0; j < 4; ++j) shape.joints_mm[j] = {x_mm, 0.0, 4.75 - 5.0 * static_cast<double>(j)};
    return lies_clear({line, material, shape}, carina, 0.25);
  };
  EXPECT_TRUE(clear_at(1.0));
  EXPECT_FALSE(clear_at(0.0)) << "0.25 mm to either side of it the axis is clear";
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

#include "endowire/sim/target.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "support/hand_made_trees.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;
using test::message_of;

class TargetTest : public ::testing::Test {
 protected:
  static TargetSpec side(double beyond_mm) {
    TargetSpec spec;
    spec.branch = "1.1:1";
    spec.beyond_ostium_mm = beyond_mm;
    return spec;
  }
  [[nodiscard]] std::string refusal(const TargetSpec& spec) const {
    return message_of<base::InputError>([&] { static_cast<void>(find_target(tree_, spec)); });
  }
  vessel::CentrelineTree tree_ = test::tree_with_side_vessel();
};

TEST_F(TargetTest, LiesBeyondTheOstiumNotTheBifurcation) {
  const Target target = find_target(tree_, side(20.0));
  EXPECT_TRUE(target.position_mm.isApprox(Vector3d(25.0, 0.0, 60.0), 1e-9)) << target.position_mm.transpose();
  EXPECT_EQ(target.radius_mm, 2.0);
}

TEST_F(TargetTest, AVesselMeansItsFirstStretch) {
  TargetSpec spec = side(85.0);
  spec.branch = "1.1";
  const Target target = find_target(tree_, spec);
  EXPECT_EQ(target.branch, 2);
  EXPECT_EQ(target.position_mm, find_target(tree_, side(85.0)).position_mm);
}

TEST_F(TargetTest, GoesOnAlongTheSameVessel) {
  const Target target = find_target(tree_, side(85.0));
  EXPECT_EQ(target.goal.branch, 3);
  EXPECT_TRUE(target.position_mm.isApprox(Vector3d(80.0, 0.0, 70.0), 1e-9)) << target.position_mm.transpose();
}

TEST_F(TargetTest, IsReachedFromTheGoalOnWithinRadiiOfTheCentreline) {
  const Target target = find_target(tree_, side(20.0));
  const auto at = [&](double x, double y, double z) { return distance_to(target, tree_, {x, y, z}); };
  EXPECT_FALSE(at(24.0, 0, 60).reached);
  EXPECT_NEAR(at(24.0, 0, 60).to_go_mm, 1.0, 1e-9);
  EXPECT_TRUE(at(26.0, 0, 60).reached);
  EXPECT_EQ(at(26.0, 0, 60).to_go_mm, 0.0);
  EXPECT_NEAR(at(26.0, 1.0, 60).offset_radii, 0.5, 1e-9);
  EXPECT_TRUE(at(26.0, 2.9, 60).reached);
  EXPECT_FALSE(at(26.0, 3.1, 60).reached) << "1.55 radii off";
  EXPECT_EQ(at(26.0, 3.1, 60).to_go_mm, 0.0) << "far enough along, not near enough";
  EXPECT_TRUE(at(80.0, 0, 85).reached) << "further on in the same vessel";
}

// Breaks with a distance as the crow flies, or one that forgets the way back out of a wrong branch.
TEST_F(TargetTest, TheWayLeadsBackOutOfAWrongBranch) {
  const Target target = find_target(tree_, side(20.0));
  const TargetDistance wrong = distance_to(target, tree_, {0, 0, 90.0});
  EXPECT_FALSE(wrong.reached);
  EXPECT_NEAR(wrong.to_go_mm, 30.0 + 25.0, 1e-9);
  EXPECT_NEAR(distance_to(target, tree_, {0, 0, 10.0}).to_go_mm, 50.0 + 25.0, 1e-9);
}

TEST_F(TargetTest, APointTellsTheBranchAndHowFar) {
  TargetSpec spec;
  spec.near_mm = {45.0, 1.5, 60.0};
  Target target = find_target(tree_, spec);
  EXPECT_EQ(target.branch, 2);
  EXPECT_NEAR(target.beyond_ostium_mm, 40.0, 1e-9);
  EXPECT_TRUE(target.position_mm.isApprox(Vector3d(45.0, 0.0, 60.0), 1e-9));
  spec.beyond_ostium_mm = 10.0;
  target = find_target(tree_, spec);
  EXPECT_TRUE(target.position_mm.isApprox(Vector3d(15.0, 0.0, 60.0), 1e-9));
}

// Breaks when the goal falls back to where the parent begins.
TEST_F(TargetTest, APointBeforeAnOstiumIsTheEndOfTheParent) {
  TargetSpec spec;
  spec.near_mm = {4.0, 0.0, 60.0};  // the side vessel's ostium is at 5 mm
  const Target target = find_target(tree_, spec);
  EXPECT_EQ(target.branch, 0);
  EXPECT_NEAR(target.beyond_ostium_mm, 60.0, 1e-9);
  EXPECT_TRUE(target.position_mm.isApprox(Vector3d(0.0, 0.0, 60.0), 1e-9)) << target.position_mm.transpose();
}

TEST_F(TargetTest, WhatTheTreeHasNotIsRefused) {
  EXPECT_EQ(refusal(side(200.0)),
            "target.beyond_ostium_mm is 200; must be <= 105, where the vessel of branch 1.1:1 ends");
  TargetSpec spec;
  spec.branch = "9";
  EXPECT_EQ(refusal(spec), "target.branch is \"9\"; must be one of 1:1, 1:2, 1.1:1, 1.1:2");
  spec.branch.clear();
  spec.near_mm = {45.0, 20.0, 60.0};
  EXPECT_EQ(refusal(spec),
            "target.near_mm is 20 mm from the nearest centreline; must be <= 4, 2 radii of the lumen there");
  EXPECT_EQ(message_of<base::InputError>([] { static_cast<void>(find_target({}, side(1.0))); }),
            "target is given; must be left out: the vessel has no centrelines");
}

}  // namespace
}  // namespace endowire::sim

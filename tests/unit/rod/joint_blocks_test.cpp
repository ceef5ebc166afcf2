#include "endowire/rod/joint_blocks.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/frames.hpp"

namespace endowire::rod {
namespace {

using Eigen::Vector3d;

JointMaterial round_joint() {
  JointMaterial m;
  m.span_mm = 1.7;
  m.bend_n_mm2 = {31.0, 31.0};
  m.twist_n_mm2 = 23.0;
  return m;
}

Frame turned(const Frame& frame, double bend_rad, double plane_rad, double twist_rad) {
  const Vector3d axis = std::cos(plane_rad) * frame.col(0) + std::sin(plane_rad) * frame.col(1);
  return Eigen::AngleAxisd(bend_rad, axis) * (frame * Eigen::AngleAxisd(twist_rad, Vector3d::UnitZ()));
}

void expect_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double scale, const char* what) {
  EXPECT_LT((a - b).norm(), 1e-12 * (1.0 + scale)) << what;
}

/// A bend [rad] and a twist [rad].
class StraightJoint : public testing::TestWithParam<std::pair<double, double>> {};

// The closed form in tangents against the general one in turns of frames. Breaks with any sign or factor of the closed form.
TEST_P(StraightJoint, IsTheGeneralOne) {
  test::Random random(31);
  const auto [bend, twist] = GetParam();
  for (int trial = 0; trial < 20; ++trial) {
    const JointMaterial m = round_joint();
    const Frame hand = turned(Frame::Identity(), random.uniform(0.0, 3.0), random.uniform(0.0, 6.0), 1.0);
    const Frame tip = turned(hand, bend, random.uniform(0.0, 6.28), twist);
    const JointRods rods{hand, tip, 1.3, 2.1};
    ASSERT_TRUE(is_straight(m, rods));
    const double measured = twist_between(hand, tip, twist);
    JointDerivatives d;
    joint_derivatives(m, hand, tip, measured, d);
    JointBlocks general, straight;
    blocks_of(d, rods, general);
    straight_joint(m, rods, measured, straight);
    const double scale = general.hand_hand.norm() + general.tip_tip.norm();
    EXPECT_NEAR(straight.energy_mj, general.energy_mj, 1e-13 * (1.0 + general.energy_mj));
    EXPECT_EQ(straight.energy_mj, straight_joint_energy(m, hand, tip, measured));
    EXPECT_NEAR(straight_joint_energy(m, hand, tip, measured), joint_energy(m, hand, tip, measured),
                1e-13 * (1.0 + general.energy_mj));
    expect_equal(straight.hand, general.hand, scale, "hand");
    expect_equal(straight.tip, general.tip, scale, "tip");
    expect_equal(straight.hand_hand, general.hand_hand, scale, "hand, hand");
    expect_equal(straight.tip_tip, general.tip_tip, scale, "tip, tip");
    expect_equal(straight.hand_tip, general.hand_tip, scale, "hand, tip");
    expect_equal(straight.hand_by_hand_spin, general.hand_by_hand_spin, scale, "hand by its spin");
    expect_equal(straight.tip_by_hand_spin, general.tip_by_hand_spin, scale, "tip by the hand's spin");
    expect_equal(straight.hand_by_tip_spin, general.hand_by_tip_spin, scale, "hand by the tip's spin");
    expect_equal(straight.tip_by_tip_spin, general.tip_by_tip_spin, scale, "tip by its spin");
    EXPECT_NEAR(straight.hand_spin, general.hand_spin, 1e-12);
    EXPECT_NEAR(straight.tip_spin, general.tip_spin, 1e-12);
    EXPECT_NEAR(straight.hand_spin_twice, general.hand_spin_twice, 1e-12);
    EXPECT_NEAR(straight.spins, general.spins, 1e-12);
    EXPECT_NEAR(straight.tip_spin_twice, general.tip_spin_twice, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, StraightJoint,
                         testing::Values(std::pair{0.0, 0.0}, std::pair{1e-7, 0.2}, std::pair{0.02, -0.4},
                                         std::pair{0.3, 0.7}, std::pair{1.4, 2.0}));

// What the closed form leaves out goes the general way. Breaks when a rest curve, a flat section or a kink is lost.
TEST(IsStraight, OnlyWhatTheClosedFormCovers) {
  const Frame hand = Frame::Identity();
  const Frame tip = turned(hand, 0.2, 0.5, 0.0);
  const JointRods rods{hand, tip, 1.0, 1.0};
  EXPECT_TRUE(is_straight(round_joint(), rods));
  JointMaterial curved = round_joint();
  curved.rest_bend_rad = {0.0, 1e-9};
  EXPECT_FALSE(is_straight(curved, rods));
  JointMaterial flat = round_joint();
  flat.bend_n_mm2[1] *= 0.9;
  EXPECT_FALSE(is_straight(flat, rods));
  JointMaterial kinked = round_joint();
  kinked.kink_per_mm = 0.2 / kKinkStart / kinked.span_mm;  // the law begins at 0.2 rad
  EXPECT_FALSE(is_straight(kinked, rods));
  kinked.kink_per_mm *= 2.0;
  EXPECT_TRUE(is_straight(kinked, rods));
}

}  // namespace
}  // namespace endowire::rod

#include "endowire/sim/predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "endowire/sim/feed.hpp"
#include "support/chain_states.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

/// A bent chain whose last rod lies in a sheath: joint 14 at its end, 15 within.
class Predict : public testing::Test {
 protected:
  Predict() {
    const rod::MaterialLine line(test::curved_tip_wire());
    for (int i = 0; i <= 14; ++i) arcs_.push_back(3.0 * i);
    arcs_.push_back(arcs_.back() + kSheathRod_mm);
    rod::fill_material(line, arcs_, 0.0, 0.0, material_);
    test::Random random(91);
    shape_ = test::random_chain(arcs_, 0.1, 0.2, 1e-3, random);
    hold_in_sheath();
  }
  void hold_in_sheath() {
    direction_ = shape_.frames.back().col(2);
    point_ = shape_.joints_mm[14];
    shape_.joints_mm[15] = point_ - kSheathRod_mm * direction_;
  }
  /// As a simulation does: the arc of the last joint follows the advance after the prediction.
  rod::ChainShape predicted(double advance, double turn) {
    rod::ChainShape out = shape_;
    std::vector<Vector3d> scratch;
    follow_trace(material_, {advance, turn}, out, scratch);
    return out;
  }

  std::vector<double> arcs_;
  rod::ChainMaterial material_;
  rod::ChainShape shape_;
  Vector3d point_, direction_;
};

// Rods keep the strain (and so the force) they have; only the entering rod grows. Breaks when the wire is laid along
// the old polyline by arc: chords across its corners are shorter, which is newtons.
TEST_F(Predict, KeepsTheLengthsOfRods) {
  for (const double advance : {0.3, 1.0, 2.9, -0.4, 0.0}) {
    const rod::ChainShape out = predicted(advance, 0.0);
    for (std::size_t i = 0; i < 14; ++i) {
      const double before = (shape_.joints_mm[i] - shape_.joints_mm[i + 1]).norm();
      EXPECT_NEAR((out.joints_mm[i] - out.joints_mm[i + 1]).norm(),
                  i < 13 ? before : before * (3.0 + advance) / 3.0, 1e-12)
          << advance;
    }
    EXPECT_EQ(out.joints_mm[14], point_);
    EXPECT_EQ(out.joints_mm[15], shape_.joints_mm[15]);
    for (std::size_t i = 0; i < 15; ++i) {
      EXPECT_LT(test::frame_error(out.frames[i]), 1e-12);
      EXPECT_LT((out.frames[i].col(2) - (out.joints_mm[i] - out.joints_mm[i + 1]).normalized()).norm(),
                1e-12);
    }
  }
}

// Joints move along the rods ahead of them, second order in the angles between these: corners are cut. Breaks when the
// chain is shifted as a whole, or turned at the sheath: it would leave the vessel in every bend.
TEST_F(Predict, JointsFollowTheTrace) {
  const double advance = 1.0;
  const auto largest_miss = [&](double bend) {
    test::Random random(92);
    shape_ = test::random_chain(arcs_, bend, 0.2, 0.0, random);
    hold_in_sheath();
    const rod::ChainShape out = predicted(advance, 0.0);
    double worst = 0.0;
    for (std::size_t i = 0; i < 14; ++i) {
      // Joint i moves along rod i − 1, the tip along its own rod.
      const Vector3d along = shape_.frames[i == 0 ? 0 : i - 1].col(2);
      worst = std::max(worst, (out.joints_mm[i] - shape_.joints_mm[i] - advance * along).norm());
    }
    return worst;
  };
  test::expect_order(largest_miss, 2.0, 1e-12, "distance from the trace", 0.1, 4);
  EXPECT_LT(largest_miss(0.1), 0.3);
}

// On a straight wire the prediction is exact.
TEST_F(Predict, IsExactWhenStraight) {
  const Vector3d d = Vector3d(1, 2, 2) / 3.0;
  shape_ = test::straight_chain(arcs_, Vector3d::Zero(), d);
  hold_in_sheath();
  const rod::ChainShape out = predicted(0.8, 0.0);
  for (std::size_t i = 0; i < 14; ++i)
    EXPECT_LT((out.joints_mm[i] - shape_.joints_mm[i] - 0.8 * d).norm(), 1e-12);
}

// A turn of the hand turns the rod in the sheath at once and the others not yet: it is all in the twist of one joint.
TEST_F(Predict, TurnsOnlyTheRodInTheSheath) {
  const rod::ChainShape still = predicted(0.5, 0.0);
  for (const double turn : {0.4, -2.0, 4.0}) {
    const rod::ChainShape out = predicted(0.5, turn);
    EXPECT_NEAR(out.spin_rad[14], shape_.spin_rad[14] + turn, 1e-12);
    EXPECT_NEAR(out.twist_rad[14], still.twist_rad[14] - turn, 1e-12);
    for (std::size_t i = 0; i < 14; ++i) {
      EXPECT_EQ(out.spin_rad[i], shape_.spin_rad[i]);
      EXPECT_EQ(out.joints_mm[i], still.joints_mm[i]);
      if (i > 0) {
        EXPECT_NEAR(out.twist_rad[i], still.twist_rad[i], 1e-12);
      }
    }
  }
}

// The drift of the last step is taken over in proportion to the advance, twice at most and never backwards; not into the sheath.
TEST_F(Predict, TheDriftOfTheLastStepGoesOn) {
  Drift drift;
  drift.advance_mm = 0.5;
  drift.arc_mm.assign(arcs_.begin(), arcs_.begin() + 14);
  drift.joints_mm.assign(14, Vector3d::Zero());
  for (int j = 0; j < 8; ++j) {
    // Square to the rods: their lengths stay to first order.
    const Vector3d e = shape_.frames[static_cast<std::size_t>(j)].col(2);
    drift.joints_mm[static_cast<std::size_t>(j)] = 0.01 * (8 - j) * math::any_normal(e);
  }
  std::vector<Vector3d> scratch;
  const auto largest_move = [&](double advance) {
    rod::ChainShape out = shape_;
    follow_drift(drift, material_, advance, out, scratch);
    double largest = 0.0;
    for (std::size_t j = 0; j <= 15; ++j) {
      largest = std::max(largest, (out.joints_mm[j] - shape_.joints_mm[j]).norm());
      if (j < 14) {
        EXPECT_NEAR((out.joints_mm[j] - out.joints_mm[j + 1]).norm(),
                    (shape_.joints_mm[j] - shape_.joints_mm[j + 1]).norm(), 1e-12);
      }
      if (j >= 14) {
        EXPECT_EQ(out.joints_mm[j], shape_.joints_mm[j]);
      }
      if (j < 15) {
        EXPECT_LT(test::frame_error(out.frames[j]), 1e-12);
      }
    }
    return largest;
  };
  const double once = largest_move(0.5);
  EXPECT_NEAR(once, 0.08, 0.02);
  EXPECT_NEAR(largest_move(0.25), 0.5 * once, 0.1 * once);
  EXPECT_EQ(largest_move(1.0), largest_move(7.0));
  EXPECT_EQ(largest_move(0.0), 0.0);
  EXPECT_EQ(largest_move(-0.5), 0.0);
  drift.advance_mm = 0.0;
  EXPECT_EQ(largest_move(0.5), 0.0);
}

}  // namespace
}  // namespace endowire::sim

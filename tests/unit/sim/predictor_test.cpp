#include "endowire/sim/predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chain_states.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

/// A bent chain whose two last joints lie on the line of a sheath, symmetric about its end.
class Predict : public testing::Test {
 protected:
  Predict() {
    const rod::MaterialLine line(test::curved_tip_wire());
    for (int i = 0; i <= 14; ++i) arcs_.push_back(3.0 * i);
    arcs_.push_back(arcs_.back() + 2.0 * half_);
    rod::fill_material(line, arcs_, 0.0, 0.0, material_);
    test::Random random(91);
    shape_ = test::random_chain(arcs_, 0.1, 0.2, 1e-3, random);
    direction_ = shape_.frames.back().col(2);
    point_ = shape_.joints_mm[14] - half_ * direction_;
    inserted_ = arcs_[14] + half_;
    shape_.joints_mm[15] = point_ - half_ * direction_;
  }
  /// As a simulation does: the arc of the last joint follows the advance after the prediction.
  rod::ChainShape predicted(double advance, double turn) {
    rod::ChainShape out = shape_;
    std::vector<Vector3d> scratch;
    follow_trace(material_, point_, direction_, {inserted_ + advance, advance, turn}, out, scratch);
    return out;
  }

  double half_ = 1.7;
  std::vector<double> arcs_;
  rod::ChainMaterial material_;
  rod::ChainShape shape_;
  Vector3d point_, direction_;
  double inserted_ = 0.0;
};

// Rods keep the length (and so the force) they have; only the rod in the sheath grows. Breaks when the wire is laid along
// the old polyline by arc: chords across its corners are shorter, which is newtons.
TEST_F(Predict, KeepsTheLengthsOfRods) {
  for (const double advance : {0.3, 1.0, 2.9, -0.4, 0.0}) {
    const rod::ChainShape out = predicted(advance, 0.0);
    for (std::size_t i = 0; i < 14; ++i) {
      EXPECT_NEAR((out.joints_mm[i] - out.joints_mm[i + 1]).norm(),
                  (shape_.joints_mm[i] - shape_.joints_mm[i + 1]).norm(), 1e-12)
          << advance;
    }
    EXPECT_NEAR((out.joints_mm[14] - out.joints_mm[15]).norm(), 2.0 * (half_ + advance), 1e-12);
    EXPECT_LT((0.5 * (out.joints_mm[14] + out.joints_mm[15]) - point_).norm(), 1e-12);
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
    direction_ = shape_.frames.back().col(2);
    point_ = shape_.joints_mm[14] - half_ * direction_;
    shape_.joints_mm[15] = point_ - half_ * direction_;
    const rod::ChainShape out = predicted(advance, 0.0);
    double worst = 0.0;
    // Joint 14 stays on the line of the sheath, and all others come along.
    const Vector3d shift = advance * (direction_ - shape_.frames[13].col(2));
    for (std::size_t i = 0; i < 14; ++i) {
      // Joint i moves along rod i − 1, the tip along its own rod.
      const Vector3d along = shape_.frames[i == 0 ? 0 : i - 1].col(2);
      worst = std::max(worst, (out.joints_mm[i] - shape_.joints_mm[i] - advance * along - shift).norm());
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
  point_ = half_ * d;
  direction_ = d;
  const rod::ChainShape out = predicted(0.8, 0.0);
  for (std::size_t i = 0; i <= 14; ++i)
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
  drift.joints_mm.assign(16, Vector3d::Zero());
  for (int j = 0; j < 8; ++j) {
    // Square to the rods: their lengths stay to first order.
    const Vector3d e = shape_.frames[static_cast<std::size_t>(j)].col(2);
    drift.joints_mm[static_cast<std::size_t>(j)] = 0.01 * (8 - j) * math::any_normal(e);
  }
  std::vector<Vector3d> scratch;
  const auto largest_move = [&](double advance) {
    rod::ChainShape out = shape_;
    follow_drift(drift, advance, out, scratch);
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

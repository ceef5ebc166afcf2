// Rods are divided and joined on the curve that the chain stands for.
#include "endowire/rod/remesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/chain_states.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

using Eigen::Vector3d;

/// A helix from the sheath to the tip, turned along by a constant rate of twist.
class OnAHelix : public testing::Test {
 protected:
  static constexpr double kRadius_mm = 15.0;
  static constexpr double kClimb = 0.3;  // of the arc
  static constexpr double kTwist_per_mm = 0.01;

  static Vector3d point(double from_hand_mm) {
    const double a = from_hand_mm * std::sqrt(1.0 - kClimb * kClimb) / kRadius_mm;
    return {kRadius_mm * std::cos(a), kRadius_mm * std::sin(a), kClimb * from_hand_mm};
  }

  void lay(const std::vector<double>& arcs) {
    material_.resize(static_cast<int>(arcs.size()) - 1);
    material_.arc_mm = arcs;
    shape_ = test::straight_chain(arcs, Vector3d::Zero(), Vector3d::UnitZ());
    std::vector<double> d(4 * arcs.size(), 0.0);
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const Vector3d to = point(arcs.back() - arcs[i]) - shape_.joints_mm[i];
      for (std::size_t c = 0; c < 3; ++c) d[4 * i + c] = to[static_cast<Eigen::Index>(c)];
    }
    // Spun so that the twist between neighbours is that of the rate.
    shape_ = test::moved_chain(shape_, d, 1.0);
    std::vector<double> spin(4 * arcs.size(), 0.0);
    for (std::size_t j = arcs.size() - 2; j-- > 0;) {
      const double share = 0.5 * (arcs[j + 2] - arcs[j]);
      spin[4 * j + 3] = spin[4 * (j + 1) + 3] + kTwist_per_mm * share - shape_.twist_rad[j + 1];
    }
    shape_ = test::moved_chain(shape_, spin, 1.0);
  }

  [[nodiscard]] double off_helix_mm() const {
    double worst = 0.0;
    for (std::size_t i = 0; i < shape_.joints_mm.size(); ++i)
      worst = std::max(worst,
                       (shape_.joints_mm[i] - point(material_.arc_mm.back() - material_.arc_mm[i])).norm());
    return worst;
  }
  [[nodiscard]] double twist_rad() const {
    return std::accumulate(shape_.twist_rad.begin(), shape_.twist_rad.end(), 0.0);
  }
  void expect_sound() const {
    const auto rods = static_cast<std::size_t>(shape_.rods());
    ASSERT_EQ(shape_.joints_mm.size(), rods + 1);
    ASSERT_EQ(material_.arc_mm.size(), rods + 1);
    ASSERT_EQ(shape_.twist_rad.size(), rods + 1);
    for (std::size_t i = 0; i < rods; ++i) {
      EXPECT_LT(test::frame_error(shape_.frames[i]), 1e-12) << i;
      const Vector3d e = (shape_.joints_mm[i] - shape_.joints_mm[i + 1]).normalized();
      EXPECT_LT((shape_.frames[i].col(2) - e).norm(), 1e-9) << i;
    }
    for (std::size_t j = 1; j < rods; ++j)
      EXPECT_NEAR(shape_.twist_rad[j],
                  twist_between(shape_.frames[j], shape_.frames[j - 1], shape_.twist_rad[j]), 1e-9)
          << j;
  }

  ChainMaterial material_;
  ChainShape shape_;
};

TEST_F(OnAHelix, ANewJointLiesOnTheCurve) {
  double last = 0.0;
  for (const double length : {8.0, 4.0, 2.0}) {
    std::vector<double> arcs;
    for (int i = 0; i <= 9; ++i) arcs.push_back(length * i);
    lay(arcs);
    const double twist = twist_rad();
    divide_rod(material_, shape_, 4, 4.4 * length);
    expect_sound();
    EXPECT_EQ(shape_.rods(), 10);
    EXPECT_EQ(material_.arc_mm[5], 4.4 * length);
    EXPECT_NEAR(twist_rad(), twist, 1e-5 * length * length * length) << "the hand turned the tip";
    // Chords are shorter than arcs: the rods lie on the curve to third order.
    const double off = off_helix_mm();
    EXPECT_LT(off, 0.05 * length * length * length / (kRadius_mm * kRadius_mm));
    if (last > 0.0) {
      EXPECT_LT(off, last / 6.0);
    }
    last = off;
  }
}

TEST_F(OnAHelix, TheTipIsDividedToo) {
  lay(test::even_arcs(9, 4.0));
  divide_rod(material_, shape_, 0, 1.5);
  expect_sound();
  EXPECT_LT(off_helix_mm(), 0.03);
}

TEST_F(OnAHelix, DividingAndJoiningIsNothing) {
  lay(test::even_arcs(9, 4.0));
  const ChainShape before = shape_;
  const std::vector<double> arcs = material_.arc_mm;
  divide_rod(material_, shape_, 4, 17.0);
  join_rods(material_, shape_, 5);
  expect_sound();
  EXPECT_EQ(material_.arc_mm, arcs);
  for (std::size_t i = 0; i < before.joints_mm.size(); ++i)
    EXPECT_LT((shape_.joints_mm[i] - before.joints_mm[i]).norm(), 0.01) << i;
  for (std::size_t j = 1; j + 1 < before.twist_rad.size(); ++j)
    EXPECT_NEAR(shape_.twist_rad[j], before.twist_rad[j], 1e-3) << j;
  for (std::size_t i = 0; i < before.frames.size(); ++i)
    EXPECT_LT((shape_.frames[i] - before.frames[i]).norm(), 5e-3) << i;
}

TEST_F(OnAHelix, StrainIsKept) {
  lay(test::even_arcs(9, 4.0));
  const auto strain = [&](std::size_t i) {
    return (shape_.joints_mm[i] - shape_.joints_mm[i + 1]).norm() /
               (material_.arc_mm[i + 1] - material_.arc_mm[i]) -
           1.0;
  };
  const double before = strain(4);
  divide_rod(material_, shape_, 4, 17.0);
  EXPECT_NEAR(strain(4), before, 1e-12);
  EXPECT_NEAR(strain(5), before, 1e-12);
  join_rods(material_, shape_, 5);
  EXPECT_NEAR(strain(4), before, 1e-12);
}

}  // namespace
}  // namespace endowire::rod

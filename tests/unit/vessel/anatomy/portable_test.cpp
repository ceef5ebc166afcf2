#include "endowire/vessel/anatomy/portable.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "endowire/vessel/random.hpp"

namespace endowire::vessel::anatomy {
namespace {

TEST(Portable, SineAndCosineAgreeWithTheLibraryToTheLastBits) {
  SplitMix random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double x = random.uniform(-30.0, 30.0);
    EXPECT_NEAR(sine(x), std::sin(x), 1e-15) << x;
    EXPECT_NEAR(cosine(x), std::cos(x), 1e-15) << x;
  }
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Portable, TurnsRightHanded) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  EXPECT_LT((turned(x, z, radians(90.0)) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  const Eigen::Vector3d axis = unit({1.0, -2.0, 0.5});
  const Eigen::Vector3d v(0.3, 0.7, -1.1);
  EXPECT_LT((turned(v, axis, 0.83) - Eigen::AngleAxisd(0.83, axis) * v).norm(), 1e-15);
}

TEST(Portable, SmoothStepHasTwoContinuousDerivatives) {
  EXPECT_EQ(smooth_step(-0.5), 0.0);
  EXPECT_EQ(smooth_step(1.5), 1.0);
  EXPECT_DOUBLE_EQ(smooth_step(0.5), 0.5);
  constexpr double h = 1e-4;
  for (const double u : {0.0, 1.0}) {  // second difference across the ends goes to zero with h
    const double second = (smooth_step(u + h) - 2.0 * smooth_step(u) + smooth_step(u - h)) / (h * h);
    EXPECT_NEAR(second, 0.0, 60.0 * h);
  }
}

}  // namespace
}  // namespace endowire::vessel::anatomy

#include "endowire/vessel/anatomy/radius_profile.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace endowire::vessel::anatomy {
namespace {

const std::vector<RadiusProfile::Mark> aorta{{0.0, 12.0},   {30.0, 15.0}, {90.0, 13.0},
                                             {200.0, 12.0}, {240.0, 6.0}, {300.0, 6.0}};

TEST(RadiusProfile, ComesBackAtItsMarksAndNeverOvershoots) {
  const RadiusProfile profile(aorta);
  const std::array<double, 6> slope_change{0.1, -2.0 / 60 - 0.1, 2.0 / 60 - 1.0 / 110, 1.0 / 110 - 0.15, 0.15,
                                           0.0};
  for (std::size_t i = 0; i < aorta.size(); ++i)  // the rounding of a bend 24 mm long
    EXPECT_NEAR(profile.at(aorta[i].arc_mm).radius_mm,
                aorta[i].radius_mm + 3.0 / 16.0 * 12.0 * slope_change[i], 1e-9)
        << aorta[i].arc_mm;
  EXPECT_DOUBLE_EQ(profile.at(-100.0).radius_mm, 12.0);
  EXPECT_NEAR(profile.at(400.0).radius_mm, 6.0, 1e-12);
  for (double s = -10.0; s < 320.0; s += 0.5) {
    EXPECT_LE(profile.at(s).radius_mm, 15.0);
    EXPECT_GE(profile.at(s).radius_mm, 6.0 - 1e-12);
  }
}

TEST(RadiusProfile, HasTwoContinuousDerivativesLesionsIncluded) {
  RadiusProfile profile(aorta);
  profile.add({150.0, 30.0, 0.4});
  profile.add({60.0, 40.0, 1.8});
  constexpr double h = 1e-4;
  double last_bend = profile.at(-20.0).bend_per_mm;
  for (double s = -20.0; s < 320.0; s += 0.05) {
    const RadiusProfile::Value here = profile.at(s);
    const double difference = (profile.at(s + h).radius_mm - profile.at(s - h).radius_mm) / (2.0 * h);
    EXPECT_NEAR(here.slope, difference, 1e-6) << s;
    EXPECT_NEAR(here.bend_per_mm, (profile.at(s + h).slope - profile.at(s - h).slope) / (2.0 * h), 1e-5) << s;
    EXPECT_LT(std::abs(here.bend_per_mm - last_bend), 0.02) << "jumps at " << s;
    last_bend = here.bend_per_mm;
  }
}

TEST(RadiusProfile, ALesionIsAsDeepAndAsLongAsStated) {
  RadiusProfile profile({{0.0, 4.0}});
  profile.add({50.0, 20.0, 0.3});
  EXPECT_DOUBLE_EQ(profile.at(50.0).radius_mm, 1.2);
  EXPECT_DOUBLE_EQ(profile.at(40.0).radius_mm, 4.0);
  EXPECT_DOUBLE_EQ(profile.at(60.0).radius_mm, 4.0);
  EXPECT_LT(profile.at(42.0).radius_mm, 4.0);
}

}  // namespace
}  // namespace endowire::vessel::anatomy

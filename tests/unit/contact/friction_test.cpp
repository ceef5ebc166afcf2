#include "endowire/contact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/frames.hpp"
#include "support/taylor.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector2d;

const FrictionLaw kLaw{30.0, 0.06};  // sticks up to 2 µm
constexpr double kStick_mm = 0.06 / 30.0;

Vector2d polar(double length, double angle) {
  return {length * std::cos(angle), length * std::sin(angle)};
}

// Breaks when force or stiffness no longer belong to the energy.
TEST(Friction, ForceAndStiffnessAreTheDerivativesOfTheEnergy) {
  test::Random random(41);
  for (const double ratio : {0.1, 0.7, 1.5, 10.0, 1000.0}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Vector2d slip = polar(ratio * kStick_mm, random.uniform(0.0, 6.28));
      const Vector2d v = polar(1.0, random.uniform(0.0, 6.28));
      const FrictionResponse r = friction_response(kLaw, slip);
      EXPECT_DOUBLE_EQ(r.energy_mj, friction_energy_mj(kLaw, slip));
      EXPECT_GT(r.force_n.norm(), 0.0);
      // The energy is of the size kμN: rounding is judged against that.
      test::expect_taylor([&](double h) { return friction_energy_mj(kLaw, slip + h * v); }, r.force_n.dot(v),
                          v.dot(r.stiffness_n_per_mm * v), 0.0, "friction", 0.1 * kStick_mm);
    }
  }
}

// Coulomb: never more than μN, exactly μN while sliding, against the slip. Breaks with regularised or viscous friction.
TEST(Friction, ForceIsLimited) {
  for (double ratio = 0.0; ratio < 50.0; ratio += 0.13) {
    const Vector2d slip = polar(ratio * kStick_mm, 0.7);
    const Vector2d force = friction_response(kLaw, slip).force_n;
    EXPECT_NEAR(force.norm(), std::min(1.0, ratio) * kLaw.limit_n, 1e-15);
    if (ratio > 0.0) {
      EXPECT_NEAR(force.normalized().dot(slip.normalized()), 1.0, 1e-12);
    }
  }
}

TEST(Friction, EnergyAndForceAreContinuousAtTheLimit) {
  const FrictionResponse below = friction_response(kLaw, {kStick_mm * (1.0 - 1e-9), 0.0});
  const FrictionResponse above = friction_response(kLaw, {kStick_mm * (1.0 + 1e-9), 0.0});
  EXPECT_NEAR(below.energy_mj, above.energy_mj, 1e-12);
  EXPECT_NEAR(below.force_n.x(), above.force_n.x(), 1e-9);
}

// Return mapping: the anchor lies within the limit, in the direction of the slip, and gives the force that acted.
// Breaks when sliding leaves the anchor behind, which would store energy without bound.
TEST(Friction, TheAnchorIsDrawnToTheLimit) {
  for (const double ratio : {0.3, 1.0, 1.7, 400.0}) {
    const Vector2d slip = polar(ratio * kStick_mm, 2.2);
    const Vector2d anchor = friction_anchor(kLaw, slip);
    EXPECT_NEAR(anchor.norm(), std::min(1.0, ratio) * kStick_mm, 1e-16);
    EXPECT_LT((friction_response(kLaw, anchor).force_n - friction_response(kLaw, slip).force_n).norm(),
              1e-15);
  }
}

// A wire that sticks does not creep, however many steps nothing happens. Breaks with any relaxation of the anchor.
TEST(Friction, StickDoesNotDrift) {
  const Vector2d start = polar(0.6 * kStick_mm, 1.1);
  Vector2d anchor = start;
  for (int step = 0; step < 100000; ++step) anchor = friction_anchor(kLaw, anchor);
  EXPECT_EQ(anchor, start);
  // At the limit itself the mapping may lose a last digit once, not again and again.
  const Vector2d slid = friction_anchor(kLaw, polar(7.0 * kStick_mm, 1.1));
  anchor = slid;
  for (int step = 0; step < 100000; ++step) anchor = friction_anchor(kLaw, anchor);
  EXPECT_LT((anchor - slid).norm(), 1e-15 * kStick_mm);
}

// Sliding and turning share one limit: a wire that turns resists sliding less, and the more the faster it turns. Breaks
// when the two directions get a limit each.
TEST(Friction, TurningEasesSliding) {
  const double sliding = 3.0 * kStick_mm;
  double last = HUGE_VAL;
  for (const double turning : {0.0, 1.0, 3.0, 10.0, 100.0}) {
    const Vector2d force = friction_response(kLaw, {sliding, turning * kStick_mm}).force_n;
    EXPECT_NEAR(force.norm(), kLaw.limit_n, 1e-15);
    EXPECT_LT(force.x(), last);
    EXPECT_NEAR(force.x(), kLaw.limit_n * 3.0 / std::hypot(3.0, turning), 1e-15);
    last = force.x();
  }
  EXPECT_LT(last, 0.031 * kLaw.limit_n);
}

// Back and forth over a cycle the wire loses 4 μN (a − μN/k) of work: that is what hysteresis under torque is.
TEST(Friction, ACycleLosesTheWorkOfCoulomb) {
  const double amplitude = 5.0 * kStick_mm;
  double anchor = 0.0;
  double x = 0.0;
  double work = 0.0;
  const int steps = 20000;
  double last_force = 0.0;
  for (int k = 1; k <= 3 * steps; ++k) {
    const double next = amplitude * std::sin(2.0 * M_PI * k / steps);
    const Vector2d slip(anchor + next - x, 0.0);
    const double force = friction_response(kLaw, slip).force_n.x();
    if (k > 2 * steps) work += 0.5 * (force + last_force) * (next - x);
    last_force = force;
    anchor = friction_anchor(kLaw, slip).x();
    x = next;
  }
  EXPECT_NEAR(work, 4.0 * kLaw.limit_n * (amplitude - kStick_mm), 1e-3 * work);
}

// Without a normal force there is no friction and no division by its zero.
TEST(Friction, NoNormalForceNoFriction) {
  const FrictionLaw none{30.0, 0.0};
  EXPECT_EQ(friction_response(none, {0.1, 0.2}).force_n.norm(), 0.0);
  EXPECT_EQ(friction_anchor(none, {0.1, 0.2}).norm(), 0.0);
  EXPECT_TRUE(friction_response(none, {0.0, 0.0}).stiffness_n_per_mm.allFinite());
}

}  // namespace
}  // namespace endowire::contact

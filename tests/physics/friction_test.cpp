// Friction and torque as the hand feels them, against closed forms where there are any.
//
// A straight, heavy wire lies on the bottom of a straight tube that fits it closely; w is its weight per length, r its radius, L the
// length in the tube, μ its friction. Where its surface slides at an angle γ to its axis, it is pushed and turned by
//
//   F = L μ N cos γ,   T = L r μ N sin γ,   N = w cos β,   tan β = μ sin γ
//
// β is how far turning makes it climb the wall: there the friction round the wire carries what the wall no longer carries of the weight.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "support/simulations.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLength_mm = 200.0;
constexpr double kRadius_mm = 0.4445;
constexpr double kClearance_mm = 0.05;
constexpr double kWeight_n_per_mm = 5e-4;
constexpr double kGravity_m_per_s2 = 10.0;
constexpr double kFriction = 0.3;
constexpr double kTorsional_n_mm2 = 5.0;

rod::Instrument heavy_wire(double tip_friction, double shaft_friction) {
  rod::Instrument wire = test::uniform_wire(10.0, kTorsional_n_mm2, 0.25 * kLength_mm);
  // Thousand-fold: grams are kilograms, and metres a second squared are millimetres'.
  wire.sections[0].linear_density_g_per_mm = kWeight_n_per_mm / kGravity_m_per_s2 * 1e3;
  wire.sections[0].friction = tip_friction;
  wire.sections.push_back(wire.sections[0]);
  wire.sections[1].length_mm = 2.0 * kLength_mm;
  wire.sections[1].friction = shaft_friction;
  return wire;
}

/// The wire on the bottom of its tube, pushed in to its length.
Simulation lying(double tip_friction, double shaft_friction) {
  SimulationSpec spec;
  spec.gravity_m_per_s2 = {0.0, -kGravity_m_per_s2, 0.0};
  spec.blood_density_g_per_mm3 = 0.0;
  const Eigen::Vector3d bottom_mm(0.0, -kClearance_mm, 0.0);
  Simulation simulation(test::straight_tube(kRadius_mm + kClearance_mm),
                        heavy_wire(tip_friction, shaft_friction), {bottom_mm, Eigen::Vector3d::UnitZ()},
                        spec);
  test::run(simulation, static_cast<int>(kLength_mm), {1.0, 0.0});
  return simulation;
}

double tip_turn_rad(const Simulation& simulation) {
  return simulation.state().spin_rad.front();
}

double relative_error(double value, double exact) {
  return std::abs(value / exact - 1.0);
}

// The sheath carries the weight of half a rod.
TEST(LyingWire, PushIsFrictionTimesWeight) {
  Simulation simulation = lying(kFriction, kFriction);
  const StepReport& report = simulation.step({1.0, 0.0});
  EXPECT_LT(relative_error(report.push_force_n, kFriction * kWeight_n_per_mm * report.inserted_length_mm),
            0.01);
}

TEST(LyingWire, EverySectionHasItsOwnFriction) {
  Simulation simulation = lying(0.4, 0.1);
  const double tip_mm = 0.25 * kLength_mm;
  const StepReport& report = simulation.step({1.0, 0.0});
  const double shaft_mm = report.inserted_length_mm - tip_mm;
  EXPECT_LT(relative_error(report.push_force_n, kWeight_n_per_mm * (0.4 * tip_mm + 0.1 * shaft_mm)), 0.01);
}

// A wire that is stuck is eased by turning it: as fast round as forward, √2 times.
TEST(LyingWire, TurningEasesThePush) {
  Simulation simulation = lying(kFriction, kFriction);
  const double advance_mm = 0.5;
  StepReport report;
  for (int i = 0; i < 60; ++i) {
    report = simulation.step({advance_mm, advance_mm / kRadius_mm});
    ASSERT_TRUE(report.converged) << i;
  }
  const double gamma = 45.0 * kDegree;
  const double beta = std::atan(kFriction * std::sin(gamma));
  const double sliding_n = kFriction * kWeight_n_per_mm * std::cos(beta) * report.inserted_length_mm;
  EXPECT_LT(relative_error(report.push_force_n, sliding_n * std::cos(gamma)), 0.01);
  EXPECT_LT(relative_error(report.torque_n_mm, sliding_n * kRadius_mm * std::sin(gamma)), 0.01);
}

// Torque lag: m(s) = s T/L from the tip, so that the wire is twisted by T L/2GJ before all of it turns, and by twice that when the
// hand turns back.
TEST(LyingWire, TheTipLagsTheHandAndTwiceAsFarWhenItTurnsBack) {
  Simulation simulation = lying(kFriction, kFriction);
  const double length_mm = simulation.state().inserted_mm;
  const double torque_n_mm = length_mm * kRadius_mm * kWeight_n_per_mm * std::sin(std::atan(kFriction));
  const double lag_rad = torque_n_mm * length_mm / (2.0 * kTorsional_n_mm2);
  ASSERT_GT(lag_rad, 10.0 * kDegree);
  const auto lag_of = [&] { return simulation.state().hand_turn_rad - tip_turn_rad(simulation); };
  const auto turn = [&](double by_rad) {
    const int steps = static_cast<int>(std::ceil(std::abs(by_rad) / kDegree));
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(simulation.step({0.0, by_rad / steps}).converged) << i;
  };
  turn(0.5 * lag_rad);
  EXPECT_LT(tip_turn_rad(simulation), 0.05 * lag_rad);  // it sticks
  turn(lag_rad);
  EXPECT_LT(relative_error(lag_of(), lag_rad), 0.01);
  EXPECT_LT(relative_error(simulation.step({0.0, kDegree}).torque_n_mm, torque_n_mm), 0.01);
  const double furthest_rad = tip_turn_rad(simulation);
  turn(-lag_rad);
  EXPECT_LT(furthest_rad - tip_turn_rad(simulation), 0.1 * lag_rad);  // and sticks again
  turn(-1.5 * lag_rad);
  EXPECT_LT(relative_error(lag_of(), -lag_rad), 0.01);
}

/// The largest turn of the tip in a step of one degree of the hand, and the hand's turn before it.
struct Whip {
  double jump_rad = 0.0, hand_rad = 0.0;
  bool converged = true;
};

/// A wire of rest curvature κ0 in a tube of curvature κt, of length L = 2 √(GJ/EI κ0 κt): it whips.
Whip whip(double friction) {
  constexpr double kBend_mm = 40.0;
  constexpr double kRest_per_mm = 1.0 / 30.0;
  constexpr double kBending_n_mm2 = 10.0;
  rod::Instrument wire = test::uniform_wire(kBending_n_mm2, kTorsional_n_mm2, 400.0);
  rod::Section& section = wire.sections[0];
  section.friction = friction;
  section.rest_curvature_per_mm = kRest_per_mm;
  section.rest_plane_rad = -0.5 * std::numbers::pi;
  const double length_mm = 2.0 * std::sqrt(kTorsional_n_mm2 / (kBending_n_mm2 * kRest_per_mm / kBend_mm));
  SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  const auto tube = std::make_shared<vessel::BentTubeField>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(),
                                                            Eigen::Vector3d(0.0, kBend_mm, 0.0), kBend_mm,
                                                            std::numbers::pi, kRadius_mm + kClearance_mm);
  Simulation simulation(tube, wire, {Eigen::Vector3d(-5.0, 0.0, 0.0), Eigen::Vector3d::UnitX()}, spec);
  Whip result;
  result.converged = simulation.step({5.0 + length_mm, 0.0}).converged;
  double before = tip_turn_rad(simulation);
  for (int i = 0; i < 240; ++i) {
    result.converged = simulation.step({0.0, kDegree}).converged && result.converged;
    const double turned = tip_turn_rad(simulation) - before;
    before += turned;
    if (turned > result.jump_rad)
      result = {turned, simulation.state().hand_turn_rad - kDegree, result.converged};
  }
  return result;
}

// Stick and slip: the tip of a curved wire in a curved vessel stays behind, lets go and jumps. Friction holds it longer.
TEST(CurvedWire, WhipsAndLaterWithFriction) {
  const Whip smooth = whip(0.0);
  const Whip rough = whip(0.05);
  const Whip rougher = whip(0.1);
  for (const Whip& w : {smooth, rough, rougher}) {
    EXPECT_TRUE(w.converged);
    EXPECT_GT(w.jump_rad, 60.0 * kDegree);
  }
  EXPECT_GT(rough.hand_rad, smooth.hand_rad + 0.5 * kDegree);
  EXPECT_GT(rougher.hand_rad, rough.hand_rad + 0.5 * kDegree);
}

/// A wire that was pushed, turned and drawn back a little, less than lets it slide: it rests under loads at both ends.
Simulation stuck() {
  Simulation simulation(test::bent_tube(), test::curved_tip_wire(0.1), test::origin_access(), {});
  test::run(simulation, 70, {1.0, 0.1});
  test::run(simulation, 2, {-0.02, 0.0});
  test::run(simulation, 1, {});
  return simulation;
}

TEST(StuckWire, DoesNotCreepInAHundredThousandSteps) {
  Simulation simulation = stuck();
  test::run(simulation, 20, {});  // to the last digits of its equilibrium
  const State before = simulation.state();
  const double push_n = simulation.step({}).push_force_n;
  ASSERT_GT(std::abs(push_n), 1e-4);
  test::run(simulation, 100000, {});
  EXPECT_LT(test::shape_difference_mm(before, simulation.state()), 1e-9);
  EXPECT_NEAR(simulation.step({}).push_force_n, push_n, 1e-9);
}

}  // namespace
}  // namespace endowire::sim

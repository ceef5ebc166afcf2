// A wire that is not round: EI₁ towards the first directors of its rods, EI₂ towards the second.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/chains.hpp"

namespace endowire::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStiff_n_mm2 = 20.0;
constexpr double kRatio = 0.2;

rod::Instrument flat_wire(double length_mm) {
  rod::Instrument wire = uniform_wire(kStiff_n_mm2, length_mm);
  wire.sections[0].flexural_ratio = kRatio;
  return wire;
}

// Breaks when one of the two rigidities is used for both, or when they are exchanged: a load at 45° bends the wire five times as far to its
// soft side as to the other, F L³/3EI each.
TEST(FlatWire, ACantileverGivesWayToItsSoftSide) {
  constexpr int kRods = 100;
  constexpr double kLength_mm = 50.0;
  Chain chain(flat_wire(2.0 * kLength_mm), kRods, kLength_mm / (kRods - 0.5));
  chain.problem.clamp_hand_end();
  constexpr double kForce_n = 1e-4;
  const Eigen::Vector3d along = Eigen::Vector3d(0.0, 1.0, 1.0).normalized();
  chain.problem.material.weight_n[0] = kForce_n;
  chain.problem.loads.gravity_direction = along;
  solve::Newton newton;
  ASSERT_TRUE(newton.minimise(chain.problem, statics_spec()).converged());
  const Eigen::Vector3d tip = chain.problem.shape.joints_mm[0];
  const double per_rigidity = kForce_n * along.y() * std::pow(kLength_mm, 3) / 3.0;
  EXPECT_NEAR(tip.y() / (per_rigidity / kStiff_n_mm2), 1.0, 2e-3);
  EXPECT_NEAR(tip.z() / (per_rigidity / (kRatio * kStiff_n_mm2)), 1.0, 2e-3);
}

// A wire that is held on an arc, free to turn about itself, turns until it bends over its soft side: ½ EI₂ κ² L.
TEST(FlatWire, HeldOnAnArcItTurnsToItsSoftSide) {
  constexpr int kRods = 60;
  constexpr double kRadius_mm = 40.0;
  constexpr double kRod_mm = 1.0;
  Chain chain(flat_wire(200.0), kRods, kRod_mm);
  const double angle = 2.0 * std::asin(0.5 * kRod_mm / kRadius_mm);
  std::vector<Eigen::Vector3d> joints;
  for (int i = 0; i <= kRods; ++i) {  // bends towards y, where the first directors point: the stiff side
    const double a = (kRods - i) * angle;
    joints.emplace_back(kRadius_mm * std::sin(a), kRadius_mm * (1.0 - std::cos(a)), 0.0);
  }
  chain.lay_untwisted(joints);
  for (int i = 0; i < kRods; ++i) {
    chain.problem.hold_joint(i, true, true, true);
    chain.spin(i, 0.05);  // off the unstable equilibrium
  }
  const double stiff_mj = chain.problem.energy_mj();
  solve::Newton newton;
  ASSERT_TRUE(newton.minimise(chain.problem, statics_spec()).converged());
  for (int i = 0; i < kRods; ++i)
    EXPECT_NEAR(chain.problem.shape.spin_rad[static_cast<std::size_t>(i)], 0.5 * kPi, 1e-6) << i;
  // Joints between the ends bend; of each, the angle between its rods over the length of a rod.
  const double soft_mj = 0.5 * kRatio * kStiff_n_mm2 * angle * angle / kRod_mm * (kRods - 1);
  EXPECT_NEAR(chain.problem.energy_mj() / soft_mj, 1.0, 1e-6);
  EXPECT_NEAR(stiff_mj / soft_mj, 1.0 / kRatio, 0.02 / kRatio);
}

}  // namespace
}  // namespace endowire::test

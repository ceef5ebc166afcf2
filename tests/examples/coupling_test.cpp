#include "coupling.hpp"

#include <gtest/gtest.h>

namespace endowire::haptic {
namespace {

sim::StepReport with_force(double push_n, double torque_n_mm = 0.0) {
  sim::StepReport report;
  report.converged = true;
  report.push_force_n = push_n;
  report.torque_n_mm = torque_n_mm;
  return report;
}

TEST(Coupling, TheWirePushesBack) {
  Coupling coupling;
  const HandForce force = coupling.force({0.02, 0.001}, with_force(0.5, 0.3), false);
  EXPECT_EQ(force.force_n, -0.5);
  EXPECT_EQ(force.torque_n_mm, -0.3);
  EXPECT_FALSE(force.flagged);
}

TEST(Coupling, WhatWasMissedIsCaughtUpInShortSteps) {
  Coupling coupling;
  double followed_mm = 0.0;
  int ticks = 0;
  for (; followed_mm < 0.35 && ticks < 100; ++ticks) {
    const sim::Command command = coupling.command({0.35, 0.0});
    EXPECT_LE(command.advance_mm, Coupling::catch_up_mm);
    static_cast<void>(coupling.force(command, with_force(0.1), false));
    followed_mm += command.advance_mm;
  }
  EXPECT_EQ(ticks, 4);
  EXPECT_NEAR(coupling.command({0.35, 0.0}).advance_mm, 0.0, 1e-12);
}

TEST(Coupling, AfterASnapTheForceIsLedThereAndFlaggedUntilItArrives) {
  Coupling coupling;
  static_cast<void>(coupling.force({0.02, 0.0}, with_force(1.0), false));
  sim::StepReport snap = with_force(0.9);
  snap.snapped = true;
  HandForce force = coupling.force({0.02, 0.0}, snap, false);
  EXPECT_DOUBLE_EQ(force.force_n, -1.0 + Coupling::slew_n);
  EXPECT_TRUE(force.flagged);
  int ticks = 1;
  for (; force.flagged && ticks < 100; ++ticks) force = coupling.force({0.02, 0.0}, with_force(0.9), false);
  EXPECT_EQ(ticks, 5);
  EXPECT_EQ(force.force_n, -0.9);
  EXPECT_EQ(coupling.force({0.02, 0.0}, with_force(0.4), false).force_n, -0.4)
      << "still led when nothing snaps";
}

TEST(Coupling, AMissedTickIsLedToo) {
  Coupling coupling;
  static_cast<void>(coupling.force({0.02, 0.0}, with_force(1.0), false));
  EXPECT_TRUE(coupling.force({0.02, 0.0}, with_force(0.5), true).flagged);
}

TEST(Coupling, AStepThatFailedHoldsTheForceAndIsAskedAgain) {
  Coupling coupling;
  static_cast<void>(coupling.force({0.02, 0.0}, with_force(1.0), false));
  sim::StepReport failed = with_force(77.0);
  failed.converged = false;
  const sim::Command command = coupling.command({0.04, 0.0});
  const HandForce held = coupling.force(command, failed, false);
  EXPECT_EQ(held.force_n, -1.0);
  EXPECT_TRUE(held.flagged);
  EXPECT_EQ(coupling.command({0.04, 0.0}).advance_mm, command.advance_mm);
}

TEST(SimulatedDevice, PlaysTheSceneThenRocks) {
  const std::vector<sim::Motion> motions{{1.0, {{1, 10.0, 0.0}}}, {1.0, {{1, 0.0, 90.0}}}};
  SimulatedDevice device(motions, 20.0, 1.0);
  HandPosition hand;
  for (int tick = 0; tick < 500; ++tick) {
    const double before_mm = hand.advance_mm;
    hand = device.position(1e-3);
    EXPECT_NEAR(hand.advance_mm - before_mm, 0.02, 1e-9);
  }
  EXPECT_NEAR(hand.advance_mm, 10.0, 1e-6);
  for (int tick = 0; tick < 1570; ++tick) hand = device.position(1e-3);
  EXPECT_NEAR(hand.turn_rad, 1.57, 2e-3);
  EXPECT_NEAR(hand.advance_mm, 10.0, 1e-6);
  for (int tick = 0; tick < 1001; ++tick) hand = device.position(1e-3);
  EXPECT_NEAR(hand.advance_mm, -10.0, 0.05);
}

}  // namespace
}  // namespace endowire::haptic

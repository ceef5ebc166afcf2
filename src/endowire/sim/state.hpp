#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace endowire::sim {

/// All that a simulation remembers between two steps, as a value. Two simulations with equal states and equal
/// vessel, instrument, access and spec give equal bits for ever after.
struct State {
  double inserted_mm = 0.0;        ///< length of wire beyond the end of the sheath; <= 0: the tip is in the sheath
  double hand_turn_rad = 0.0;      ///< unwrapped turn of the wire at the sheath
  double grip_stretch_mm = 0.0;    ///< elastic displacement of the wire in the hand, axial
  double grip_twist_rad = 0.0;     ///< same, about the axis
  std::uint64_t steps = 0;
  // Rod: joints from the tip; rod i lies between joints i and i + 1.
  std::vector<Eigen::Vector3d> joints_mm;
  std::vector<Eigen::Vector3d> directors;     ///< first material director of each rod, unit, normal to it
  std::vector<double> spin_rad;               ///< unwrapped turn of each rod about its axis
  std::vector<double> twist_rad;              ///< unwrapped twist at each joint
  // Contact: friction anchors at the samples of the wire, tip first.
  std::vector<double> anchor_arc_mm;
  std::vector<Eigen::Vector2d> anchor_mm;     ///< elastic slip (axial, circumferential)
  std::vector<double> anchor_normal_n;        ///< normal force of the last step: warm start

  bool operator==(const State&) const = default;
};

}  // namespace endowire::sim

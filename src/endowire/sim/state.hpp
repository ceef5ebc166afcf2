#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "endowire/contact/contact_set.hpp"
#include "endowire/sim/predictor.hpp"

namespace endowire::sim {

/// All that a simulation remembers between two steps, as a value. Two simulations with equal states and equal
/// vessel, instrument, access and spec give equal bits for ever after.
struct State {
  double inserted_mm =
      0.0;  ///< length of wire beyond the end of the sheath; small or negative: tip in the sheath
  double hand_turn_rad = 0.0;    ///< unwrapped turn of the wire at the sheath
  double grip_stretch_mm = 0.0;  ///< hand ahead of the wire, elastic: pushes
  double grip_twist_rad = 0.0;   ///< same, about the axis
  std::uint64_t steps = 0;
  // Rod: joints from the tip; rod i lies between joints i and i + 1. None while the tip is in the sheath. The last joint but one is at the
  // end of the sheath, the last within it.
  std::vector<Eigen::Vector3d> joints_mm;
  std::vector<double> arc_mm;              ///< material arc of each joint in the lumen
  std::vector<Eigen::Vector3d> directors;  ///< first material director of each rod, unit, normal to it
  std::vector<double> spin_rad;            ///< unwrapped turn of each rod about its axis
  std::vector<double> twist_rad;           ///< unwrapped twist at each joint
  contact::FrictionMemory friction;        ///< by material arc, tip first
  Drift drift;                             ///< of the last step: the next one begins with it

  bool operator==(const State&) const = default;
  /// Bits of everything above.
  [[nodiscard]] std::uint64_t hash() const;
};

/// What a state has to fit: the wire and its place of entry.
struct StateLimits {
  int most_rods = 0;
  std::size_t most_samples = 0;
  double wire_length_mm = 0.0;
  Eigen::Vector3d access_mm = Eigen::Vector3d::Zero();
};

/// @throws base::InputError naming the part of a state that cannot be: numbers that are not finite, lists that do not belong together or are
/// too long, arcs that do not ascend, a wire that ends before its last joint or is longer than it is, rods that are not as long as their
/// material, a shape that does not end in the sheath.
void require_sound(const State& state, const StateLimits& limits);

}  // namespace endowire::sim

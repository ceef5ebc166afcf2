#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/chain.hpp"

namespace endowire::sim {

/// What the equilibrium of a step differed from its trace by. A tip that slides along a wall differs alike in every step, and a
/// wire that is stuck slips in the hand alike.
struct Drift {
  double advance_mm = 0.0;     ///< of the hand in that step; 0 when it tells nothing
  double slip_mm = 0.0;        ///< of this the wire did not follow
  std::vector<double> arc_mm;  ///< of the joints in the lumen, from the tip on
  std::vector<Eigen::Vector3d>
      joints_mm;  ///< of each, from where the trace leads with what the wire followed

  bool operator==(const Drift&) const = default;
};

/// The motion of the hand in one step.
struct HandStep {
  double advance_mm = 0.0;
  double turn_rad = 0.0;  ///< the rod in the sheath turns at once, the others do not yet
};

/// First guess of a step: every joint moves along its own rods by the advance, as if the wire slid in its own
/// trace; beyond the tip the trace goes on straight. Rods keep the stretch they have; frames are transported.
/// @param material  with the arcs before the advance
/// @param trace     scratch, whose memory is used again
void follow_trace(const rod::ChainMaterial& material, const HandStep& hand, rod::ChainShape& shape,
                  std::vector<Eigen::Vector3d>& trace);

/// How much of an advance of the hand the wire will not follow, by the last step: in proportion, and none when that went the
/// other way.
[[nodiscard]] double predicted_slip_mm(const Drift& drift, double advance_mm);

/// Moves the joints in the lumen as in the last step, in proportion to the advance and when it is of the same sense; rods keep
/// their lengths.
void follow_drift(const Drift& drift, const rod::ChainMaterial& material, double advance_mm,
                  rod::ChainShape& shape, std::vector<Eigen::Vector3d>& scratch);

}  // namespace endowire::sim

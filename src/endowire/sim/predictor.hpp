#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/chain.hpp"

namespace endowire::sim {

/// First guess of a step: every joint moves along its own rods by `advance_mm`, as if the wire slid in its own
/// trace; beyond the tip the trace goes on straight. Rods keep the stretch they have; frames are transported.
/// @param sheath_point, sheath_direction  the line on which joints n − 1 and n stay
/// @param inserted_mm                     length beyond the sheath after the advance
/// @param turn_rad                        turn of the hand: the rod in the sheath turns at once, the others do not yet
/// @param trace                           scratch, whose memory is used again
void predict(const rod::ChainMaterial& material, const Eigen::Vector3d& sheath_point,
             const Eigen::Vector3d& sheath_direction, double inserted_mm, double advance_mm, double turn_rad,
             rod::ChainShape& shape, std::vector<Eigen::Vector3d>& trace);

}  // namespace endowire::sim

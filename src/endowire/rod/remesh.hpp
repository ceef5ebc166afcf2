#pragma once

#include "endowire/rod/chain.hpp"

namespace endowire::rod {

/// Divides rod i at a material arc; the new joint is i + 1.
///
/// The two rods lie on the curve that the chain stands for, a cubic through the ends of the old one with the tangents there, and keep
/// its strain; the wire beyond towards the tip comes along. Twist keeps its rate on both sides and so its integral. What the rods
/// and joints next to the new one are made of is not known yet: ImmersedWire::fill(rod, rod + 2, …) is due.
/// @param arc_mm  between the arcs of the two ends
void divide_rod(ChainMaterial& material, ChainShape& shape, int rod, double arc_mm);

/// Makes one rod of the two at joint j, which is gone after. Strain and twist are kept as in divide_rod().
/// ImmersedWire::fill(joint − 1, joint, …) is due.
/// @param joint  1 … rods − 2: the last rod, which lies in a sheath, stays as it is
void join_rods(ChainMaterial& material, ChainShape& shape, int joint);

}  // namespace endowire::rod

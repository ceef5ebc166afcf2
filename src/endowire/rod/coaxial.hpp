#pragma once

#include "endowire/rod/chain.hpp"

namespace endowire::rod {

// Instruments within each other: a wire in a catheter, a microcatheter in a guiding catheter.
//
// Where they overlap they share one centreline, and each keeps its own energy in its own frame: the energies are summed, and a joint
// has a spin for each. (One wire of averaged rest curvature would lose the torque between two pre-curved instruments.) For round
// sections without load, rest curvatures κ̄₁, κ̄₂ turned against each other by α, their torsional rigidities C₁, C₂:
//
//   shared curvature (B₁κ̄₁ + B₂κ̄₂)/(B₁ + B₂),  energy ½ B₁B₂/(B₁ + B₂) |κ̄₁ − κ̄₂|² per length
//   α'' = c sin α,  c = B₁B₂/(B₁ + B₂) κ̄₁κ̄₂ (1/C₁ + 1/C₂);  turned by π they snap where L√c > ½π
//
// Source  [Dupont2010], [Rucker2010] for concentric tubes
// Domain  zero clearance between the instruments; no friction of one on another

/// Lets an instrument share the centreline of a chain: its joints, and its weight and axial stiffness added to those of the chain.
///
/// It ends in the middle of a rod, or at the tip: every joint then stands for a stretch with the same instruments all along, which keeps
/// the order of convergence.
/// @param wire       what lies within another instrument displaces no fluid: give it a density of 0
/// @param behind_mm  how far its tip is behind that of the chain; its own arcs begin there
void add_coaxial(const ImmersedWire& wire, double behind_mm, ChainMaterial& material);

/// A place in the middle of a rod for the tip of a coaxial instrument: that nearest to an arc.
[[nodiscard]] double nearest_rod_middle_mm(const ChainMaterial& material, double arc_mm);

/// Gives a shape the frames of one more instrument: those of the one that reaches to the tip, turned by an angle all along.
void add_coaxial_frames(double turned_rad, ChainShape& shape);

/// Torque about its axis with which the last rod of an instrument is held [N·mm], > 0 when it holds the rod turned as spins count.
/// @param instrument  0 for the one that reaches to the tip, then those of `shape.coaxial`
[[nodiscard]] double end_torque_n_mm(const ChainMaterial& material, const ChainShape& shape, int instrument);

}  // namespace endowire::rod

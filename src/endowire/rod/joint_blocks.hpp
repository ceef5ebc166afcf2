#pragma once

#include <Eigen/Core>

#include "endowire/rod/joint_energy.hpp"

namespace endowire::rod {

/// The two rods at a joint: their vectors towards the tip, tᵉ of the one on the hand's side and tᶠ of the other.
struct JointRods {
  const Frame& hand_side;
  const Frame& tip_side;
  double hand_length_mm = 0.0;
  double tip_length_mm = 0.0;
};

/// Value, gradient and Hessian of a joint's energy in the vectors tᵉ, tᶠ [mm] and the spins of its rods [rad].
struct JointBlocks {
  double energy_mj = 0.0;
  Eigen::Vector3d hand, tip;  ///< by tᵉ, by tᶠ
  double hand_spin = 0.0, tip_spin = 0.0;
  Eigen::Matrix3d hand_hand, hand_tip, tip_tip;
  Eigen::Vector3d hand_by_hand_spin, tip_by_hand_spin, hand_by_tip_spin, tip_by_tip_spin;
  double hand_spin_twice = 0.0, spins = 0.0, tip_spin_twice = 0.0;
};

/// From the turns of the rods:  turnₐ = mₐ·δt/|t| − (e·δt)(mₐ·δt)/|t|² + …,  third turn = δθ.
/// The quadratic part is why the gradient enters the Hessian.
void blocks_of(const JointDerivatives& joint, const JointRods& rods, JointBlocks& out);

/// Whether straight_joint() holds: round, straight at rest, and further from its kink than where the kink law begins.
[[nodiscard]] bool is_straight(const JointMaterial& material, const JointRods& rods);

/// joint_energy() of such a joint, from the tangents e, f alone, which is a third of the work:
///
///   E = (EI/2l̄) φ² + (GJ/2l̄)(m − m̄)²,   φ = k |e × f|,  k = φ/sin φ
///   ∂c/∂tᵉ = (f − c e)/|tᵉ|,  ∂m/∂tᵉ = (e × f)/((1 + c)|tᵉ|),  c = e·f,  and with e, f exchanged for tᶠ (m keeps its sign)
///   ∂²m/∂tᵉ∂tᶠ, symmetrised: Pₑ [(e + f)/(2(1 + c))]ₓ P_f / |tᵉ||tᶠ| − ½(∇c ∇mᵀ + ∇m ∇cᵀ)/(1 + c),  P = I less the tangent
///
/// Source  the same as joint_energy(); tests hold both against each other.
void straight_joint(const JointMaterial& material, const JointRods& rods, double twist_rad, JointBlocks& out);

/// Its energy alone, the same bits.
[[nodiscard]] double straight_joint_energy(const JointMaterial& material, const Frame& hand_side,
                                           const Frame& tip_side, double twist_rad);

}  // namespace endowire::rod

#pragma once

#include <Eigen/Core>

namespace endowire::contact {

/// Coulomb friction at one sample: elastic sticking, then sliding at the limit μN.
///
///   f = −k τ            while k|τ| ≤ μN    (sticks: the anchor keeps τ, nothing creeps)
///   f = −μN τ/|τ|       beyond             (slides: the anchor is drawn along to |τ| = μN/k)
///
/// τ is the displacement of the wire's *surface* since the anchor was set, along the wire and round it, so that sliding
/// and turning share one limit: turning a wire frees its sliding. With the limit held constant (the normal force is
/// lagged by the solver) the law is the gradient of a convex function of the new τ.
/// Source   return mapping: [Simo1992, Wriggers2006 §5.2]
struct FrictionLaw {
  double stiffness_n_per_mm = 0.0;  ///< k, > 0
  double limit_n = 0.0;             ///< μN, >= 0
};

/// ψ(τ) = ½kτ² while sticking, μN(|τ| − μN/2k) while sliding: value and two derivatives.
struct FrictionResponse {
  double energy_mj = 0.0;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< ∂ψ/∂τ, the force of the wire on the wall
  Eigen::Matrix2d stiffness_n_per_mm = Eigen::Matrix2d::Zero();
};

[[nodiscard]] double friction_energy_mj(const FrictionLaw& law, const Eigen::Vector2d& slip_mm);
[[nodiscard]] FrictionResponse friction_response(const FrictionLaw& law, const Eigen::Vector2d& slip_mm);
/// The anchor after a converged step.
[[nodiscard]] Eigen::Vector2d friction_anchor(const FrictionLaw& law, const Eigen::Vector2d& slip_mm);

}  // namespace endowire::contact

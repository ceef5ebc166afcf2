#pragma once

namespace endowire::solve {

enum class Termination {
  converged,        ///< correction and residual below their tolerances, the matrix positive definite
  iteration_limit,  ///< still moving after max_iterations
  stalled,          ///< the line search found no decrease and the residual is above its tolerance
  left_domain,      ///< a state with non-finite energy, or outside the region its constraints hold in
};

/// Outcome of one minimisation. Failing to converge is data, never an exception, never a success.
struct [[nodiscard]] SolveReport {
  Termination termination = Termination::iteration_limit;
  int iterations = 0;              ///< Newton iterations
  int factorisations = 0;          ///< band LDLᵀ, those with the wrong inertia included
  int regularised_iterations = 0;  ///< iterations that needed the proximal term
  double correction_mm = 0.0;      ///< last Newton correction, largest joint displacement
  double correction_rad = 0.0;     ///< same, largest twist
  double force_residual_n = 0.0;   ///< largest unbalanced force at a joint
  double moment_residual_n_mm = 0.0;
  double force_scale_n = 0.0;  ///< largest internal force, what the residual is compared with
  double moment_scale_n_mm = 0.0;
  double merit_mj = 0.0;  ///< incremental potential at the end

  [[nodiscard]] bool converged() const { return termination == Termination::converged; }
};

}  // namespace endowire::solve

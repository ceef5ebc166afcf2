#pragma once

#include <vector>

#include "endowire/math/band_ldlt.hpp"
#include "endowire/solve/solve_report.hpp"

namespace endowire::solve {

/// Sizes that residuals are compared with.
struct ForceScales {
  double force_n = 0.0;      ///< largest internal force
  double moment_n_mm = 0.0;  ///< largest internal moment
  double rounding_n = 0.0;   ///< forces below this are rounding: stiffness · |x| · machine epsilon
};

/// What Newton needs of a mechanical problem: a base state, its derivatives, and a curve of trial states.
///
/// Unknowns come in blocks of four, x, y, z [mm] and a turn [rad]; gradients are forces [N] and moments [N·mm].
/// Some quantities (the normal forces that limit friction) are *lagged*: constant while the merit is minimised, renewed
/// by `renew_lagged`.
class Problem {
 public:
  virtual ~Problem() = default;
  [[nodiscard]] virtual int unknowns() const = 0;
  /// Merit, gradient and Hessian at the base state; fixed unknowns have zero gradient and an identity row.
  virtual double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) = 0;
  /// Changes the quadratic model, given where it leads: adds what the derivatives at the base state do not see, such as a wall
  /// that `direction` would run into. Returns false when nothing is to be added; then the step is taken.
  virtual bool anticipate(const std::vector<double>& direction, math::BandMatrix& hessian,
                          std::vector<double>& gradient) = 0;
  /// Merit at the trial state base ⊕ α·direction; +infinity when there is none.
  virtual double try_step(const std::vector<double>& direction, double alpha) = 0;
  /// The last trial state becomes the base state.
  virtual void accept_step() = 0;
  [[nodiscard]] virtual ForceScales scales() const = 0;
  /// How far the lagged quantities are from their values at the base state, relative; 0 when there are none.
  [[nodiscard]] virtual double lag_error() const = 0;
  /// Renews the lagged quantities from the base state; the merit changes.
  virtual void renew_lagged() = 0;
  /// False when the base state has left the region in which the problem was set up.
  [[nodiscard]] virtual bool inside_region() const = 0;
};

/// Parameters of minimise(). None shapes the result: they say when to stop and how to get there.
struct NewtonSpec {
  double correction_tolerance_mm = 1e-3;
  double correction_tolerance_rad = 1.7453e-4;  ///< 0.01°
  double force_tolerance = 1e-6;                ///< of ForceScales
  double force_floor_n = 1e-9;                  ///< added to ForceScales::rounding_n
  double moment_floor_n_mm = 1e-9;
  double lag_tolerance = 2e-3;  ///< relative change of the lagged quantities at the end
  double max_step_mm = 2.0;     ///< longest motion of a joint in one iteration
  double max_turn_rad = 0.5;
  double proximal_scale = 1.0;  ///< scales the first proximal weight
  int max_iterations = 60;
};

/// Minimises the merit of `problem` from its base state by Newton's method with exact Hessians.
///
///   solve (H + λ W) d = −g,  state ← state ⊕ α d
///
/// λ      0 while H is positive definite (inertia of the band LDLᵀ) and d within the trust radius; else the first of a
///        rising series that makes it so. It is the Hessian of a proximal term about the *current* iterate: it guides the
///        path through a snap and has no force of its own at the end, nothing to iterate away, no lag.
/// W      1 N/mm for positions and 1 N·mm for turns.
/// Model  before a step is taken, contacts that it would close are added to the model and it is solved again: an active
///        set within the iteration. Without it a line search stops at the first wall.
/// Trust  max_step_mm at first; twice the step taken after a line search that went badly, larger again after good ones.
/// α      from min(1, turn limit), halved until the merit has decreased by 1e-4 of the linear prediction (Armijo); doubled while the
///        merit falls along it as a straight line.
/// Stops  converged when, with λ = 0:  |d| ≤ correction tolerances,  |g| ≤ force_tolerance · scale + rounding + floor  for
///        forces and moments, and the lagged quantities are within lag_tolerance of their present values.
class Newton {
 public:
  void reserve(int unknowns);
  SolveReport minimise(Problem& problem, const NewtonSpec& spec);
  /// Negative eigenvalues of the Hessian at the problem's base state.
  int inertia(Problem& problem);

 private:
  struct Norms {
    double position, turn;
  };
  [[nodiscard]] static Norms norms(const std::vector<double>& v);
  int factorise(double lambda);
  void find_direction(Problem& problem, double lambda, SolveReport& report);
  bool restrict_direction(Problem& problem, double trust_mm, const NewtonSpec& spec, SolveReport& report);
  /// Change of the merit per unit step, to first order.
  [[nodiscard]] double slope() const;
  double extend_step(Problem& problem, const NewtonSpec& spec, double merit, double trial, double alpha,
                     double descent, SolveReport& report);
  /// The step taken, 0 when none decreases the merit.
  double search_line(Problem& problem, const NewtonSpec& spec, double trust_mm, double merit,
                     SolveReport& report);

  math::BandMatrix hessian_;
  std::vector<double> gradient_, model_gradient_, direction_, shift_, empty_;
  double last_weight_ = 0.0;
  bool anticipating_ = true;
};

}  // namespace endowire::solve

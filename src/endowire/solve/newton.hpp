#pragma once

#include <vector>

#include "endowire/base/stage.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/solve/solve_report.hpp"

namespace endowire::solve {

/// Sizes that residuals are compared with.
struct ForceScales {
  double force_n = 0.0;      ///< largest internal force
  double moment_n_mm = 0.0;  ///< largest internal moment
  double rounding_n = 0.0;   ///< forces below this are rounding: stiffness · |x| · machine epsilon
};

/// Whether a problem still describes what it was set up for.
enum class Validity {
  holds,
  corrected,  ///< it did, to its accuracy; the merit has changed a little, around the same base state
  changed,    ///< it did not, and has been set up anew around the base state
  hopeless,   ///< it cannot be
};

/// What contacts contribute to a model at a motion.
struct ContactPart {
  double value_mj = 0.0;  ///< C(step) − C(0) − ∇C(0)ᵀstep
  bool changed =
      false;  ///< some contact opened or closed, stuck, slid or slid another way, since the last evaluation
};

/// Which Hessian of the contacts a round of the model works with.
enum class ContactHessian {
  assumed,  ///< walls count as closed where the last model left them so; else as `present`
  present,  ///< the generalised Hessian there
  majorant,  ///< sliding friction as the parabola that touches its law and nowhere lies below it: such a round descends
};

/// What Newton needs of a mechanical problem: a base state, a model around it, and a curve of trial states.
///
///   model(d) = gᵀd + ½ dᵀ H d + C(d) − C(0) − ∇C(0)ᵀd,   g the whole gradient at the base state
///
/// H is the Hessian of everything smooth; C, convex, holds what opens and closes, sticks and slides: contacts. Unknowns come
/// in one block per joint, x, y, z [mm] and a turn [rad] for each instrument; gradients are forces [N] and moments [N·mm]. Some
/// quantities (the normal forces that limit friction) are *lagged*: constant while the merit is minimised, renewed by `renew_lagged`.
class Problem {
 public:
  virtual ~Problem() = default;
  [[nodiscard]] virtual int unknowns() const = 0;
  /// Of a joint: three coordinates, and the turns.
  [[nodiscard]] virtual int unknowns_per_joint() const { return math::BandMatrix::kBlock; }
  /// Merit and its gradient at the base state, and the Hessian of all but the contacts; fixed unknowns have zero gradient
  /// and an identity row.
  virtual double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) = 0;
  /// Adds ∇C(step) − ∇C(0) and the Hessian of C there. The default has no contacts.
  virtual ContactPart add_contacts(const std::vector<double>& step, ContactHessian kind,
                                   math::BandMatrix& hessian, std::vector<double>& gradient) {
    static_cast<void>(step), static_cast<void>(kind), static_cast<void>(hessian), static_cast<void>(gradient);
    return {};
  }
  /// After a trial of the whole `step` failed: the contacts of the model take the gaps that they truly had there, so that the
  /// model minimised anew follows curved walls to second order. False when there is nothing to correct.
  virtual bool correct_contacts(const std::vector<double>& step) {
    static_cast<void>(step);
    return false;
  }
  /// Merit at the trial state base ⊕ α·direction; +infinity when there is none.
  virtual double try_step(const std::vector<double>& direction, double alpha) = 0;
  /// The last trial state becomes the base state.
  virtual void accept_step() = 0;
  [[nodiscard]] virtual ForceScales scales() const = 0;
  /// How far the lagged quantities are from their values at the base state, relative; 0 when there are none.
  [[nodiscard]] virtual double lag_error() const { return 0.0; }
  /// Renews the lagged quantities from the base state; the merit changes.
  virtual void renew_lagged() {}
  /// False when the base state has left the region in which the problem was set up.
  [[nodiscard]] virtual bool inside_region() const { return true; }
  /// Asked at states that are nearly settled, settled, or outside the region.
  virtual Validity check() { return inside_region() ? Validity::holds : Validity::hopeless; }
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
  double check_correction_mm = 0.0;  ///< corrections from which on validity is asked before polishing
  double proximal_scale = 1.0;       ///< scales the first proximal weight
  int max_iterations = 60;           ///< since the last change of the problem
};

/// Minimises the merit of `problem` from its base state by Newton's method.
///
///   d = argmin model(d) + ½ λ |d|²,  state ← state ⊕ α d
///
/// Model  minimised by Newton's method of its own, in rounds that cost a factorisation each, not an assembly, until no contact
///        changes; a round that would raise it is halved.
/// λ      0 while H and the contacts are positive definite (inertia of the band LDLᵀ) and d within the trust radius; else the
///        first of a rising series that makes it so. It is the Hessian of a proximal term about the *current* iterate: it guides
///        the path through a snap and has no force of its own at the end, nothing to iterate away, no lag.
/// Trust  max_step_mm at first; twice the step taken after a line search that went badly, larger again after good ones.
/// Bends  a whole step that fails is corrected once for the curvature of the walls that it follows (second-order correction of
///        sequential quadratic programming [Fletcher1982]).
/// α      from min(1, turn limit), halved until the merit has decreased by 1e-4 of the linear prediction (Armijo); with λ > 0
///        doubled while the merit falls.
/// Stops  converged when the last correction, with λ = 0 and α = 1, was within its tolerances, and there
///        |g| ≤ force_tolerance · scale + rounding + floor  for forces and moments, the lagged quantities are within
///        lag_tolerance of their present values, and the problem holds.
class Newton {
 public:
  void reserve(int unknowns, int unknowns_per_joint = math::BandMatrix::kBlock);
  SolveReport minimise(Problem& problem, const NewtonSpec& spec);
  /// Negative eigenvalues of the Hessian, contacts included, at the problem's base state.
  int inertia(Problem& problem);
  /// Tells `observer` where the time goes; nullptr: nobody. It must outlive its use here.
  void observe_stages(base::StageObserver* observer) { stages_ = observer; }

 private:
  struct Norms {
    double position, turn;
  };
  /// What a line search took of direction_; nothing when no step decreases the merit.
  struct Step {
    double alpha = 0.0;
    double share = 0.0;  ///< of the first α tried: what trust and turn allowed
  };
  [[nodiscard]] Norms norms(const std::vector<double>& v) const;
  void resize(const Problem& problem);
  double linearise(Problem& problem);
  ContactPart model_at_direction(Problem& problem, double lambda, ContactHessian kind);
  bool solve_round(double lambda, SolveReport& report);
  bool solve_model(Problem& problem, double lambda, bool from_rest, SolveReport& report);
  [[nodiscard]] static bool small_change(const Norms& change, const Norms& whole, double floor_mm);
  bool descend_model(Problem& problem, double lambda, double value_mj, SolveReport& report);
  bool find_direction(Problem& problem, double trust_mm, const NewtonSpec& spec, SolveReport& report);
  bool small_residual(const Problem& problem, const NewtonSpec& spec, SolveReport& report) const;
  Step search_line(Problem& problem, const NewtonSpec& spec, double trust_mm, SolveReport& report);
  double lengthen(Problem& problem, const NewtonSpec& spec, double trust_mm, const Norms& whole,
                  double merit_mj);

  math::BandMatrix hessian_, matrix_;
  std::vector<double> gradient_, model_gradient_, direction_, round_, product_, best_, kept_;
  base::StageObserver* stages_ = nullptr;
  double lambda_ = 0.0;       ///< of the present direction
  double last_weight_ = 0.0;  ///< of the last iteration that needed one
};

}  // namespace endowire::solve

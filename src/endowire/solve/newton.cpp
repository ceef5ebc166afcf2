#include "endowire/solve/newton.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::solve {

namespace {

constexpr double kFirstWeight =
    1e-4;  // N/mm: the lateral stiffness of a soft 30 mm tip; below it snaps are not slowed
constexpr double kLargestWeight = 1e8;  // stiffer than any rod along its axis: beyond it the matrix is broken
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 30;
constexpr int kMaxAnticipations = 6;
constexpr double kCalm_mm =
    0.2;  // lagged forces are renewed once steps are this short: before, they mean nothing
constexpr double kPoorStep =
    0.3;  // a line search that ends below this share says: the model was bad, trust less
constexpr double kShorten =
    2.0;  // a direction up to this many trust radii long is shortened, a longer one bent by the weight
constexpr double kSmallestTrust_mm = 0.05;
constexpr double kStraight =
    0.8;  // a quadratic falls by half of its slope per full step, a straight line by all
constexpr double kWorthExtending =
    1e-9;  // relative decrease of the merit below which a step is never lengthened

}  // namespace

void Newton::reserve(int unknowns) {
  hessian_.reserve(unknowns);
  for (auto* v : {&gradient_, &model_gradient_, &direction_, &shift_})
    v->reserve(static_cast<std::size_t>(unknowns));
}

Newton::Norms Newton::norms(const std::vector<double>& v) {
  Norms n{0.0, 0.0};
  for (std::size_t i = 0; i + 3 < v.size(); i += 4) {
    n.position = std::max(n.position, v[i] * v[i] + v[i + 1] * v[i + 1] + v[i + 2] * v[i + 2]);
    n.turn = std::max(n.turn, std::abs(v[i + 3]));
    if (!std::isfinite(v[i] + v[i + 1] + v[i + 2] + v[i + 3])) return {HUGE_VAL, HUGE_VAL};
  }
  n.position = std::sqrt(n.position);
  return n;
}

int Newton::factorise(double lambda) {
  if (lambda == 0.0) return hessian_.factorise(empty_);
  std::fill(shift_.begin(), shift_.end(), lambda);
  return hessian_.factorise(shift_);
}

int Newton::inertia(Problem& problem) {
  const int n = problem.unknowns();
  hessian_.resize(n);
  hessian_.set_zero();
  gradient_.assign(static_cast<std::size_t>(n), 0.0);
  problem.linearise(hessian_, gradient_);
  return factorise(0.0);
}

/// Solves with the last factorisation; anticipated contacts are added and the model is solved again.
void Newton::find_direction(Problem& problem, double lambda, SolveReport& report) {
  for (int round = 0;; ++round) {
    for (std::size_t i = 0; i < direction_.size(); ++i) direction_[i] = -model_gradient_[i];
    hessian_.solve(direction_);
    if (!anticipating_ || round == kMaxAnticipations ||
        !problem.anticipate(direction_, hessian_, model_gradient_))
      return;
    ++report.factorisations;
    factorise(lambda);
  }
}

/// Raises the proximal weight until the matrix is positive definite and the step no longer than the trust radius.
bool Newton::restrict_direction(Problem& problem, double trust_mm, const NewtonSpec& spec,
                                SolveReport& report) {
  double lambda = std::max(0.1 * last_weight_, spec.proximal_scale * kFirstWeight);
  for (; lambda < kLargestWeight; lambda *= 10.0) {
    ++report.factorisations;
    if (factorise(lambda) > 0) continue;
    find_direction(problem, lambda, report);
    if (!(norms(direction_).position > kShorten * trust_mm)) break;
  }
  last_weight_ = lambda;
  return lambda < kLargestWeight;
}

double Newton::slope() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < gradient_.size(); ++i) sum += gradient_[i] * direction_[i];
  return sum;
}

/// Lengthens a step along which the merit falls as a straight line: a tip that slides through a snap, whose contacts give
/// way one by one, would otherwise creep at the pace of their stiffness.
double Newton::extend_step(Problem& problem, const NewtonSpec& spec, double merit, double trial, double alpha,
                           double descent, SolveReport& report) {
  const Norms step = norms(direction_);
  report.merit_mj = trial;
  while (report.merit_mj <= merit + kStraight * alpha * descent &&
         2.0 * alpha * step.position <= spec.max_step_mm && 2.0 * alpha * step.turn <= spec.max_turn_rad &&
         -alpha * descent > kWorthExtending * (std::abs(merit) + 1.0)) {
    const double further = problem.try_step(direction_, 2.0 * alpha);
    if (!(further <= merit + kStraight * 2.0 * alpha * descent)) {
      problem.try_step(direction_, alpha);
      break;
    }
    alpha *= 2.0;
    report.merit_mj = further;
  }
  return alpha;
}

double Newton::search_line(Problem& problem, const NewtonSpec& spec, double trust_mm, double merit,
                           SolveReport& report) {
  const Norms step = norms(direction_);
  const double descent = slope();
  double alpha = 1.0;
  if (step.position > trust_mm) alpha = trust_mm / step.position;
  if (step.turn * alpha > spec.max_turn_rad) alpha = spec.max_turn_rad / step.turn;
  // A decrease below the rounding of the merit cannot be seen: the gradient alone judges such a step.
  const double rounding = 1e-13 * (std::abs(merit) + 1.0);
  for (int halving = 0; halving < kMaxHalvings; ++halving) {
    const double trial = problem.try_step(direction_, alpha);
    if (trial <= merit + kArmijo * alpha * descent + rounding) {
      alpha = extend_step(problem, spec, merit, trial, alpha, descent, report);
      problem.accept_step();
      return alpha;
    }
    alpha *= 0.5;
    if (-alpha * descent < rounding * 1e-3) break;
  }
  return 0.0;
}

SolveReport Newton::minimise(Problem& problem, const NewtonSpec& spec) {
  const int n = problem.unknowns();
  hessian_.resize(n);
  for (auto* v : {&gradient_, &model_gradient_, &direction_, &shift_}) v->resize(static_cast<std::size_t>(n));
  SolveReport report;
  double trust_mm = spec.max_step_mm;
  last_weight_ = 0.0;
  for (;; ++report.iterations) {
    const bool calm = report.iterations > 0 && report.correction_mm <= kCalm_mm;
    if (calm && problem.lag_error() > 0.5 * spec.lag_tolerance) problem.renew_lagged();
    hessian_.set_zero();
    std::fill(gradient_.begin(), gradient_.end(), 0.0);
    report.merit_mj = problem.linearise(hessian_, gradient_);

    ++report.factorisations;
    const bool definite = factorise(0.0) == 0;
    model_gradient_ = gradient_;
    if (definite) find_direction(problem, 0.0, report);
    if (!definite || norms(direction_).position > kShorten * trust_mm) {
      ++report.regularised_iterations;
      if (!restrict_direction(problem, trust_mm, spec, report)) {
        report.termination = Termination::left_domain;
        return report;
      }
    }

    const Norms correction = norms(direction_);
    const Norms residual = norms(gradient_);
    const ForceScales scale = problem.scales();
    report.correction_mm = correction.position;
    report.correction_rad = correction.turn;
    report.force_residual_n = residual.position;
    report.moment_residual_n_mm = residual.turn;
    report.force_scale_n = scale.force_n;
    report.moment_scale_n_mm = scale.moment_n_mm;
    if (!std::isfinite(correction.position) || !std::isfinite(residual.position)) {
      report.termination = Termination::left_domain;
      return report;
    }
    const bool full = definite && correction.position <= kShorten * trust_mm;
    const bool small_residual =
        residual.position <= spec.force_tolerance * scale.force_n + scale.rounding_n + spec.force_floor_n &&
        residual.turn <= spec.force_tolerance * scale.moment_n_mm + spec.moment_floor_n_mm;
    if (full && small_residual && correction.position <= spec.correction_tolerance_mm &&
        correction.turn <= spec.correction_tolerance_rad && problem.lag_error() <= spec.lag_tolerance) {
      report.termination = Termination::converged;
      return report;
    }
    if (report.iterations >= spec.max_iterations) {
      report.termination = Termination::iteration_limit;
      return report;
    }
    double alpha = slope() < 0.0 ? search_line(problem, spec, trust_mm, report.merit_mj, report) : 0.0;
    if (alpha == 0.0) {
      // The anticipated contacts misled: once more without.
      anticipating_ = false;
      hessian_.set_zero();
      std::fill(gradient_.begin(), gradient_.end(), 0.0);
      problem.linearise(hessian_, gradient_);
      model_gradient_ = gradient_;
      bool found = definite;
      if (definite) {
        factorise(0.0);
        find_direction(problem, 0.0, report);
      } else {
        found = restrict_direction(problem, trust_mm, spec, report);
      }
      anticipating_ = true;
      if (found) alpha = search_line(problem, spec, trust_mm, report.merit_mj, report);
    }
    if (alpha == 0.0) {
      report.termination = Termination::stalled;
      return report;
    }
    trust_mm = alpha < kPoorStep ? std::max(kSmallestTrust_mm, 2.0 * alpha * correction.position)
                                 : std::min(spec.max_step_mm, 4.0 * trust_mm);
    if (!problem.inside_region()) {
      report.termination = Termination::left_domain;
      return report;
    }
  }
}

}  // namespace endowire::solve

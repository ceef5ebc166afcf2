#include "endowire/solve/newton.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::solve {

namespace {

constexpr double kFirstWeight = 1e-4;   // N/mm: the lateral stiffness of a soft 30 mm tip; below it snaps are not slowed
constexpr double kLargestWeight = 1e8;  // stiffer than any rod along its axis: beyond it the matrix is broken
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 30;

}  // namespace

void Newton::reserve(int unknowns) {
  hessian_.reserve(unknowns);
  for (auto* v : {&gradient_, &direction_, &shift_}) v->reserve(static_cast<std::size_t>(unknowns));
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

bool Newton::search_line(Problem& problem, const NewtonSpec& spec, double merit, SolveReport& report) {
  const Norms step = norms(direction_);
  double slope = 0.0;
  for (std::size_t i = 0; i < gradient_.size(); ++i) slope += gradient_[i] * direction_[i];
  double alpha = 1.0;
  if (step.position > spec.max_step_mm) alpha = spec.max_step_mm / step.position;
  if (step.turn * alpha > spec.max_turn_rad) alpha = spec.max_turn_rad / step.turn;
  // A decrease below the rounding of the merit cannot be seen: the gradient alone judges such a step.
  const double rounding = 1e-13 * (std::abs(merit) + 1.0);
  for (int halving = 0; halving < kMaxHalvings; ++halving) {
    const double trial = problem.try_step(direction_, alpha);
    if (trial <= merit + kArmijo * alpha * slope + rounding) {
      problem.accept_step();
      report.merit_mj = trial;
      return true;
    }
    alpha *= 0.5;
    if (-alpha * slope < rounding * 1e-3) break;
  }
  return false;
}

SolveReport Newton::minimise(Problem& problem, const NewtonSpec& spec) {
  const int n = problem.unknowns();
  hessian_.resize(n);
  for (auto* v : {&gradient_, &direction_, &shift_}) v->resize(static_cast<std::size_t>(n));
  SolveReport report;
  double last_weight = 0.0;
  for (;; ++report.iterations) {
    if (problem.lag_error() > 0.5 * spec.lag_tolerance) problem.renew_lagged();
    hessian_.set_zero();
    std::fill(gradient_.begin(), gradient_.end(), 0.0);
    report.merit_mj = problem.linearise(hessian_, gradient_);

    double lambda = 0.0;
    ++report.factorisations;
    const bool definite = factorise(0.0) == 0;
    if (!definite) {
      ++report.regularised_iterations;
      lambda = std::max(0.1 * last_weight, spec.proximal_scale * kFirstWeight);
      while (++report.factorisations, factorise(lambda) > 0) {
        lambda *= 10.0;
        if (!(lambda < kLargestWeight)) {
          report.termination = Termination::left_domain;
          return report;
        }
      }
      last_weight = lambda;
    }
    for (std::size_t i = 0; i < gradient_.size(); ++i) direction_[i] = -gradient_[i];
    hessian_.solve(direction_);

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
    const bool small_residual = residual.position <= spec.force_tolerance * scale.force_n + scale.rounding_n + spec.force_floor_n &&
                                residual.turn <= spec.force_tolerance * scale.moment_n_mm + spec.moment_floor_n_mm;
    if (definite && small_residual && correction.position <= spec.correction_tolerance_mm &&
        correction.turn <= spec.correction_tolerance_rad && problem.lag_error() <= spec.lag_tolerance) {
      report.termination = Termination::converged;
      return report;
    }
    if (report.iterations >= spec.max_iterations) {
      report.termination = Termination::iteration_limit;
      return report;
    }
    if (!search_line(problem, spec, report.merit_mj, report)) {
      report.termination = Termination::stalled;
      return report;
    }
    if (!problem.inside_region()) {
      report.termination = Termination::left_domain;
      return report;
    }
  }
}

}  // namespace endowire::solve

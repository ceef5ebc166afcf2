#include "endowire/solve/newton.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace endowire::solve {

namespace {

constexpr double kFirstWeight =
    1e-6;  // N/mm: below the lateral stiffness of a soft tip; a larger one makes snaps creep
constexpr double kLargestWeight = 1e8;  // stiffer than any rod along its axis: beyond it the matrix is broken
constexpr double kRaise = 4.0;
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 30;
constexpr int kWholeRounds = 8;
constexpr int kDescendingRounds = 16;  // cut off, the direction still descends
constexpr int kRoundAttempts = 6;
constexpr double kModelShare = 0.02;     // rounds end once they change the direction by less than this share
constexpr double kModelFloor_mm = 1e-4;  // and below this: the next iteration does that anyway,
constexpr double kDescentFloor_mm =
    1e-7;  // unless whole rounds go astray, where it would start in the same place
constexpr double kCalm_mm =
    0.2;  // lagged forces are renewed after full steps this short: before, they mean nothing
constexpr double kUnchecked_mm =
    0.01;  // motion after which a settling state is checked once more before it is polished
constexpr double kPoorStep =
    0.3;  // a line search that ends below this share says: the model was bad, trust less
constexpr double kShorten =
    2.0;  // a direction up to this many trust radii long is shortened, a longer one bent by the weight
constexpr double kSmallestTrust_mm = 0.05;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

void Newton::reserve(int unknowns, int unknowns_per_joint) {
  for (auto* m : {&hessian_, &matrix_}) m->reserve(unknowns, unknowns_per_joint);
  for (auto* v : {&gradient_, &model_gradient_, &direction_, &round_, &product_, &best_, &kept_})
    v->reserve(static_cast<std::size_t>(unknowns));
}

void Newton::resize(const Problem& problem) {
  const int unknowns = problem.unknowns();
  hessian_.resize(unknowns, problem.unknowns_per_joint());
  for (auto* v : {&gradient_, &model_gradient_, &direction_, &round_, &product_, &best_, &kept_})
    v->resize(static_cast<std::size_t>(unknowns));
}

Newton::Norms Newton::norms(const std::vector<double>& v) const {
  const auto per_joint = static_cast<std::size_t>(hessian_.block());
  Norms n{0.0, 0.0};
  for (std::size_t i = 0; i + per_joint <= v.size(); i += per_joint) {
    n.position = std::max(n.position, v[i] * v[i] + v[i + 1] * v[i + 1] + v[i + 2] * v[i + 2]);
    double sum = v[i] + v[i + 1] + v[i + 2];
    for (std::size_t k = 3; k < per_joint; ++k) {
      n.turn = std::max(n.turn, std::abs(v[i + k]));
      sum += v[i + k];
    }
    if (!std::isfinite(sum)) return {HUGE_VAL, HUGE_VAL};
  }
  n.position = std::sqrt(n.position);
  return n;
}

double Newton::linearise(Problem& problem) {
  const base::StageScope stage(stages_, base::Stage::linearise);
  hessian_.set_zero();
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  return problem.linearise(hessian_, gradient_);
}

int Newton::inertia(Problem& problem) {
  resize(problem);
  linearise(problem);
  std::fill(direction_.begin(), direction_.end(), 0.0);
  static_cast<void>(model_at_direction(problem, 0.0, ContactHessian::present));
  return matrix_.factorise();
}

/// Sets matrix_ and model_gradient_ at direction_; returns the value of the model there.
ContactPart Newton::model_at_direction(Problem& problem, double lambda, ContactHessian kind) {
  const base::StageScope stage(stages_, base::Stage::contact_model);
  matrix_ = hessian_;
  double value = 0.0;
  if (std::all_of(direction_.begin(), direction_.end(), [](double d) { return d == 0.0; })) {
    model_gradient_ = gradient_;
  } else {
    hessian_.multiply(direction_, product_);
    for (std::size_t i = 0; i < direction_.size(); ++i) {
      const double pull = product_[i] + lambda * direction_[i];
      value += direction_[i] * (gradient_[i] + 0.5 * pull);
      model_gradient_[i] = gradient_[i] + pull;
    }
  }
  ContactPart contacts = problem.add_contacts(direction_, kind, matrix_, model_gradient_);
  contacts.value_mj += value;
  return contacts;
}

/// One round: from the model at direction_, which matrix_ and model_gradient_ hold, to round_. False when the matrix is not
/// positive definite.
bool Newton::solve_round(double lambda, SolveReport& report) {
  const base::StageScope stage(stages_, base::Stage::factorise);
  ++report.factorisations;
  if (matrix_.factorise(lambda) > 0) return false;
  for (std::size_t i = 0; i < round_.size(); ++i) round_[i] = -model_gradient_[i];
  matrix_.solve(round_);
  return true;
}

/// Minimises the model; the result is in direction_. False when it is not positive definite.
///
/// Whole rounds, which need not descend, find the contacts that close in a few; when they end without, or where the model is
/// higher than it has been, the best of them is improved in rounds that do descend.
bool Newton::solve_model(Problem& problem, double lambda, bool from_rest, SolveReport& report) {
  if (from_rest) std::fill(direction_.begin(), direction_.end(), 0.0);
  const double rounding = 1e-15 * std::abs(report.merit_mj);
  double least = HUGE_VAL;
  bool small = false;
  for (int round = 0; round < kWholeRounds; ++round) {
    const ContactPart model =
        model_at_direction(problem, lambda, round == 0 ? ContactHessian::assumed : ContactHessian::present);
    if (round > 0 && (small || !model.changed)) {
      if (model.value_mj <= least + rounding) return true;
      break;
    }
    if (model.value_mj < least) {
      least = model.value_mj;
      best_ = direction_;
    }
    if (!solve_round(lambda, report)) return false;
    for (std::size_t i = 0; i < round_.size(); ++i) direction_[i] += round_[i];
    const Norms change = norms(round_);
    if (!std::isfinite(change.position)) return true;
    small = small_change(change, norms(direction_), kModelFloor_mm);
  }
  direction_ = best_;
  return descend_model(problem, lambda, least, report);
}

/// Improves direction_, where the model has the value `value_mj`, in rounds that descend. False as solve_model().
///
/// Rounds with the majorant find, slowly but surely, what sticks; after each of them a round of Newton's is tried, which ends
/// the search where it finds everything as it was.
bool Newton::descend_model(Problem& problem, double lambda, double value_mj, SolveReport& report) {
  for (int round = 0; round < kDescendingRounds; ++round) {
    const bool surely = round % 2 == 0;
    static_cast<void>(
        model_at_direction(problem, lambda, surely ? ContactHessian::majorant : ContactHessian::present));
    if (!solve_round(lambda, report)) return false;
    const double descent = dot(model_gradient_, round_);
    double alpha = 1.0;
    double taken = 0.0;
    bool lower = false;
    bool changed = true;
    for (int attempt = 0; attempt < kRoundAttempts && !lower; ++attempt) {
      for (std::size_t i = 0; i < round_.size(); ++i) direction_[i] += (alpha - taken) * round_[i];
      taken = alpha;
      const ContactPart there = model_at_direction(problem, lambda, ContactHessian::present);
      changed = there.changed;
      lower = there.value_mj <= value_mj + kArmijo * alpha * descent;
      if (lower) {
        value_mj = there.value_mj;
      } else {
        // The secant of the slopes ends short of the minimum of a convex function.
        const double steeper = descent - dot(model_gradient_, round_);
        alpha *= steeper < 0.0 ? std::clamp(descent / steeper, 0.1, 0.7) : 0.5;
      }
    }
    if (!lower) {
      for (std::size_t i = 0; i < round_.size(); ++i) direction_[i] -= taken * round_[i];
      if (surely) return true;  // to rounding, this is the minimum
      continue;
    }
    if (!surely && (!changed || small_change(norms(round_), norms(direction_), kDescentFloor_mm)))
      return true;
  }
  return true;
}

bool Newton::small_change(const Norms& change, const Norms& whole, double floor_mm) {
  return change.position <= std::max(floor_mm, kModelShare * whole.position) &&
         change.turn <= std::max(floor_mm, kModelShare * whole.turn);
}

/// The minimum of the model within the trust radius; the proximal weight is raised until there is one.
bool Newton::find_direction(Problem& problem, double trust_mm, const NewtonSpec& spec, SolveReport& report) {
  lambda_ = 0.0;
  if (solve_model(problem, 0.0, true, report) && !(norms(direction_).position > kShorten * trust_mm))
    return true;
  ++report.regularised_iterations;
  lambda_ = std::max(last_weight_ / kRaise, spec.proximal_scale * kFirstWeight);
  for (; lambda_ < kLargestWeight; lambda_ *= kRaise) {
    if (solve_model(problem, lambda_, true, report) && !(norms(direction_).position > kShorten * trust_mm))
      break;
  }
  last_weight_ = lambda_;
  return lambda_ < kLargestWeight;
}

Newton::Step Newton::search_line(Problem& problem, const NewtonSpec& spec, double trust_mm,
                                 SolveReport& report) {
  const base::StageScope stage(stages_, base::Stage::line_search);
  const Norms whole = norms(direction_);
  const double descent = dot(gradient_, direction_);
  if (!(descent < 0.0)) return {};
  double first = 1.0;
  if (whole.position > trust_mm) first = trust_mm / whole.position;
  if (whole.turn * first > spec.max_turn_rad) first = spec.max_turn_rad / whole.turn;
  // A decrease below the rounding of the merit cannot be seen: the gradient alone judges such a step.
  const double rounding = 1e-13 * (std::abs(report.merit_mj) + 1.0);
  double alpha = first;
  for (int halving = 0; halving < kMaxHalvings; ++halving) {
    const double trial = problem.try_step(direction_, alpha);
    if (trial <= report.merit_mj + kArmijo * alpha * descent + rounding) {
      if (lambda_ > 0.0 && alpha == 1.0) alpha = lengthen(problem, spec, trust_mm, whole, trial);
      problem.accept_step();
      return {alpha, alpha / first};
    }
    if (halving == 0 && alpha == 1.0 && std::isfinite(trial) && problem.correct_contacts(direction_)) {
      kept_ = direction_;
      if (solve_model(problem, lambda_, false, report) &&
          norms(direction_).position <= kShorten * whole.position &&
          problem.try_step(direction_, 1.0) <= report.merit_mj + kArmijo * descent + rounding) {
        problem.accept_step();
        return {1.0, 1.0};
      }
      direction_ = kept_;
    }
    alpha *= 0.5;
    if (-alpha * descent < rounding * 1e-3) break;
  }
  return {};
}

/// The proximal weight is a guess that may be far too large, and the way from a saddle is then crept: a step that it bent is
/// doubled while the merit falls and the trust radius lasts. The last trial is that of the result.
double Newton::lengthen(Problem& problem, const NewtonSpec& spec, double trust_mm, const Norms& whole,
                        double merit_mj) {
  double alpha = 1.0;
  while (2.0 * alpha * whole.position <= trust_mm && 2.0 * alpha * whole.turn <= spec.max_turn_rad) {
    const double further = problem.try_step(direction_, 2.0 * alpha);
    if (!(further < merit_mj)) {
      static_cast<void>(problem.try_step(direction_, alpha));
      break;
    }
    merit_mj = further;
    alpha *= 2.0;
  }
  return alpha;
}

bool Newton::small_residual(const Problem& problem, const NewtonSpec& spec, SolveReport& report) const {
  const Norms residual = norms(gradient_);
  const ForceScales scale = problem.scales();
  report.force_residual_n = residual.position;
  report.moment_residual_n_mm = residual.turn;
  report.force_scale_n = scale.force_n;
  report.moment_scale_n_mm = scale.moment_n_mm;
  return residual.position <= spec.force_tolerance * scale.force_n + scale.rounding_n + spec.force_floor_n &&
         residual.turn <= spec.force_tolerance * scale.moment_n_mm + spec.moment_floor_n_mm;
}

SolveReport Newton::minimise(Problem& problem, const NewtonSpec& spec) {
  resize(problem);
  SolveReport report;
  double trust_mm = spec.max_step_mm;
  last_weight_ = 0.0;
  int since_change = 0;
  double unchecked_mm = HUGE_VAL;  // moved since the problem was last asked
  bool settled = false;            // the last correction was whole and within its tolerances
  bool calm = false;
  const auto end = [&](Termination termination) {
    report.termination = termination;
    return report;
  };
  const auto start_anew = [&] {
    calm = false;
    unchecked_mm = HUGE_VAL;
    since_change = -1;
    trust_mm = spec.max_step_mm;
  };
  const auto within = [&](const Norms& n) {
    return n.position <= spec.correction_tolerance_mm && n.turn <= spec.correction_tolerance_rad;
  };
  for (;; ++report.iterations, ++since_change) {
    if (calm && problem.lag_error() > 0.5 * spec.lag_tolerance) problem.renew_lagged();
    report.merit_mj = linearise(problem);
    const bool balanced = small_residual(problem, spec, report);
    if (!std::isfinite(report.force_residual_n)) return end(Termination::left_domain);
    bool converged = settled && balanced && problem.lag_error() <= spec.lag_tolerance;
    if (!converged) {
      if (!find_direction(problem, trust_mm, spec, report)) return end(Termination::left_domain);
      const Norms correction = norms(direction_);
      if (!std::isfinite(correction.position)) return end(Termination::left_domain);
      report.correction_mm = correction.position;
      report.correction_rad = correction.turn;
      converged =
          lambda_ == 0.0 && balanced && within(correction) && problem.lag_error() <= spec.lag_tolerance;
    }
    if (converged) {
      const Validity validity = problem.check();
      if (validity == Validity::holds) return end(Termination::converged);
      if (validity == Validity::hopeless) return end(Termination::left_domain);
      settled = false;
      if (validity == Validity::changed) start_anew();
      if (validity == Validity::corrected) since_change = 0;  // another problem, but nearly solved
      continue;
    }
    if (since_change >= spec.max_iterations) return end(Termination::iteration_limit);
    Step step = search_line(problem, spec, trust_mm, report);
    // The model misled: shorter steps, bent towards the gradient.
    for (int attempt = 0; step.alpha == 0.0 && attempt < 4; ++attempt) {
      lambda_ = std::max(10.0 * lambda_, 100.0 * kFirstWeight);
      ++report.regularised_iterations;
      linearise(problem);  // a correction of the contacts may have been left in the model
      if (solve_model(problem, lambda_, true, report)) step = search_line(problem, spec, trust_mm, report);
    }
    if (step.alpha == 0.0) return end(Termination::stalled);
    const Norms correction = norms(direction_);
    report.correction_mm = correction.position;
    report.correction_rad = correction.turn;
    const double moved_mm = step.alpha * correction.position;
    trust_mm = step.share < kPoorStep ? std::max(kSmallestTrust_mm, 2.0 * moved_mm)
                                      : std::min(spec.max_step_mm, 4.0 * trust_mm);
    const bool whole = lambda_ == 0.0 && step.alpha == 1.0;
    settled = whole && within(correction);
    calm = moved_mm <= kCalm_mm;
    const bool outside = !problem.inside_region();
    unchecked_mm += moved_mm;
    if (outside || since_change == 0 ||
        (whole && correction.position <= spec.check_correction_mm && unchecked_mm > kUnchecked_mm)) {
      const Validity validity = problem.check();
      if (validity == Validity::hopeless) return end(Termination::left_domain);
      unchecked_mm = 0.0;
      if (validity != Validity::holds) settled = false;
      if (validity == Validity::changed) start_anew();
      if (validity == Validity::corrected) since_change = 0;
    }
  }
}

}  // namespace endowire::solve

#include "endowire/sim/chain_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "endowire/base/contract.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Turn of a tangent about an axis, from a fixed normal of that axis, in the branch nearest to `near_rad`.
double turn_about(const Eigen::Vector3d& axis, const Eigen::Vector3d& tangent, double near_rad) {
  const Eigen::Vector3d a = math::any_normal(axis);
  const double angle = std::atan2(axis.cross(a).dot(tangent), a.dot(tangent));
  return angle + 2.0 * M_PI * std::round((near_rad - angle) / (2.0 * M_PI));
}

}  // namespace

void ChainProblem::reserve(int rods, std::size_t samples) {
  material.reserve(rods);
  shape.reserve(rods);
  trial_.reserve(rods);
  scratch_.reserve(rods);
  contact.reserve(rods, samples);
  const auto unknowns = at(unknowns_per_joint() * (rods + 1));
  held.reserve(unknowns);
  cartesian_.reserve(unknowns);
  contact_gradient_.reserve(unknowns);
  model_.reserve(samples);
  geometric_force_.reserve(at(rods));
}

void ChainProblem::release_all() {
  held.assign(at(unknowns()), 0);
  const int n = shape.rods();
  hold_joint(n, true, true, true);
  for (int k = 0; k + 3 < unknowns_per_joint(); ++k) hold_spin(n, k);
  for (std::size_t k = 0; k < material.coaxial.size(); ++k)
    for (int i = 0; i + 1 < material.coaxial[k].first_joint; ++i) hold_spin(i, static_cast<int>(k) + 1);
}

void ChainProblem::hold_joint(int joint, bool x, bool y, bool z) {
  char* fixed = held.data() + unknowns_per_joint() * joint;
  fixed[0] |= static_cast<char>(x);
  fixed[1] |= static_cast<char>(y);
  fixed[2] |= static_cast<char>(z);
}

void ChainProblem::hold_spin(int rod, int instrument) {
  held[at(unknowns_per_joint() * rod + 3 + instrument)] = 1;
}

void ChainProblem::clamp_hand_end() {
  const int n = shape.rods();
  hold_joint(n - 1, true, true, true);
  for (int k = 0; k + 3 < unknowns_per_joint(); ++k) hold_spin(n - 1, k);
}

void ChainProblem::fit_entering(double inserted_mm) {
  fit_entering_rod(*line, inserted_mm, material);
  contact.fit_rod(shape.rods() - 2, material);
}

double ChainProblem::potential(const rod::ChainShape& at_shape) {
  double energy = rod::chain_energy(material, at_shape);
  const int n = at_shape.rods();
  for (int j = 0; j <= n; ++j)
    energy -= material.weight_n[at(j)] * loads.gravity_direction.dot(at_shape.joints_mm[at(j)]);
  energy -= loads.tip_force_n.dot(at_shape.joints_mm[0]);
  if (loads.tip_moment_n_mm != 0.0) {
    energy -=
        loads.tip_moment_n_mm * turn_about(loads.tip_moment_axis, at_shape.frames[0].col(2), moment_turn_);
  }
  energy += contact.energy_mj(at_shape);
  return energy;
}

double ChainProblem::energy_mj() {
  if (feed.active) fit_entering(feed.inserted_mm);
  return potential(shape) + (feed.active ? grip_energy_mj(feed) : 0.0);
}

double ChainProblem::add_loads(math::BandMatrix& hessian, std::vector<double>& gradient) const {
  const int n = shape.rods();
  const int next = unknowns_per_joint();  // the first of joint 1
  double energy = 0.0;
  for (int j = 0; j <= n; ++j) {
    const Eigen::Vector3d weight = material.weight_n[at(j)] * loads.gravity_direction;
    energy -= weight.dot(shape.joints_mm[at(j)]);
    for (int c = 0; c < 3; ++c) gradient[at(next * j + c)] -= weight[c];
  }
  energy -= loads.tip_force_n.dot(shape.joints_mm[0]);
  for (int c = 0; c < 3; ++c) gradient[at(c)] -= loads.tip_force_n[c];
  if (loads.tip_moment_n_mm == 0.0) return energy;
  // ψ = atan2(q·t, p·t): ∇ψ = s/|t|, s = axis × e;  ∇∇ψ = −(e sᵀ + s eᵀ)/|t|², for t normal to the axis.
  const Eigen::Vector3d t = shape.joints_mm[0] - shape.joints_mm[1];
  const double length = t.norm();
  const Eigen::Vector3d e = t / length;
  const Eigen::Vector3d s = loads.tip_moment_axis.cross(e);
  const double m = loads.tip_moment_n_mm;
  const Eigen::Matrix3d h = m / (length * length) * (e * s.transpose() + s * e.transpose());
  for (int r = 0; r < 3; ++r) {
    gradient[at(r)] -= m * s[r] / length;
    gradient[at(next + r)] += m * s[r] / length;
    for (int c = 0; c <= r; ++c) {
      hessian.lower(r, c) += h(r, c);
      hessian.lower(next + r, next + c) += h(r, c);
    }
    for (int c = 0; c < 3; ++c) hessian.lower(next + r, c) -= h(r, c);
  }
  return energy - m * turn_about(loads.tip_moment_axis, e, moment_turn_);
}

double ChainProblem::linearise(math::BandMatrix& hessian, std::vector<double>& gradient) {
  ENDOWIRE_EXPECTS(shape.coaxial.empty() || (!feed.active && contact.empty()),
                   "a feed and walls know one instrument");
  if (feed.active) fit_entering(feed.inserted_mm);  // a trial that was not taken may have left its own length
  double energy = rod::add_joint_derivatives(material, shape, hessian, gradient);
  if (loads.tip_moment_n_mm != 0.0) {
    moment_turn_ = turn_about(loads.tip_moment_axis, shape.frames[0].col(2), moment_turn_);
  }
  energy += add_loads(hessian, gradient);
  contact_gradient_.assign(gradient.size(), 0.0);
  contact_energy_ = contact.linearise(shape, guided(), hessian, contact_gradient_, model_);
  energy += contact_energy_;
  for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += contact_gradient_[i];
  rod::geometric_force_n(material, shape, gradient, held, scratch_, geometric_force_);
  energy += rod::add_stretch_derivatives(material, shape, geometric_force_, hessian, gradient);
  hold(hessian, gradient);
  if (feed.active) {
    const int u = feed_unknown();
    hessian.fix(u);
    hessian.lower(u, u) = 0.0;
    gradient[at(u)] = contact_gradient_[at(u)];
    energy += add_feed_derivatives(feed, *line, material, shape, hessian, gradient);
  }
  measure_scales();
  return energy;
}

contact::GuidedJoint ChainProblem::guided() const {
  // The wire that enters moves along the entering rod, and by its strain more than what is fed.
  if (!feed.active) return {};
  const int sheath = shape.rods() - 1;
  return {sheath, (shape.joints_mm[at(sheath - 1)] - shape.joints_mm[at(sheath)]) /
                      material.length_mm[at(sheath - 1)]};
}

void ChainProblem::hold(math::BandMatrix& hessian, std::vector<double>& gradient) const {
  for (int i = 0; i < unknowns(); ++i) {
    if (!held[at(i)] || i == feed_unknown()) continue;
    hessian.fix(i);
    gradient[at(i)] = 0.0;
  }
}

solve::ContactPart ChainProblem::add_contacts(const std::vector<double>& step, solve::ContactHessian kind,
                                              math::BandMatrix& hessian, std::vector<double>& gradient) {
  if (model_.empty()) return {};
  double known = contact_energy_;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    gradient[i] -= contact_gradient_[i];
    known += contact_gradient_[i] * step[i];
  }
  const contact::ModelPart part = model_.add_derivatives(step, kind, guided(), hessian, gradient);
  hold(hessian, gradient);
  return {part.energy_mj - known, part.changed};
}

bool ChainProblem::correct_contacts(const std::vector<double>& step) {
  if (model_.empty()) return false;
  contact.correct(trial_, step, guided(), model_);
  return true;
}

solve::Validity ChainProblem::check() {
  return checker ? checker() : solve::Problem::check();
}

double ChainProblem::try_step(const std::vector<double>& direction, double alpha) {
  cartesian_.assign(direction.begin(), direction.end());
  if (feed.active) cartesian_[at(feed_unknown())] = 0.0;
  if (!rod::retract(shape, cartesian_, alpha, {held[0] != 0, held[1] != 0, held[2] != 0}, trial_)) {
    return std::numeric_limits<double>::infinity();
  }
  if (!feed.active) return potential(trial_);
  const double fed = alpha * direction[at(feed_unknown())];
  trial_feed_ = feed;
  trial_feed_.inserted_mm += fed;
  trial_feed_.stretch_mm -= fed;
  trial_feed_.twist_rad -= alpha * direction[at(feed_unknown() + 3)];
  if (!(trial_feed_.inserted_mm > material.arc_mm[at(shape.rods() - 2)]))
    return std::numeric_limits<double>::infinity();
  fit_entering(trial_feed_.inserted_mm);
  return potential(trial_) + grip_energy_mj(trial_feed_);
}

void ChainProblem::accept_step() {
  contact.recall_closed(model_);
  std::swap(shape, trial_);
  feed = trial_feed_;
  if (on_step) on_step();
}

bool ChainProblem::inside_region() const {
  for (const contact::Sample& s : contact.samples()) {
    if ((s.position_mm(shape) - s.detected_at_mm).norm() > region_mm + std::max(0.0, s.clearance_mm))
      return false;
  }
  return true;
}

void ChainProblem::measure_scales() {
  scales_ = {loads.tip_force_n.norm(), std::abs(loads.tip_moment_n_mm), 0.0};
  const int n = shape.rods();
  for (int i = 0; i < n; ++i) {
    scales_.force_n = std::max(scales_.force_n, std::abs(rod::axial_force_n(material, shape, i)));
    // A joint's position is rounded to half an ulp in each coordinate, and a joint feels two rods.
    scales_.rounding_n = std::max(scales_.rounding_n, 4.0 * std::numeric_limits<double>::epsilon() *
                                                          material.stretch_n_per_mm[at(i)] *
                                                          shape.joints_mm[at(i)].cwiseAbs().maxCoeff());
  }
  const auto measure = [&](const std::vector<rod::JointMaterial>& joints, int first,
                           const rod::RodFrames& f) {
    for (int j = first; j < n; ++j) {
      const rod::JointMaterial& joint = joints[at(j)];
      const double chord = (f.frames[at(j)].col(2) - f.frames[at(j - 1)].col(2)).norm();  // of the angle
      const double bend = joint.bend_n_mm2.maxCoeff() * (chord + joint.rest_bend_rad.norm()) / joint.span_mm;
      const double twist =
          joint.twist_n_mm2 * std::abs(f.twist_rad[at(j)] - joint.rest_twist_rad) / joint.span_mm;
      scales_.moment_n_mm = std::max({scales_.moment_n_mm, bend, twist});
    }
  };
  measure(material.joints, 1, shape);
  for (std::size_t k = 0; k < material.coaxial.size(); ++k)
    measure(material.coaxial[k].joints, material.coaxial[k].first_joint, shape.coaxial[k]);
  for (const contact::Sample& s : contact.samples()) scales_.force_n = std::max(scales_.force_n, s.normal_n);
}

double ChainProblem::push_force_n() const {
  return contact::friction_response(feed.push, {feed.stretch_mm, 0.0}).force_n[0];
}

double ChainProblem::hand_torque_n_mm() const {
  return contact::friction_response(feed.torque, {feed.twist_rad, 0.0}).force_n[0];
}

}  // namespace endowire::sim

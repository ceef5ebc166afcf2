#include "endowire/contact/contact_set.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Below this total normal force nothing rubs: the weight of a centimetre of wire.
constexpr double kRubbingFloor_n = 1e-4;
/// Renewals of the lagged normal forces after a detection that are taken whole, while the wire still moves; and the relaxation
/// of those after them.
constexpr int kFullRenewals = 3;
constexpr double kLeastRelaxation = 0.2;
constexpr double kMostRelaxation = 3.0;
Eigen::Vector2d slip_of(const Sample& s, const rod::ChainShape& shape) {
  const Eigen::Vector3d moved = s.position_mm(shape) - s.start_mm;
  const double turned = shape.spin_rad[at(s.rod)] - s.start_spin_rad;
  return s.anchor_mm + Eigen::Vector2d(s.axial.dot(moved), s.around.dot(moved) + s.radius_mm * turned);
}

/// Adds a Hessian by the position of a sample to the blocks of its two joints.
void scatter(const Sample& s, const Eigen::Matrix3d& h, math::BandMatrix& hessian) {
  const int first = 4 * s.rod;
  const double a = 1.0 - s.fraction;
  const double b = s.fraction;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c <= r; ++c) {
      hessian.lower(first + r, first + c) += a * a * h(r, c);
      hessian.lower(first + 4 + r, first + 4 + c) += b * b * h(r, c);
    }
    for (int c = 0; c < 3; ++c) hessian.lower(first + 4 + r, first + c) += a * b * h(r, c);
  }
}

/// The straight line that stands for a wall's law around a depth.
struct WallLine {
  double stiffness_n_per_mm, zero_mm;
  double trusted_n;  ///< the force that is worth a curvature in the Hessian
};

/// The tangent there; but where a prediction, just detected, lies far deeper than the force asks for that the wire had before, the
/// line that cuts the law at both depths: the true force now, and the remembered one at the depth of that. A tangent to a law
/// that stiffens so much would take many iterations to climb out.
WallLine line_for(const Sample& s, double depth_mm, const WallResponse& response) {
  constexpr double kFar = 0.2;  // of the cap
  const double expected_mm = wall_depth_mm(s.stiffness_n_per_mm, s.cap_mm, s.lagged_normal_n);
  if (!s.fresh || depth_mm < expected_mm + kFar * s.cap_mm) {
    return {response.stiffness_n_per_mm, depth_mm - response.force_n / response.stiffness_n_per_mm,
            response.force_n};
  }
  const double expected_n = wall_response(s.stiffness_n_per_mm, s.cap_mm, expected_mm).force_n;
  const double slope = (response.force_n - expected_n) / (depth_mm - expected_mm);
  return {slope, depth_mm - response.force_n / slope, expected_n};
}

FrictionLaw friction_of(const Sample& s) {
  return {s.stick_stiffness_n_per_mm, s.friction * s.lagged_normal_n};
}

}  // namespace

void ContactSet::reserve(int rods, std::size_t samples) {
  samples_.reserve(samples);
  memory_.reserve(samples);
  start_shape_.reserve(rods);
  start_arc_mm_.reserve(at(rods + 1));
}

void ContactSet::fit_rod(int rod, const rod::ChainMaterial& material) {
  for (auto s = samples_.rbegin(); s != samples_.rend() && s->rod == rod; ++s)
    s->fraction = (s->arc_mm - material.arc_mm[at(rod)]) / material.length_mm[at(rod)];
}

/// Where the wire that a sample stands on was in the last converged state: rods may have had other lengths then. What was in the
/// sheath comes from its end: before that no wall rubbed it.
Eigen::Vector3d ContactSet::start_position_mm(const Sample& s) const {
  const double from = start_arc_mm_[at(s.rod)];
  const double fraction = std::min(1.0, (s.arc_mm - from) / (start_arc_mm_[at(s.rod + 1)] - from));
  return (1.0 - fraction) * start_shape_.joints_mm[at(s.rod)] +
         fraction * start_shape_.joints_mm[at(s.rod + 1)];
}

double ContactSet::energy_mj(const rod::ChainShape& shape) {
  double energy = 0.0;
  for (Sample& s : samples_) {
    s.normal_n = 0.0;
    s.deflection_mm = 0.0;
    if (s.walls == 0) continue;
    const Eigen::Vector3d u = s.position_mm(shape) - s.detected_at_mm;
    for (int k = 0; k < s.walls; ++k) {
      const double depth = s.radius_mm - local_height_mm(s.wall[at(k)], u);
      const WallResponse w = wall_response(s.stiffness_n_per_mm, s.cap_mm, depth);
      energy += w.energy_mj;
      s.normal_n += w.force_n;
      s.deflection_mm = std::max(s.deflection_mm, depth);
    }
    if (s.friction > 0.0) energy += friction_energy_mj(friction_of(s), slip_of(s, shape));
  }
  return energy;
}

double ContactSet::linearise(const rod::ChainShape& shape, const GuidedJoint& guided,
                             math::BandMatrix& hessian, std::vector<double>& gradient, ContactModel& model) {
  model.clear();
  double energy = 0.0;
  for (Sample& s : samples_) {
    s.normal_n = 0.0;
    s.deflection_mm = 0.0;
    if (s.walls == 0) continue;
    LinearContact& c = model.add();
    c.rod = s.rod;
    c.fraction = s.fraction;
    c.radius_mm = s.radius_mm;
    c.walls = s.walls;
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    const Eigen::Vector3d u = s.position_mm(shape) - s.detected_at_mm;
    for (int k = 0; k < s.walls; ++k) {
      const LocalHeight height = local_height_derivatives(s.wall[at(k)], u);
      LinearContact::Wall& wall = c.wall[at(k)];
      wall.normal = height.gradient;
      wall.depth_mm = s.radius_mm - height.value_mm;
      wall.stiffness_n_per_mm = s.stiffness_n_per_mm;
      wall.closed = s.closed[at(k)] || wall.depth_mm > 0.0;
      if (!(wall.depth_mm > 0.0)) continue;
      const WallResponse w = wall_response(s.stiffness_n_per_mm, s.cap_mm, wall.depth_mm);
      energy += w.energy_mj;
      s.normal_n += w.force_n;
      s.deflection_mm = std::max(s.deflection_mm, wall.depth_mm);
      g.head<3>() -= w.force_n * height.gradient;
      const WallLine line = line_for(s, wall.depth_mm, w);
      wall.stiffness_n_per_mm = line.stiffness_n_per_mm;
      wall.zero_mm = line.zero_mm;
      scatter(s, -line.trusted_n * height.hessian, hessian);
    }
    s.fresh = false;
    if (s.friction > 0.0 && s.lagged_normal_n > 0.0) {
      c.axial = s.axial;
      c.around = s.around;
      c.slip_mm = slip_of(s, shape);
      c.friction = friction_of(s);
      const FrictionResponse f = friction_response(c.friction, c.slip_mm);
      energy += f.energy_mj;
      g.head<3>() += f.force_n[0] * c.axial + f.force_n[1] * c.around;
      g[3] += c.radius_mm * f.force_n[1];
    }
    scatter_gradient(s.rod, s.fraction, g, guided, gradient);
  }
  return energy;
}

void ContactSet::recall_closed(const ContactModel& model) {
  auto from = model.contacts().begin();
  for (Sample& s : samples_) {
    if (s.walls == 0) continue;
    for (int k = 0; k < s.walls; ++k) s.closed[at(k)] = from->wall[at(k)].closed;
    ++from;
  }
}

void ContactSet::correct(const rod::ChainShape& there, const std::vector<double>& motion,
                         const GuidedJoint& guided, ContactModel& model) const {
  std::size_t i = 0;
  for (const Sample& s : samples_) {
    if (s.walls == 0) continue;
    LinearContact& c = model.contact(i++);
    const Eigen::Vector3d moved = motion_of(c, motion, guided);
    const Eigen::Vector3d u = s.position_mm(there) - s.detected_at_mm;
    for (int k = 0; k < s.walls; ++k) {
      LinearContact::Wall& wall = c.wall[at(k)];
      wall.depth_mm = s.radius_mm - local_height_mm(s.wall[at(k)], u) + wall.normal.dot(moved);
    }
  }
}

double ContactSet::lag_error() const {
  double change = 0.0;
  double total = kRubbingFloor_n;
  for (const Sample& s : samples_) {
    if (s.friction == 0.0) continue;
    change += std::abs(s.normal_n - s.lagged_normal_n);
    total += s.normal_n;
  }
  return change / total;
}

void ContactSet::renew_lagged() {
  // Friction that loads or unloads its own normal force makes this fixed-point iteration crawl or swing: Aitken's relaxation.
  double along = 0.0;
  double change = 0.0;
  for (const Sample& s : samples_) {
    if (s.friction == 0.0) continue;
    const double r = s.normal_n - s.lagged_normal_n;
    along += s.last_lag_n * (r - s.last_lag_n);
    change += (r - s.last_lag_n) * (r - s.last_lag_n);
  }
  if (++renewals_ > kFullRenewals && change > 0.0) {
    relaxation_ = std::clamp(-relaxation_ * along / change, kLeastRelaxation, kMostRelaxation);
  } else {
    relaxation_ = 1.0;
  }
  for (Sample& s : samples_) {
    s.last_lag_n = s.normal_n - s.lagged_normal_n;
    s.lagged_normal_n = std::max(0.0, s.lagged_normal_n + relaxation_ * s.last_lag_n);
  }
}

void ContactSet::remember(const rod::ChainShape& shape, FrictionMemory& memory) const {
  memory.clear();
  for (const Sample& s : samples_) {
    memory.arc_mm.push_back(s.arc_mm);
    const bool rubs = s.walls > 0 && s.friction > 0.0 && s.lagged_normal_n > 0.0;
    const FrictionLaw law = friction_of(s);
    memory.traction_n_per_mm.push_back(rubs ? Eigen::Vector2d(law.stiffness_n_per_mm / s.share_mm() *
                                                              friction_anchor(law, slip_of(s, shape)))
                                            : Eigen::Vector2d::Zero());
    memory.normal_n_per_mm.push_back(s.walls > 0 ? s.normal_n / s.share_mm() : 0.0);
  }
}

Eigen::Vector3d ContactSet::normal_force_n(const rod::ChainShape& shape, std::size_t sample) const {
  const Sample& s = samples_[sample];
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  const Eigen::Vector3d u = s.position_mm(shape) - s.detected_at_mm;
  for (int k = 0; k < s.walls; ++k) {
    const LocalHeight height = local_height_derivatives(s.wall[at(k)], u);
    force += wall_response(s.stiffness_n_per_mm, s.cap_mm, s.radius_mm - height.value_mm).force_n *
             height.gradient;
  }
  return force;
}

Eigen::Vector3d ContactSet::friction_force_n(const rod::ChainShape& shape, std::size_t sample) const {
  const Sample& s = samples_[sample];
  if (s.walls == 0 || s.friction == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector2d f = friction_response(friction_of(s), slip_of(s, shape)).force_n;
  return -(f[0] * s.axial + f[1] * s.around);
}

}  // namespace endowire::contact

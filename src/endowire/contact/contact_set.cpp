#include "endowire/contact/contact_set.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/contact/detect.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Below this total normal force nothing rubs: the weight of a centimetre of wire.
constexpr double kRubbingFloor_n = 1e-4;
/// A sample on the wall that moved less cannot have passed one: its axis keeps a radius away.
constexpr double kShortMove_mm = 0.1;
constexpr double kAtDetection_mm = 0.1;
/// Ridges are looked for at this spacing between samples, where normals differ by more than 3°, and matter from this depth on.
constexpr double kRidgeStep_mm = 0.5;
constexpr double kSameNormal = 0.9986;
/// The normals of a detection tell of the walls here as long as a sample has moved less.
constexpr double kStillThere_mm = 0.1;
constexpr double kRidgeDip_mm = 0.03;
/// Renewals of the lagged normal forces after a detection that are taken whole.
constexpr int kFullRenewals = 8;
constexpr int kMaxSamplesPerRod = 16;
constexpr double kMinShare_mm = 0.25;

/// Intervals of a rod between samples: a power of two, so that samples persist when the lumen narrows.
int intervals(double rod_length_mm, double lumen_radius_mm, const ContactSpec& spec) {
  const double spacing = std::clamp(0.5 * lumen_radius_mm, kMinShare_mm, spec.max_share_mm);
  int count = 1;
  while (count < kMaxSamplesPerRod && rod_length_mm > spacing * count * (1.0 + 1e-9)) count *= 2;
  return count;
}

/// Linear interpolation in the memory, for increasing arcs; `k` is where the last look-up ended.
void recall(const FrictionMemory& memory, std::size_t& k, Sample& sample) {
  const std::size_t n = memory.arc_mm.size();
  sample.anchor_mm.setZero();
  sample.lagged_normal_n = 0.0;
  if (n == 0 || sample.arc_mm > memory.arc_mm[n - 1]) return;
  while (k + 1 < n && memory.arc_mm[k + 1] <= sample.arc_mm) ++k;
  if (sample.arc_mm <= memory.arc_mm[k] || k + 1 == n) {
    sample.anchor_mm = memory.anchor_mm[k];
    sample.lagged_normal_n = memory.normal_n_per_mm[k] * sample.share_mm;
    return;
  }
  const double w = (sample.arc_mm - memory.arc_mm[k]) / (memory.arc_mm[k + 1] - memory.arc_mm[k]);
  sample.anchor_mm = (1.0 - w) * memory.anchor_mm[k] + w * memory.anchor_mm[k + 1];
  sample.lagged_normal_n =
      ((1.0 - w) * memory.normal_n_per_mm[k] + w * memory.normal_n_per_mm[k + 1]) * sample.share_mm;
}

Eigen::Vector3d tangent_at(const rod::ChainShape& shape, const Sample& sample) {
  const Eigen::Vector3d own = shape.frames[at(sample.rod)].col(2);
  if (sample.fraction > 0.0 || sample.rod == 0) return own;
  return (own + shape.frames[at(sample.rod - 1)].col(2)).normalized();
}

Eigen::Vector2d slip_of(const Sample& s, const rod::ChainShape& shape) {
  const Eigen::Vector3d moved = s.position_mm(shape) - s.start_mm;
  const double turned = shape.spin_rad[at(s.rod)] - s.start_spin_rad;
  return s.anchor_mm + Eigen::Vector2d(s.axial.dot(moved), s.around.dot(moved) + s.radius_mm * turned);
}

/// Lays derivatives by the position of a sample and the spin of its rod onto the unknowns of its two joints.
/// @param hand  1, or 0 to leave the joint on the hand's side out
void scatter(const Sample& s, const Eigen::Vector4d& g, const Eigen::Matrix4d& h, double hand,
             math::BandMatrix& hessian, std::vector<double>& gradient) {
  const int first = 4 * s.rod;
  const double a = 1.0 - s.fraction;
  const double b = s.fraction * hand;
  for (int r = 0; r < 3; ++r) {
    gradient[at(first + r)] += a * g[r];
    gradient[at(first + 4 + r)] += b * g[r];
    for (int c = 0; c <= r; ++c) {
      hessian.lower(first + r, first + c) += a * a * h(r, c);
      hessian.lower(first + 4 + r, first + 4 + c) += b * b * h(r, c);
    }
    for (int c = 0; c < 3; ++c) hessian.lower(first + 4 + r, first + c) += a * b * h(r, c);
    hessian.lower(first + 3, first + r) += a * h(3, r);
    hessian.lower(first + 4 + r, first + 3) += b * h(r, 3);
  }
  gradient[at(first + 3)] += g[3];
  hessian.lower(first + 3, first + 3) += h(3, 3);
}

bool reachable(const vessel::Field& field, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (reachable_point_mm(field, from, to) - to).norm() < 1e-9;
}

/// Whether all walls around two samples have one normal: then no ridge lies between them.
bool walls_agree(const Sample& a, const Sample& b) {
  const Eigen::Vector3d n = a.wall[0].normal.normalized();
  for (const Sample* s : {&a, &b}) {
    for (int k = 0; k < s->walls; ++k) {
      const LocalWall& wall = s->wall[at(k)];
      if (wall.ridge || n.dot(wall.normal.normalized()) < kSameNormal) return false;
    }
  }
  return true;
}

void set_stiffness(Sample& s) {
  s.stiffness_n_per_mm = s.foundation_n_per_mm2 * s.share_mm + s.tip_cap_n_per_mm;
  s.stick_stiffness_n_per_mm = s.stick_ratio * s.stiffness_n_per_mm;
}

FrictionLaw friction_of(const Sample& s) {
  return {s.stick_stiffness_n_per_mm, s.friction * s.lagged_normal_n};
}

}  // namespace

void FrictionMemory::clear() {
  arc_mm.clear();
  anchor_mm.clear();
  normal_n_per_mm.clear();
}

void FrictionMemory::reserve(std::size_t samples) {
  arc_mm.reserve(samples);
  anchor_mm.reserve(samples);
  normal_n_per_mm.reserve(samples);
}

void ContactSet::reserve(int rods, std::size_t samples) {
  samples_.reserve(samples);
  memory_.reserve(samples);
  start_shape_.reserve(rods);
}

void ContactSet::place(const rod::MaterialLine& line, const rod::ChainMaterial& material,
                       const rod::ChainShape& shape, int rods_in_lumen, const vessel::Field& field,
                       const ContactSpec& spec, const FrictionMemory& memory) {
  samples_.clear();
  memory_.arc_mm.assign(memory.arc_mm.begin(), memory.arc_mm.end());
  memory_.anchor_mm.assign(memory.anchor_mm.begin(), memory.anchor_mm.end());
  memory_.normal_n_per_mm.assign(memory.normal_n_per_mm.begin(), memory.normal_n_per_mm.end());
  start_shape_ = shape;
  double before_mm = 0.0;  // half an interval of the rod before
  for (int i = 0; i < rods_in_lumen; ++i) {
    const double length = material.length_mm[at(i)];
    const Eigen::Vector3d middle = 0.5 * (shape.joints_mm[at(i)] + shape.joints_mm[at(i + 1)]);
    const int count = intervals(length, field.lumen_radius_mm(middle), spec);
    for (int k = 0; k < count; ++k) {
      Sample s;
      s.rod = i;
      s.fraction = static_cast<double>(k) / count;
      s.arc_mm = material.arc_mm[at(i)] + s.fraction * length;
      s.share_mm = k > 0 ? length / count : before_mm + 0.5 * length / count;
      s.radius_mm = line.radius_mm(s.arc_mm);
      s.friction = line.friction(s.arc_mm);
      s.start_mm = s.position_mm(shape);
      s.start_spin_rad = shape.spin_rad[at(i)];
      samples_.push_back(s);
    }
    before_mm = 0.5 * length / count;
  }
  std::size_t k = 0;
  for (Sample& s : samples_) {
    recall(memory, k, s);
    s.normal_n = s.lagged_normal_n;
    s.detected_at_mm = s.start_mm;
  }
}

void ContactSet::detect_sample(const rod::ChainShape& shape, const vessel::Field& field,
                               const ContactSpec& spec, double share, Sample& s) const {
  const Eigen::Vector3d target = s.detected_at_mm + share * (s.position_mm(shape) - s.detected_at_mm);
  s.detected_at_mm = slid_point_mm(field, s.detected_at_mm, target, s.radius_mm);
  s.wrong = false;
  const Eigen::Vector3d tangent = tangent_at(shape, s);
  find_local_walls(field, spec, tangent, s);
  if (s.walls == 0) return;
  s.foundation_n_per_mm2 = wall_stiffness_n_per_mm2(spec.wall, s.lumen_radius_mm, s.radius_mm);
  s.tip_cap_n_per_mm = s.arc_mm == 0.0 ? tip_cap_stiffness_n_per_mm(spec.wall, s.radius_mm) : 0.0;
  s.stick_ratio = spec.stick_stiffness_ratio;
  set_stiffness(s);
  s.cap_mm = wall_cap_mm(spec.wall, s.lumen_radius_mm, field.tissue_to_next_lumen_mm(s.detected_at_mm));
  const Eigen::Vector3d& n = s.wall[0].normal;
  const Eigen::Vector3d along = tangent - n * n.dot(tangent);
  s.axial = along.norm() > 0.1 ? along.normalized() : math::any_normal(n);
  s.around = n.cross(s.axial);
}

void ContactSet::detect(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec) {
  models_since_detection_ = 0;
  renewals_ = 0;
  for (Sample& s : samples_) detect_sample(shape, field, spec, 1.0, s);
}

int ContactSet::redetect(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec,
                         double share) {
  int detected = 0;
  for (Sample& s : samples_) {
    if (!s.wrong) continue;
    detect_sample(shape, field, spec, share, s);
    ++detected;
  }
  return detected;
}

int ContactSet::add_over_ridges(const rod::MaterialLine& line, const rod::ChainMaterial& material,
                                const rod::ChainShape& shape, const vessel::Field& field) {
  int added = 0;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const Sample& a = samples_[i];
    const Sample& b = samples_[i + 1];
    const double gap = b.arc_mm - a.arc_mm;
    if (gap <= 1.5 * kRidgeStep_mm) continue;
    // φ falls by no more than the distance: two samples that are clear of the wall by the gap between them hide nothing.
    if (a.walls == 0 && b.walls == 0 && a.clearance_mm + b.clearance_mm > gap) continue;
    const bool near_detection = (a.position_mm(shape) - a.detected_at_mm).norm() < kStillThere_mm &&
                                (b.position_mm(shape) - b.detected_at_mm).norm() < kStillThere_mm;
    if (a.walls > 0 && b.walls > 0 && near_detection && walls_agree(a, b)) continue;
    const int points = static_cast<int>(std::ceil(gap / kRidgeStep_mm));
    double deepest = kRidgeDip_mm;
    double where = -1.0;
    for (int k = 1; k < points; ++k) {
      const double arc = a.arc_mm + gap * k / points;
      const double length = material.length_mm[at(a.rod)];
      const double w = (arc - material.arc_mm[at(a.rod)]) / length;
      const Eigen::Vector3d x = (1.0 - w) * shape.joints_mm[at(a.rod)] + w * shape.joints_mm[at(a.rod + 1)];
      const double dip = line.radius_mm(arc) - field.at(x).distance_mm;
      if (dip <= deepest) continue;
      deepest = dip;
      where = arc;
    }
    if (where < 0.0) continue;
    add_between(i, where, line, material, shape);
    ++added;
    ++i;
  }
  return added;
}

void ContactSet::add_between(std::size_t before, double arc_mm, const rod::MaterialLine& line,
                             const rod::ChainMaterial& material, const rod::ChainShape& shape) {
  Sample& a = samples_[before];
  Sample& b = samples_[before + 1];
  Sample s;
  s.rod = a.rod;
  s.fraction = (arc_mm - material.arc_mm[at(a.rod)]) / material.length_mm[at(a.rod)];
  s.arc_mm = arc_mm;
  s.share_mm = 0.5 * (b.arc_mm - a.arc_mm);
  a.share_mm -= 0.5 * (b.arc_mm - arc_mm);
  b.share_mm -= 0.5 * (arc_mm - a.arc_mm);
  set_stiffness(a);
  set_stiffness(b);
  s.radius_mm = line.radius_mm(arc_mm);
  s.friction = line.friction(arc_mm);
  s.start_mm = s.position_mm(start_shape_);
  s.start_spin_rad = start_shape_.spin_rad[at(s.rod)];
  std::size_t k = 0;
  recall(memory_, k, s);
  // It has followed its neighbours on their way: detection goes on from between them.
  s.detected_at_mm = s.position_mm(shape) + 0.5 * (a.detected_at_mm - a.position_mm(shape) +
                                                   b.detected_at_mm - b.position_mm(shape));
  s.wrong = true;
  samples_.insert(samples_.begin() + static_cast<std::ptrdiff_t>(before) + 1, s);
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

double ContactSet::add_derivatives(const rod::ChainShape& shape, math::BandMatrix& hessian,
                                   std::vector<double>& gradient) {
  ++models_since_detection_;
  double energy = 0.0;
  for (Sample& s : samples_) {
    s.in_model = {};
    s.normal_n = 0.0;
    s.deflection_mm = 0.0;
    if (s.walls == 0) continue;
    // Gradient and Hessian in (position of the sample, spin of its rod).
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    Eigen::Matrix4d h = Eigen::Matrix4d::Zero();
    const Eigen::Vector3d u = s.position_mm(shape) - s.detected_at_mm;
    for (int k = 0; k < s.walls; ++k) {
      const LocalHeight height = local_height_derivatives(s.wall[at(k)], u);
      const double depth = s.radius_mm - height.value_mm;
      const WallResponse w = wall_response(s.stiffness_n_per_mm, s.cap_mm, depth);
      if (w.force_n <= 0.0) continue;
      energy += w.energy_mj;
      s.normal_n += w.force_n;
      s.deflection_mm = std::max(s.deflection_mm, depth);
      g.head<3>() -= w.force_n * height.gradient;
      h.topLeftCorner<3, 3>() += w.stiffness_n_per_mm * height.gradient * height.gradient.transpose() -
                                 w.bounded_force_n * height.hessian;
    }
    if (s.friction > 0.0 && s.lagged_normal_n > 0.0) {
      const FrictionResponse f = friction_response(friction_of(s), slip_of(s, shape));
      Eigen::Matrix<double, 2, 4> slip = Eigen::Matrix<double, 2, 4>::Zero();
      slip.block<1, 3>(0, 0) = s.axial.transpose();
      slip.block<1, 3>(1, 0) = s.around.transpose();
      slip(1, 3) = s.radius_mm;
      energy += f.energy_mj;
      g += slip.transpose() * f.force_n;
      h += slip.transpose() * f.stiffness_n_per_mm * slip;
    }
    scatter(s, g, h, 1.0, hessian, gradient);
  }
  return energy;
}

bool ContactSet::anticipate(const rod::ChainShape& shape, const std::vector<double>& step, int hand_joint,
                            math::BandMatrix& hessian, std::vector<double>& gradient) {
  constexpr double kDeep = 0.5;  // of the cap
  bool changed = false;
  for (Sample& s : samples_) {
    const auto moved = [&](int joint) { return Eigen::Map<const Eigen::Vector3d>(step.data() + 4 * joint); };
    const Eigen::Vector3d u = s.position_mm(shape) - s.detected_at_mm;
    for (int k = 0; k < s.walls; ++k) {
      const LocalHeight height = local_height_derivatives(s.wall[at(k)], u);
      const double depth = s.radius_mm - height.value_mm;
      const Eigen::Vector3d& n = height.gradient;
      const Eigen::Vector3d motion = (1.0 - s.fraction) * moved(s.rod) + s.fraction * moved(s.rod + 1);
      const bool closes = depth < kWallOnset_mm && depth - n.dot(motion) > kWallOnset_mm;
      const bool buried = models_since_detection_ == 1 && depth > kDeep * s.cap_mm;
      // A wall that others now keep the wire off leaves the model again: it would pull.
      const bool in = s.in_model[at(k)] == Sample::InModel::anticipated;
      if ((closes || buried) == in || s.in_model[at(k)] == Sample::InModel::dropped) continue;
      const double sign = in ? -1.0 : 1.0;
      // The wall as a spring that also pulls, in place of what the model has of it.
      const WallResponse present = wall_response(s.stiffness_n_per_mm, s.cap_mm, depth);
      const double force = s.stiffness_n_per_mm * (depth - 0.5 * kWallOnset_mm) - present.force_n;
      const double stiffness = s.stiffness_n_per_mm - present.stiffness_n_per_mm;
      Eigen::Vector4d g = Eigen::Vector4d::Zero();
      Eigen::Matrix4d h = Eigen::Matrix4d::Zero();
      g.head<3>() = -sign * force * n;
      h.topLeftCorner<3, 3>() = sign * stiffness * n * n.transpose();
      scatter(s, g, h, s.rod + 1 == hand_joint ? 0.0 : 1.0, hessian, gradient);
      s.in_model[at(k)] = in ? Sample::InModel::dropped : Sample::InModel::anticipated;
      changed = true;
    }
  }
  return changed;
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
  // Friction that unloads its own normal force makes this fixed-point iteration swing; half steps settle it.
  const double share = ++renewals_ <= kFullRenewals ? 1.0 : 0.5;
  for (Sample& s : samples_) s.lagged_normal_n += share * (s.normal_n - s.lagged_normal_n);
}

Verification ContactSet::verify(const rod::ChainShape& shape, const vessel::Field& field,
                                const ContactSpec& spec, bool rough_field) {
  Verification result;
  for (Sample& s : samples_) {
    s.wrong = false;
    const Eigen::Vector3d x = s.position_mm(shape);
    const Eigen::Vector3d u = x - s.detected_at_mm;
    // Within its clearance a sample cannot have touched anything, nor passed a wall.
    if (u.norm() < s.clearance_mm) continue;
    double error = HUGE_VAL;
    if (u.norm() < kShortMove_mm || reachable(field, s.detected_at_mm, x)) {
      double predicted = HUGE_VAL;
      for (int k = 0; k < s.walls; ++k) predicted = std::min(predicted, local_height_mm(s.wall[at(k)], u));
      const double actual = field.at(x).distance_mm;
      if (std::min(actual, predicted) >= s.radius_mm) continue;
      error = s.walls == 0 ? s.radius_mm - actual : std::abs(actual - predicted);
    }
    result.gap_error_mm = std::max(result.gap_error_mm, error);
    // At the very place of detection the walls are the field; what they still miss there is the field's own roughness.
    s.wrong =
        error > (rough_field || u.norm() < kAtDetection_mm ? std::max(spec.gap_error_mm, field.error_mm())
                                                           : spec.gap_error_mm);
    result.wrong_samples += s.wrong ? 1 : 0;
  }
  return result;
}

int ContactSet::mark_outside(const rod::ChainShape& shape, double region_mm) {
  int outside = 0;
  for (Sample& s : samples_) {
    s.wrong = (s.position_mm(shape) - s.detected_at_mm).norm() > region_mm + std::max(0.0, s.clearance_mm);
    outside += s.wrong ? 1 : 0;
  }
  return outside;
}

void ContactSet::remember(const rod::ChainShape& shape, FrictionMemory& memory) const {
  memory.clear();
  for (const Sample& s : samples_) {
    memory.arc_mm.push_back(s.arc_mm);
    const bool rubs = s.walls > 0 && s.friction > 0.0 && s.lagged_normal_n > 0.0;
    memory.anchor_mm.push_back(rubs ? friction_anchor(friction_of(s), slip_of(s, shape))
                                    : Eigen::Vector2d::Zero());
    memory.normal_n_per_mm.push_back(s.walls > 0 ? s.normal_n / s.share_mm : 0.0);
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

// Where a set of samples meets the field: detection, ridges between samples, verification and correction.
#include <algorithm>
#include <cmath>

#include "endowire/contact/contact_set.hpp"
#include "endowire/contact/detect.hpp"
#include "endowire/contact/put_sample.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// A sample on the wall that moved less cannot have passed one: its axis keeps a radius away.
constexpr double kShortMove_mm = 0.1;
constexpr double kAtDetection_mm = 0.1;
/// Ridges are looked for at this spacing between samples, where normals differ by more than 3°, and matter from this depth on.
constexpr double kRidgeStep_mm = 0.5;
constexpr double kSameNormal = 0.9986;
/// The normals of a detection tell of the walls here as long as a sample has moved less.
constexpr double kStillThere_mm = 0.1;
constexpr double kRidgeDip_mm = 0.03;
/// Walls whose heights differ by less make a corner. A wall is not turned by more than this to follow the field: what turns
/// faster is an edge. Corrections below these leave an equilibrium as it is.
constexpr double kCorner_mm = 0.05;
constexpr double kMostTilt = 0.3;
constexpr double kSameHeight_mm = 2e-4;
constexpr double kSamePlace_mm = 1e-3;  // the accuracy of a converged state
constexpr double kSameSlope = 2e-3;
Eigen::Vector3d tangent_at(const rod::ChainShape& shape, const Sample& sample) {
  const Eigen::Vector3d own = shape.frames[at(sample.rod)].col(2);
  if (sample.fraction > 0.0 || sample.rod == 0) return own;
  return (own + shape.frames[at(sample.rod - 1)].col(2)).normalized();
}

/// The wall that alone touches a sample, null at a corner, where walls are about as near as each other.
LocalWall* single_wall(Sample& s, const Eigen::Vector3d& u, double nearest_mm) {
  LocalWall* single = nullptr;
  for (int k = 0; k < s.walls; ++k) {
    if (local_height_mm(s.wall[at(k)], u) > nearest_mm + kCorner_mm) continue;
    if (single != nullptr) return nullptr;
    single = &s.wall[at(k)];
  }
  return single;
}

/// Gives the wall that a sample touches what the field says there.
/// @return  whether that changes more than the solution's own accuracy
bool correct_wall(Sample& s, const Eigen::Vector3d& u, double predicted_mm,
                  const vessel::WallDistance& actual) {
  LocalWall* wall = single_wall(s, u, predicted_mm);
  if (wall == nullptr) return false;
  const double turn = (actual.gradient - local_height_derivatives(*wall, u).gradient).norm();
  if (turn > kMostTilt) return false;
  const bool same_height = std::abs(actual.distance_mm - predicted_mm) <= kSameHeight_mm;
  if (same_height && turn > kSameSlope && rests_on_kink(*wall, u, actual.gradient, kSamePlace_mm, kSameSlope))
    return false;
  correct_local_wall(u, actual.distance_mm, actual.gradient, *wall);
  return !same_height || turn > kSameSlope;
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
  s.stiffness_n_per_mm = s.foundation_n_per_mm2 * s.share_mm() + s.tip_cap_n_per_mm;
  s.stick_stiffness_n_per_mm = s.stick_ratio * s.stiffness_n_per_mm;
  s.anchor_mm = s.traction_n_per_mm * s.share_mm() / s.stick_stiffness_n_per_mm;
}

/// The stretch that a sample stands for, and with it the force on it, when a part of it goes to another.
void set_stretch(Sample& s, double from_mm, double to_mm) {
  const double share = s.share_mm();
  s.from_mm = from_mm;
  s.to_mm = to_mm;
  s.lagged_normal_n *= s.share_mm() / share;
  s.last_lag_n = 0.0;
  if (s.walls > 0) set_stiffness(s);
}

/// The walls around a sample. One that was led back to where it came from, as between the two sides of a ridge, goes half of the
/// way only: its places of detection are bisected.
void detect_sample(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec,
                   Sample& s) {
  Eigen::Vector3d way = s.position_mm(shape) - s.detected_at_mm;
  if (way.dot(s.last_way_mm) < 0.0) way *= 0.5;
  s.last_way_mm = way;
  s.detected_at_mm = slid_point_mm(field, s.detected_at_mm, s.detected_at_mm + way, s.radius_mm);
  s.wrong = false;
  s.fresh = true;
  s.last_lag_n = 0.0;
  s.closed = {};
  s.closed[0] = s.lagged_normal_n > 0.0;  // what touched before will touch again
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

}  // namespace

void ContactSet::detect(const Wire& wire, const vessel::Field& field, const ContactSpec& spec) {
  renewals_ = 0;
  for (Sample& s : samples_) {
    s.detected_at_mm = s.start_mm;
    s.last_way_mm.setZero();
    detect_sample(wire.shape, field, spec, s);
  }
}

int ContactSet::redetect(const Wire& wire, const vessel::Field& field, const ContactSpec& spec) {
  int detected = 0;
  for (Sample& s : samples_) {
    if (!s.wrong) continue;
    detect_sample(wire.shape, field, spec, s);
    ++detected;
  }
  return detected;
}

void ContactSet::detect_again(const Wire& wire, const vessel::Field& field, const ContactSpec& spec) {
  for (Sample& s : samples_) {
    s.last_way_mm.setZero();  // no bisection: the walls are wanted where the sample is
    detect_sample(wire.shape, field, spec, s);
  }
}

int ContactSet::add_over_ridges(const Wire& wire, const vessel::Field& field, bool rough_field) {
  const rod::ChainShape& shape = wire.shape;
  const double least_dip_mm = rough_field ? std::max(kRidgeDip_mm, field.error_mm()) : kRidgeDip_mm;
  int added = 0;
  for (std::size_t i = 0; i + 1 < samples_.size() && samples_.size() < samples_.capacity(); ++i) {
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
    double deepest = least_dip_mm;
    double where = -1.0;
    Sample probe = a;
    const auto depth_at = [&](double arc_mm) {
      put_at(wire.line, wire.material, arc_mm, probe);
      return probe.radius_mm - field.at(probe.position_mm(shape)).distance_mm;
    };
    // A wall that gives way under the samples on both sides gives way between them as well.
    const double at_a = std::max(0.0, depth_at(a.arc_mm));
    const double at_b = std::max(0.0, depth_at(b.arc_mm));
    for (int k = 1; k < points; ++k) {
      const double share = static_cast<double>(k) / points;
      const double dip = depth_at(a.arc_mm + gap * share) - (at_a + share * (at_b - at_a));
      if (dip <= deepest) continue;
      deepest = dip;
      where = probe.arc_mm;
    }
    if (where < 0.0) continue;
    add_between(wire, i, where);
    ++added;
    ++i;
  }
  return added;
}

void ContactSet::add_between(const Wire& wire, std::size_t before, double arc_mm) {
  Sample& a = samples_[before];
  Sample& b = samples_[before + 1];
  Sample s;
  s.rod = a.rod;
  put_at(wire.line, wire.material, arc_mm, s);
  s.from_mm = 0.5 * (a.arc_mm + arc_mm);
  s.to_mm = 0.5 * (arc_mm + b.arc_mm);
  set_stretch(a, a.from_mm, s.from_mm);
  set_stretch(b, s.to_mm, b.to_mm);
  s.start_mm = start_position_mm(s);
  s.start_spin_rad = start_shape_.spin_rad[at(s.rod)];
  memory_.recall(advanced_mm_, s);
  // It has followed its neighbours on their way: detection goes on from between them.
  s.detected_at_mm = s.position_mm(wire.shape) + 0.5 * (a.detected_at_mm - a.position_mm(wire.shape) +
                                                        b.detected_at_mm - b.position_mm(wire.shape));
  s.wrong = true;
  samples_.insert(samples_.begin() + static_cast<std::ptrdiff_t>(before) + 1, s);
}

Verification ContactSet::verify(const Wire& wire, const vessel::Field& field, const ContactSpec& spec,
                                bool rough_field, bool correct) {
  const rod::ChainShape& shape = wire.shape;
  Verification result;
  for (Sample& s : samples_) {
    s.wrong = false;
    const Eigen::Vector3d x = s.position_mm(shape);
    const Eigen::Vector3d u = x - s.detected_at_mm;
    // Within its clearance a sample cannot have touched anything, nor passed a wall.
    if (u.norm() < s.clearance_mm) continue;
    double error = HUGE_VAL;
    // At the very place of detection the walls are the field; what they still miss there is the field's own roughness.
    const double allowed = rough_field || u.norm() < kAtDetection_mm
                               ? std::max(spec.gap_error_mm, field.error_mm())
                               : spec.gap_error_mm;
    if (u.norm() < kShortMove_mm || reachable(field, s.detected_at_mm, x)) {
      double predicted = HUGE_VAL;
      for (int k = 0; k < s.walls; ++k) predicted = std::min(predicted, local_height_mm(s.wall[at(k)], u));
      const vessel::WallDistance there_is = field.at(x);
      const double actual = there_is.distance_mm;
      if (std::min(actual, predicted) >= s.radius_mm) continue;
      error = s.walls == 0 ? s.radius_mm - actual : std::abs(actual - predicted);
      if (correct && error <= allowed && correct_wall(s, u, predicted, there_is)) result.corrected = true;
    }
    result.gap_error_mm = std::max(result.gap_error_mm, error);
    s.wrong = error > allowed;
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

}  // namespace endowire::contact

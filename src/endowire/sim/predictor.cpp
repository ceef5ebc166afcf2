#include "endowire/sim/predictor.hpp"

#include <algorithm>

#include "endowire/math/transport.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Point of the present polyline at a material arc; straight beyond both ends. `rod` is where the last look-up was.
Eigen::Vector3d point_at(const rod::ChainMaterial& material, const std::vector<Eigen::Vector3d>& joints,
                         double arc, int& rod) {
  const int rods = material.rods();
  while (rod > 0 && arc < material.arc_mm[at(rod)]) --rod;
  while (rod + 1 < rods && arc >= material.arc_mm[at(rod + 1)]) ++rod;
  const double fraction =
      (arc - material.arc_mm[at(rod)]) / (material.arc_mm[at(rod + 1)] - material.arc_mm[at(rod)]);
  return joints[at(rod)] + fraction * (joints[at(rod + 1)] - joints[at(rod)]);
}

/// Turns the frames to the directions of their rods.
void transport_frames(rod::ChainShape& shape) {
  for (int i = 0; i < shape.rods(); ++i) {
    rod::Frame& frame = shape.frames[at(i)];
    const Eigen::Vector3d e = (shape.joints_mm[at(i)] - shape.joints_mm[at(i + 1)]).normalized();
    const Eigen::Vector3d m1 = math::normal_part(math::parallel_transport(frame.col(0), frame.col(2), e), e);
    frame.col(0) = m1;
    frame.col(1) = e.cross(m1);
    frame.col(2) = e;
  }
  for (int j = 1; j < shape.rods(); ++j) {
    shape.twist_rad[at(j)] =
        rod::twist_between(shape.frames[at(j)], shape.frames[at(j - 1)], shape.twist_rad[at(j)]);
  }
}

/// Drift at an arc, linear between the joints that had one; none in wire that was in the sheath.
Eigen::Vector3d drift_at(const Drift& drift, double arc_mm, std::size_t& k) {
  const std::size_t last = drift.arc_mm.size() - 1;
  if (arc_mm > drift.arc_mm[last]) return Eigen::Vector3d::Zero();
  while (k + 1 < last && arc_mm > drift.arc_mm[k + 1]) ++k;
  if (k == last) return drift.joints_mm[k];
  const double share = (arc_mm - drift.arc_mm[k]) / (drift.arc_mm[k + 1] - drift.arc_mm[k]);
  return drift.joints_mm[k] + share * (drift.joints_mm[k + 1] - drift.joints_mm[k]);
}

}  // namespace

void follow_trace(const rod::ChainMaterial& material, const HandStep& hand, rod::ChainShape& shape,
                  std::vector<Eigen::Vector3d>& trace) {
  const int n = shape.rods();
  trace.assign(shape.joints_mm.begin(), shape.joints_mm.end());
  const double entering = material.arc_mm[at(n - 1)] - material.arc_mm[at(n - 2)];
  int rod = n - 2;
  Eigen::Vector3d old_hand = trace[at(n - 1)];
  for (int i = n - 2; i >= 0; --i) {
    double length = (trace[at(i)] - trace[at(i + 1)]).norm();
    if (i == n - 2) length *= (entering + hand.advance_mm) / entering;
    const Eigen::Vector3d old_tip = point_at(material, trace, material.arc_mm[at(i)] - hand.advance_mm, rod);
    shape.joints_mm[at(i)] = shape.joints_mm[at(i + 1)] + length * (old_tip - old_hand).normalized();
    old_hand = old_tip;
  }
  rod::Frame& held = shape.frames[at(n - 1)];
  held.col(0) = math::spin_about(held.col(0), held.col(2), hand.turn_rad);
  shape.spin_rad[at(n - 1)] += hand.turn_rad;
  shape.twist_rad[at(n - 1)] -= hand.turn_rad;
  transport_frames(shape);
}

double predicted_slip_mm(const Drift& drift, double advance_mm) {
  if (!(drift.advance_mm * advance_mm > 0.0)) return 0.0;
  return advance_mm * std::clamp(drift.slip_mm / drift.advance_mm, 0.0, 1.0);
}

void follow_drift(const Drift& drift, const rod::ChainMaterial& material, double advance_mm,
                  rod::ChainShape& shape, std::vector<Eigen::Vector3d>& scratch) {
  constexpr double kMostOften = 2.0;  // further ahead than twice the last step its drift tells nothing
  if (!(drift.advance_mm * advance_mm > 0.0) || drift.joints_mm.empty()) return;
  const double ratio = std::min(kMostOften, advance_mm / drift.advance_mm);
  const int n = shape.rods();
  scratch.assign(shape.joints_mm.begin(), shape.joints_mm.end());
  std::size_t k = 0;
  for (int i = 0; i < n - 1; ++i) scratch[at(i)] += ratio * drift_at(drift, material.arc_mm[at(i)], k);
  double length = (shape.joints_mm[at(n - 2)] - shape.joints_mm[at(n - 1)]).norm();
  for (int i = n - 2; i >= 0; --i) {
    const double next = i > 0 ? (shape.joints_mm[at(i - 1)] - shape.joints_mm[at(i)]).norm() : 0.0;
    shape.joints_mm[at(i)] =
        shape.joints_mm[at(i + 1)] + length * (scratch[at(i)] - scratch[at(i + 1)]).normalized();
    length = next;
  }
  transport_frames(shape);
}

}  // namespace endowire::sim

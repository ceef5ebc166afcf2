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

}  // namespace

void predict(const rod::ChainMaterial& material, const Eigen::Vector3d& sheath_point,
             const Eigen::Vector3d& sheath_direction, double inserted_mm, double advance_mm, double turn_rad,
             rod::ChainShape& shape, std::vector<Eigen::Vector3d>& trace) {
  const int n = shape.rods();
  trace.assign(shape.joints_mm.begin(), shape.joints_mm.end());
  const double half = inserted_mm - material.arc_mm[at(n - 1)];
  shape.joints_mm[at(n - 1)] = sheath_point + half * sheath_direction;
  shape.joints_mm[at(n)] = sheath_point - half * sheath_direction;
  // The polyline is parametrised as it was before the advance: the sheath rod was shorter by the advance on each side.
  int rod = n - 1;
  Eigen::Vector3d old_hand = point_at(material, trace, material.arc_mm[at(n - 1)] - advance_mm, rod);
  for (int i = n - 2; i >= 0; --i) {
    const double length = (trace[at(i)] - trace[at(i + 1)]).norm();
    const Eigen::Vector3d old_tip = point_at(material, trace, material.arc_mm[at(i)] - advance_mm, rod);
    shape.joints_mm[at(i)] = shape.joints_mm[at(i + 1)] + length * (old_tip - old_hand).normalized();
    old_hand = old_tip;
  }
  for (int i = 0; i < n; ++i) {
    rod::Frame& frame = shape.frames[at(i)];
    const Eigen::Vector3d e = (shape.joints_mm[at(i)] - shape.joints_mm[at(i + 1)]).normalized();
    Eigen::Vector3d m1 = math::parallel_transport(frame.col(0), frame.col(2), e);
    if (i == n - 1) {
      m1 = math::spin_about(m1, e, turn_rad);
      shape.spin_rad[at(i)] += turn_rad;
      shape.twist_rad[at(i)] -= turn_rad;
    }
    m1 = math::normal_part(m1, e);
    frame.col(0) = m1;
    frame.col(1) = e.cross(m1);
    frame.col(2) = e;
  }
  for (int j = 1; j < n; ++j) {
    shape.twist_rad[at(j)] =
        rod::twist_between(shape.frames[at(j)], shape.frames[at(j - 1)], shape.twist_rad[at(j)]);
  }
}

}  // namespace endowire::sim

#include "endowire/rod/coaxial.hpp"

#include <cmath>
#include <utility>

#include "endowire/base/contract.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::rod {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double middle_mm(const ChainMaterial& material, int rod) {
  return 0.5 * (material.arc_mm[at(rod)] + material.arc_mm[at(rod + 1)]);
}

/// The first joint that bends an instrument whose tip is there.
int joint_behind(const ChainMaterial& material, double arc_mm) {
  constexpr double kSame_mm = 1e-9;
  if (arc_mm == material.arc_mm[0]) return 1;  // the tip, exactly
  for (int rod = 0; rod + 1 < material.rods(); ++rod)
    if (std::abs(middle_mm(material, rod) - arc_mm) <= kSame_mm) return rod + 1;
  return material.rods();
}

}  // namespace

double nearest_rod_middle_mm(const ChainMaterial& material, double arc_mm) {
  double nearest = middle_mm(material, 0);
  for (int rod = 1; rod + 1 < material.rods(); ++rod)
    if (std::abs(middle_mm(material, rod) - arc_mm) < std::abs(nearest - arc_mm))
      nearest = middle_mm(material, rod);
  return nearest;
}

void add_coaxial(const ImmersedWire& wire, double behind_mm, ChainMaterial& material) {
  const int n = material.rods();
  const int first = joint_behind(material, behind_mm);
  ENDOWIRE_EXPECTS(first < n, "a coaxial instrument ends at the tip or in the middle of a rod");
  const bool at_tip = behind_mm == material.arc_mm[0];
  CoaxialMaterial added;
  added.first_joint = first;
  added.joints.resize(at(n + 1));
  for (int j = at_tip ? 0 : first; j <= n; ++j) {
    const double from = (j == 0 ? material.arc_mm[0] : middle_mm(material, j - 1)) - behind_mm;
    const double to = (j == n ? material.arc_mm[at(n)] : middle_mm(material, j)) - behind_mm;
    added.joints[at(j)] = joint_material(*wire.line, from, to);
    material.weight_n[at(j)] += wire.weight_n(from, to);
  }
  for (int i = at_tip ? 0 : first; i < n; ++i) {
    const double from = material.arc_mm[at(i)] - behind_mm;
    const double length = material.length_mm[at(i)];
    material.stretch_n_per_mm[at(i)] += wire.line->axial_rigidity_n(from, from + length) / length;
  }
  material.coaxial.push_back(std::move(added));
}

void add_coaxial_frames(double turned_rad, ChainShape& shape) {
  RodFrames added = shape;
  for (Frame& frame : added.frames) {
    frame.col(0) = math::normal_part(math::spin_about(frame.col(0), frame.col(2), turned_rad), frame.col(2));
    frame.col(1) = frame.col(2).cross(frame.col(0));
  }
  for (double& spin : added.spin_rad) spin += turned_rad;
  shape.coaxial.push_back(std::move(added));
}

double end_torque_n_mm(const ChainMaterial& material, const ChainShape& shape, int instrument) {
  const int last = shape.rods() - 1;
  const RodFrames& f = instrument == 0 ? shape : shape.coaxial[at(instrument - 1)];
  const auto& joints = instrument == 0 ? material.joints : material.coaxial[at(instrument - 1)].joints;
  JointDerivatives d;
  joint_derivatives(joints[at(last)], f.frames[at(last)], f.frames[at(last - 1)], f.twist_rad[at(last)], d);
  return d.gradient[2];
}

}  // namespace endowire::rod

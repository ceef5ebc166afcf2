#include "endowire/rod/joint_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "endowire/rod/angle_factor.hpp"

namespace endowire::rod {

namespace {

/// v wᵀ + w vᵀ
Eigen::Matrix3d both(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  const Eigen::Matrix3d outer = v * w.transpose();
  return outer + outer.transpose();
}

double square(double x) {
  return x * x;
}

}  // namespace

void blocks_of(const JointDerivatives& joint, const JointRods& rods, JointBlocks& out) {
  using Lever = Eigen::Matrix<double, 3, 2>;
  const Lever a = rods.hand_side.leftCols<2>() / rods.hand_length_mm;
  const Lever b = rods.tip_side.leftCols<2>() / rods.tip_length_mm;
  const auto& h = joint.hessian;
  const auto block = [](const Lever& left, const Eigen::Matrix2d& middle, const Lever& right) {
    const Lever lm = left.lazyProduct(middle);
    return Eigen::Matrix3d(lm.lazyProduct(right.transpose()));
  };
  out.energy_mj = joint.energy_mj;
  out.hand = a * joint.gradient.segment<2>(0);
  out.tip = b * joint.gradient.segment<2>(3);
  out.hand_spin = joint.gradient[2];
  out.tip_spin = joint.gradient[5];
  out.hand_hand =
      block(a, h.block<2, 2>(0, 0), a) - both(rods.hand_side.col(2), out.hand / rods.hand_length_mm);
  out.tip_tip = block(b, h.block<2, 2>(3, 3), b) - both(rods.tip_side.col(2), out.tip / rods.tip_length_mm);
  out.hand_tip = block(a, h.block<2, 2>(0, 3), b);
  out.hand_by_hand_spin = a * h.block<2, 1>(0, 2);
  out.tip_by_hand_spin = b * h.block<2, 1>(3, 2);
  out.hand_by_tip_spin = a * h.block<2, 1>(0, 5);
  out.tip_by_tip_spin = b * h.block<2, 1>(3, 5);
  out.hand_spin_twice = h(2, 2);
  out.spins = h(2, 5);
  out.tip_spin_twice = h(5, 5);
}

bool is_straight(const JointMaterial& material, const JointRods& rods) {
  if (!material.rest_bend_rad.isZero(0.0) || material.bend_n_mm2[0] != material.bend_n_mm2[1]) return false;
  // φ ≤ ½π |e − f|: what is clear of the kink law by that needs no arc cosine.
  const double chord_squared = (rods.hand_side.col(2) - rods.tip_side.col(2)).squaredNorm();
  if (chord_squared > 2.0) return false;  // beyond 90° the general form
  const double start = kKinkStart * material.kink_per_mm * material.span_mm;
  return !(2.4675 * chord_squared > start * start);
}

void straight_joint(const JointMaterial& material, const JointRods& rods, double twist_rad,
                    JointBlocks& out) {
  const Eigen::Vector3d e = rods.hand_side.col(2);
  const Eigen::Vector3d f = rods.tip_side.col(2);
  const double per_e = 1.0 / rods.hand_length_mm;
  const double per_f = 1.0 / rods.tip_length_mm;
  const double c = std::min(1.0, e.dot(f));
  const double q = 1.0 / (1.0 + c);
  const AngleFactor k = angle_factor(c);
  const double bending = material.bend_n_mm2[0] / material.span_mm;
  const double by_c = -bending * k.value;
  const double by_c_twice = -bending * k.first;
  const double stiff = material.twist_n_mm2 / material.span_mm;
  const double misfit = twist_rad - material.rest_twist_rad;
  const double torque = stiff * misfit;
  const Eigen::Vector3d across = e.cross(f);
  out.energy_mj = 0.5 * bending * square(k.value) * across.squaredNorm() + 0.5 * stiff * misfit * misfit;

  const Eigen::Vector3d c_e = per_e * (f - c * e);
  const Eigen::Vector3d c_f = per_f * (e - c * f);
  const Eigen::Vector3d m_e = (q * per_e) * across;
  const Eigen::Vector3d m_f = (q * per_f) * across;
  out.hand = by_c * c_e + torque * m_e;
  out.tip = by_c * c_f + torque * m_f;
  out.hand_spin = -torque;
  out.tip_spin = torque;

  // αccᵀ + β(cmᵀ + mcᵀ) + γmmᵀ as c(αc + βm)ᵀ + m(βc + γm)ᵀ
  const double mixed = -0.5 * q * torque;
  const Eigen::Vector3d c_row_e = by_c_twice * c_e + mixed * m_e;
  const Eigen::Vector3d m_row_e = mixed * c_e + stiff * m_e;
  const Eigen::Vector3d c_row_f = by_c_twice * c_f + mixed * m_f;
  const Eigen::Vector3d m_row_f = mixed * c_f + stiff * m_f;
  const double turn_e = -by_c * c * per_e * per_e;
  const double turn_f = -by_c * c * per_f * per_f;
  out.hand_hand = c_e * c_row_e.transpose() + m_e * m_row_e.transpose() - e * (turn_e * e).transpose() -
                  both(e, per_e * out.hand);
  out.hand_hand.diagonal().array() += turn_e;
  out.tip_tip = c_f * c_row_f.transpose() + m_f * m_row_f.transpose() - f * (turn_f * f).transpose() -
                both(f, per_f * out.tip);
  out.tip_tip.diagonal().array() += turn_f;

  // by_c Pₑ P_f and torque Pₑ [½q(e + f)]ₓ P_f, both over the lengths.
  const double lengths = per_e * per_f;
  const double even = by_c * lengths;
  const double odd = 0.5 * q * torque * lengths;
  const Eigen::Vector3d g = odd * (e + f);
  const Eigen::Vector3d r = odd * across;
  out.hand_tip = c_e * c_row_f.transpose() + m_e * m_row_f.transpose() +
                 e * (even * c * f - even * e - r).transpose() - (even * f + r) * f.transpose();
  out.hand_tip.diagonal().array() += even;
  out.hand_tip(0, 1) -= g[2];
  out.hand_tip(0, 2) += g[1];
  out.hand_tip(1, 0) += g[2];
  out.hand_tip(1, 2) -= g[0];
  out.hand_tip(2, 0) -= g[1];
  out.hand_tip(2, 1) += g[0];

  out.hand_by_tip_spin = stiff * m_e;
  out.tip_by_tip_spin = stiff * m_f;
  out.hand_by_hand_spin = -out.hand_by_tip_spin;
  out.tip_by_hand_spin = -out.tip_by_tip_spin;
  out.hand_spin_twice = out.tip_spin_twice = stiff;
  out.spins = -stiff;
}

double straight_joint_energy(const JointMaterial& material, const Frame& hand_side, const Frame& tip_side,
                             double twist_rad) {
  const Eigen::Vector3d e = hand_side.col(2);
  const Eigen::Vector3d f = tip_side.col(2);
  const double k = angle_factor(std::min(1.0, e.dot(f))).value;
  const double misfit = twist_rad - material.rest_twist_rad;
  return 0.5 * (material.bend_n_mm2[0] / material.span_mm) * square(k) * e.cross(f).squaredNorm() +
         0.5 * (material.twist_n_mm2 / material.span_mm) * misfit * misfit;
}

}  // namespace endowire::rod

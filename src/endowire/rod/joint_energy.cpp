#include "endowire/rod/joint_energy.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "endowire/rod/angle_factor.hpp"

namespace endowire::rod {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Energy of the kink law as a function of φ: value and two derivatives.
struct KinkLaw {
  double value = 0.0, first = 0.0, second = 0.0;
};

/// ∂(l̄ w(φ/l̄))/∂l̄ = w − κ w'
double kink_by_span(const KinkLaw& law, double phi, double span_mm) {
  return (law.value - phi * law.first) / span_mm;
}

KinkLaw kink_law(const JointMaterial& material, double phi) {
  constexpr double kStart = kKinkStart;
  const double width = (1.0 - kStart) * material.kink_per_mm;
  const double x = (phi / material.span_mm - kStart * material.kink_per_mm) / width;
  if (!(x > 0.0)) return {};
  const double stiffness =
      0.5 * material.bend_n_mm2.sum() * material.kink_per_mm * material.kink_per_mm / 6.0;
  const double scale = 1.0 / (material.span_mm * width);
  return {material.span_mm * stiffness * x * x * x, material.span_mm * stiffness * 3.0 * x * x * scale,
          material.span_mm * stiffness * 6.0 * x * scale * scale};
}

/// One rod's half of the bending energy. `p` holds mₐ·n_b with a of the rod whose frame measures; `own` and
/// `other` are the first of the three turns of that rod and of its neighbour; `sign` is +1 on the hand's side.
struct Side {
  const Eigen::Matrix3d& p;
  int own, other;
  double sign;
};

void add_side(const JointMaterial& material, const Side& side, const AngleFactor& k, const Turns& dc,
              const Matrix6& ddc, JointDerivatives& out) {
  const auto& p = side.p;
  const int o = side.own;
  const int t = side.other;
  const double c = p(2, 2);
  for (int a = 0; a < 2; ++a) {
    // pₐ = mₐ·f and its derivatives; b is the other of the two directors, s the sense of its spin.
    const int b = 1 - a;
    const double s = a == 0 ? 1.0 : -1.0;
    const double value = p(a, 2);
    Turns dp = Turns::Zero();
    dp[o + 2] = s * p(b, 2);
    dp[o + a] = -c;
    dp[t] = p(a, 0);
    dp[t + 1] = p(a, 1);
    Matrix6 ddp = Matrix6::Zero();
    const auto pair = [&ddp](int i, int j, double v) {
      ddp(i, j) += v;
      if (i != j) ddp(j, i) += v;
    };
    pair(o + 2, o + 2, -p(a, 2));
    pair(o + b, o + 2, -s * c);
    pair(o + a, o + a, -p(a, 2));
    pair(o + a, o + b, -0.5 * p(b, 2));
    for (int d = 0; d < 2; ++d) {
      pair(o + 2, t + d, s * p(b, d));
      pair(o + a, t + d, -p(2, d));
      pair(t + d, t + d, -p(a, 2));
    }
    const double curvature = side.sign * k.value * value;
    const Turns dk = side.sign * (k.first * value * dc + k.value * dp);
    const double misfit = curvature - material.rest_bend_rad[a];
    const double stiffness = material.bend_n_mm2[a] / (2.0 * material.span_mm);
    out.energy_mj += 0.5 * stiffness * misfit * misfit;
    out.bend_mj[a] += 0.5 * stiffness * misfit * misfit;
    out.gradient += stiffness * misfit * dk;
    out.rest_gradient[a] -= stiffness * misfit;
    out.rest_turn.row(a) -= stiffness * dk.transpose();
    out.hessian += stiffness * dk * dk.transpose();
    const Matrix6 cross = dc * dp.transpose();
    out.hessian += stiffness * misfit * side.sign *
                   (k.second * value * dc * dc.transpose() + k.first * value * ddc +
                    k.first * (cross + cross.transpose()) + k.value * ddp);
  }
}

void add_twist(const JointMaterial& material, const Eigen::Matrix3d& p, double twist_rad, const Turns& dc,
               JointDerivatives& out) {
  const double q = 1.0 / (1.0 + p(2, 2));
  Turns dm = Turns::Zero();
  dm[0] = -p(1, 2) * q;
  dm[1] = p(0, 2) * q;
  dm[2] = -1.0;
  dm[3] = p(2, 1) * q;
  dm[4] = -p(2, 0) * q;
  dm[5] = 1.0;
  Turns holonomy = dm;
  holonomy[2] = holonomy[5] = 0.0;
  Matrix6 ddm = -0.5 * q * (dc * holonomy.transpose() + holonomy * dc.transpose());
  const double skew = 0.5 * q * (p(0, 1) - p(1, 0));
  const double trace = 0.5 * q * (p(0, 0) + p(1, 1));
  const auto pair = [&ddm](int i, int j, double v) {
    ddm(i, j) += v;
    ddm(j, i) += v;
  };
  pair(0, 3, skew);
  pair(0, 4, -trace);
  pair(1, 3, trace);
  pair(1, 4, skew);
  const double stiffness = material.twist_n_mm2 / material.span_mm;
  const double misfit = twist_rad - material.rest_twist_rad;
  out.energy_mj += 0.5 * stiffness * misfit * misfit;
  out.gradient += stiffness * misfit * dm;
  out.hessian += stiffness * (dm * dm.transpose() + misfit * ddm);
}

void add_kink(const JointMaterial& material, double c, const Turns& dc, const Matrix6& ddc,
              JointDerivatives& out) {
  if (!std::isfinite(material.kink_per_mm)) return;
  const double phi = std::acos(std::min(1.0, c));
  const KinkLaw law = kink_law(material, phi);
  if (law.value <= 0.0) return;
  out.kink_by_span_mj_per_mm = kink_by_span(law, phi, material.span_mm);
  const double sine = std::sin(phi);
  const double dphi = -1.0 / sine;
  const double ddphi = -c / (sine * sine * sine);
  out.energy_mj += law.value;
  out.gradient += law.first * dphi * dc;
  out.hessian +=
      (law.second * dphi * dphi + law.first * ddphi) * dc * dc.transpose() + law.first * dphi * ddc;
}

}  // namespace

double twist_between(const Frame& hand_side, const Frame& tip_side, double near_rad) {
  const double sine = hand_side.col(1).dot(tip_side.col(0)) - hand_side.col(0).dot(tip_side.col(1));
  const double cosine = hand_side.col(0).dot(tip_side.col(0)) + hand_side.col(1).dot(tip_side.col(1));
  const double angle = std::atan2(sine, cosine);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle + kTurn * std::round((near_rad - angle) / kTurn);
}

double joint_energy(const JointMaterial& material, const Frame& hand_side, const Frame& tip_side,
                    double twist_rad) {
  const double c = hand_side.col(2).dot(tip_side.col(2));
  if (!(c > -1.0)) return std::numeric_limits<double>::infinity();
  const double k = angle_factor(std::min(c, 1.0)).value;
  const Eigen::Vector2d hand(k * hand_side.col(0).dot(tip_side.col(2)),
                             k * hand_side.col(1).dot(tip_side.col(2)));
  const Eigen::Vector2d tip(-k * tip_side.col(0).dot(hand_side.col(2)),
                            -k * tip_side.col(1).dot(hand_side.col(2)));
  double energy = 0.0;
  for (int a = 0; a < 2; ++a) {
    const double m_hand = hand[a] - material.rest_bend_rad[a];
    const double m_tip = tip[a] - material.rest_bend_rad[a];
    energy += material.bend_n_mm2[a] / (4.0 * material.span_mm) * (m_hand * m_hand + m_tip * m_tip);
  }
  const double misfit = twist_rad - material.rest_twist_rad;
  energy += 0.5 * material.twist_n_mm2 / material.span_mm * misfit * misfit;
  if (std::isfinite(material.kink_per_mm)) energy += kink_law(material, std::acos(std::min(c, 1.0))).value;
  return energy;
}

void joint_derivatives(const JointMaterial& material, const Frame& hand_side, const Frame& tip_side,
                       double twist_rad, JointDerivatives& out) {
  out = JointDerivatives{};
  const Eigen::Matrix3d p = hand_side.transpose() * tip_side;
  const Eigen::Matrix3d pt = p.transpose();
  const double c = std::min(1.0, p(2, 2));
  Turns dc;
  dc << p(0, 2), p(1, 2), 0.0, p(2, 0), p(2, 1), 0.0;
  Matrix6 ddc = Matrix6::Zero();
  for (int a = 0; a < 2; ++a) {
    ddc(a, a) = ddc(3 + a, 3 + a) = -c;
    for (int b = 0; b < 2; ++b) ddc(a, 3 + b) = ddc(3 + b, a) = p(a, b);
  }
  const AngleFactor k = angle_factor(c);
  add_side(material, Side{p, 0, 3, 1.0}, k, dc, ddc, out);
  add_side(material, Side{pt, 3, 0, -1.0}, k, dc, ddc, out);
  const double bending_mj = out.energy_mj;
  add_twist(material, p, twist_rad, dc, out);
  out.twist_mj = out.energy_mj - bending_mj;
  add_kink(material, c, dc, ddc, out);
}

}  // namespace endowire::rod

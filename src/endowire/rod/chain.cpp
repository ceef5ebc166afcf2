#include "endowire/rod/chain.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/math/transport.hpp"
#include "endowire/rod/joint_blocks.hpp"

namespace endowire::rod {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// 1 g·m/s² = 1e-3 N.
constexpr double kGramMetreToNewton = 1e-3;

}  // namespace

namespace {

void reserve_frames(RodFrames& f, int rods) {
  f.frames.reserve(at(rods));
  f.spin_rad.reserve(at(rods));
  f.twist_rad.reserve(at(rods + 1));
}

void resize_frames(RodFrames& f, int rods) {
  f.frames.resize(at(rods), Frame::Identity());
  f.spin_rad.resize(at(rods), 0.0);
  f.twist_rad.resize(at(rods + 1), 0.0);
}

}  // namespace

void ChainShape::reserve(int rods) {
  joints_mm.reserve(at(rods + 1));
  reserve_frames(*this, rods);
  for (RodFrames& other : coaxial) reserve_frames(other, rods);
}

void ChainShape::resize(int rods) {
  joints_mm.resize(at(rods + 1), Eigen::Vector3d::Zero());
  resize_frames(*this, rods);
  for (RodFrames& other : coaxial) resize_frames(other, rods);
}

void ChainMaterial::reserve(int rods) {
  arc_mm.reserve(at(rods + 1));
  joints.reserve(at(rods + 1));
  length_mm.reserve(at(rods));
  stretch_n_per_mm.reserve(at(rods));
  weight_n.reserve(at(rods + 1));
}

void ChainMaterial::resize(int rods) {
  arc_mm.resize(at(rods + 1));
  joints.resize(at(rods + 1));
  length_mm.resize(at(rods));
  stretch_n_per_mm.resize(at(rods));
  weight_n.resize(at(rods + 1));
}

JointMaterial joint_material(const MaterialLine& line, double from_mm, double to_mm) {
  JointMaterial joint;
  joint.span_mm = to_mm - from_mm;
  joint.bend_n_mm2 = line.flexural_rigidities_n_mm2(from_mm, to_mm);
  joint.rest_bend_rad = line.rest_bend_rad(from_mm, to_mm);
  joint.twist_n_mm2 = line.torsional_rigidity_n_mm2(from_mm, to_mm);
  joint.kink_per_mm = line.kink_per_mm(from_mm, to_mm);
  return joint;
}

void fill_material(const MaterialLine& line, const std::vector<double>& arc_mm, double gravity_m_per_s2,
                   double fluid_density_g_per_mm3, ChainMaterial& material) {
  ENDOWIRE_EXPECTS(arc_mm.size() >= 3, "a chain has at least two rods");
  material.resize(static_cast<int>(arc_mm.size()) - 1);
  material.arc_mm.assign(arc_mm.begin(), arc_mm.end());
  ImmersedWire{&line, gravity_m_per_s2, fluid_density_g_per_mm3}.fill(0, material.rods(), material);
}

double ImmersedWire::weight_n(double from_mm, double to_mm) const {
  const double mass =
      line->mass_g(from_mm, to_mm) - fluid_density_g_per_mm3 * line->volume_mm3(from_mm, to_mm);
  return mass * gravity_m_per_s2 * kGramMetreToNewton;
}

void ImmersedWire::fill(int first, int last, ChainMaterial& material) const {
  const int rods = material.rods();
  const auto& arc = material.arc_mm;
  for (int i = std::max(0, first - 1); i < rods && i <= last; ++i) {
    material.length_mm[at(i)] = arc[at(i + 1)] - arc[at(i)];
    material.stretch_n_per_mm[at(i)] =
        line->axial_rigidity_n(arc[at(i)], arc[at(i + 1)]) / material.length_mm[at(i)];
  }
  for (int j = std::max(0, first - 1); j <= rods && j <= last + 1; ++j) {
    const double from = j == 0 ? arc[0] : 0.5 * (arc[at(j - 1)] + arc[at(j)]);
    const double to = j == rods ? arc[at(rods)] : 0.5 * (arc[at(j)] + arc[at(j + 1)]);
    material.weight_n[at(j)] = weight_n(from, to);
    material.joints[at(j)] = joint_material(*line, from, to);
  }
}

double axial_force_n(const ChainMaterial& material, const ChainShape& shape, int rod) {
  const double length = (shape.joints_mm[at(rod)] - shape.joints_mm[at(rod + 1)]).norm();
  return material.stretch_n_per_mm[at(rod)] * (length - material.length_mm[at(rod)]);
}

namespace {

/// A sum of energies with that of an instrument's joints, from its first on, added.
double with_joints(double energy, const std::vector<JointMaterial>& joints, int first, const RodFrames& f) {
  for (int j = first; j < static_cast<int>(f.frames.size()); ++j) {
    const JointMaterial& joint = joints[at(j)];
    const Frame& hand_side = f.frames[at(j)];
    const Frame& tip_side = f.frames[at(j - 1)];
    energy += is_straight(joint, {hand_side, tip_side})
                  ? straight_joint_energy(joint, hand_side, tip_side, f.twist_rad[at(j)])
                  : joint_energy(joint, hand_side, tip_side, f.twist_rad[at(j)]);
  }
  return energy;
}

}  // namespace

double chain_energy(const ChainMaterial& material, const ChainShape& shape) {
  ENDOWIRE_EXPECTS(material.coaxial.size() == shape.coaxial.size(), "one material per instrument");
  const int rods = shape.rods();
  double energy = 0.0;
  for (int i = 0; i < rods; ++i) {
    const double stretch =
        (shape.joints_mm[at(i)] - shape.joints_mm[at(i + 1)]).norm() - material.length_mm[at(i)];
    energy += 0.5 * material.stretch_n_per_mm[at(i)] * stretch * stretch;
  }
  energy = with_joints(energy, material.joints, 1, shape);
  for (std::size_t k = 0; k < shape.coaxial.size(); ++k) {
    const CoaxialMaterial& other = material.coaxial[k];
    energy = with_joints(energy, other.joints, other.first_joint, shape.coaxial[k]);
  }
  return energy;
}

namespace {

/// Where the unknowns of an instrument's joint lie.
struct Place {
  int first;   ///< unknown of the joint on the tip's side
  int stride;  ///< unknowns per joint
  int spin;    ///< place of the instrument's spin among them
};

/// Lays a joint's derivatives onto the unknowns of the joints before, at and after it: tᵉ = x_j − x_{j+1}, tᶠ = x_{j−1} − x_j.
void add_joint(const JointBlocks& d, const Place& place, math::BandMatrix& hessian,
               std::vector<double>& gradient) {
  const Eigen::Matrix3d middle = d.hand_hand - d.hand_tip - d.hand_tip.transpose() + d.tip_tip;
  const int tip = place.first;
  const int own = tip + place.stride;
  const int hand = own + place.stride;
  const int tip_spin = tip + place.spin;
  const int hand_spin = own + place.spin;
  for (int r = 0; r < 3; ++r) {
    gradient[at(tip + r)] += d.tip[r];
    gradient[at(own + r)] += d.hand[r] - d.tip[r];
    gradient[at(hand + r)] -= d.hand[r];
    for (int c = 0; c <= r; ++c) {
      hessian.lower(tip + r, tip + c) += d.tip_tip(r, c);
      hessian.lower(own + r, own + c) += middle(r, c);
      hessian.lower(hand + r, hand + c) += d.hand_hand(r, c);
    }
    for (int c = 0; c < 3; ++c) {
      hessian.lower(own + r, tip + c) += d.hand_tip(r, c) - d.tip_tip(r, c);
      hessian.lower(hand + r, own + c) += d.hand_tip(r, c) - d.hand_hand(r, c);
      hessian.lower(hand + r, tip + c) -= d.hand_tip(r, c);
    }
    hessian.lower(tip_spin, tip + r) += d.tip_by_tip_spin[r];
    hessian.lower(own + r, tip_spin) += d.hand_by_tip_spin[r] - d.tip_by_tip_spin[r];
    hessian.lower(hand + r, tip_spin) -= d.hand_by_tip_spin[r];
    hessian.lower(hand_spin, tip + r) += d.tip_by_hand_spin[r];
    hessian.lower(hand_spin, own + r) += d.hand_by_hand_spin[r] - d.tip_by_hand_spin[r];
    hessian.lower(hand + r, hand_spin) -= d.hand_by_hand_spin[r];
  }
  gradient[at(tip_spin)] += d.tip_spin;
  gradient[at(hand_spin)] += d.hand_spin;
  hessian.lower(tip_spin, tip_spin) += d.tip_spin_twice;
  hessian.lower(hand_spin, tip_spin) += d.spins;
  hessian.lower(hand_spin, hand_spin) += d.hand_spin_twice;
}

double add_stretch(double stiffness, double rest_length, double geometric_force, const Eigen::Vector3d& t,
                   int first, math::BandMatrix& hessian, std::vector<double>& gradient) {
  const int next = first + hessian.block();
  const double length = t.norm();
  const Eigen::Vector3d e = t / length;
  const double force = stiffness * (length - rest_length);
  const double turning = geometric_force / length;
  const Eigen::Matrix3d h = (stiffness - turning) * e * e.transpose() + turning * Eigen::Matrix3d::Identity();
  for (int r = 0; r < 3; ++r) {
    gradient[at(first + r)] += force * e[r];
    gradient[at(next + r)] -= force * e[r];
    for (int c = 0; c <= r; ++c) {
      hessian.lower(first + r, first + c) += h(r, c);
      hessian.lower(next + r, next + c) += h(r, c);
    }
    for (int c = 0; c < 3; ++c) hessian.lower(next + r, first + c) -= h(r, c);
  }
  return 0.5 * force * (length - rest_length);
}

}  // namespace

namespace {

double add_instrument(const std::vector<JointMaterial>& joints, int first, const RodFrames& f,
                      const std::vector<Eigen::Vector3d>& joints_mm, int spin, math::BandMatrix& hessian,
                      std::vector<double>& gradient) {
  double energy = 0.0;
  JointDerivatives general;
  JointBlocks d;
  double hand_length = (joints_mm[at(first - 1)] - joints_mm[at(first)]).norm();
  for (int j = first; j < static_cast<int>(f.frames.size()); ++j) {
    const double tip_length = hand_length;
    hand_length = (joints_mm[at(j)] - joints_mm[at(j + 1)]).norm();
    const JointRods pair{f.frames[at(j)], f.frames[at(j - 1)], hand_length, tip_length};
    if (is_straight(joints[at(j)], pair)) {
      straight_joint(joints[at(j)], pair, f.twist_rad[at(j)], d);
    } else {
      joint_derivatives(joints[at(j)], pair.hand_side, pair.tip_side, f.twist_rad[at(j)], general);
      blocks_of(general, pair, d);
    }
    add_joint(d, {hessian.block() * (j - 1), hessian.block(), spin}, hessian, gradient);
    energy += d.energy_mj;
  }
  return energy;
}

}  // namespace

double add_joint_derivatives(const ChainMaterial& material, const ChainShape& shape,
                             math::BandMatrix& hessian, std::vector<double>& gradient) {
  ENDOWIRE_EXPECTS(hessian.block() == shape.unknowns_per_joint(), "a place for every spin");
  double energy = add_instrument(material.joints, 1, shape, shape.joints_mm, 3, hessian, gradient);
  for (std::size_t k = 0; k < shape.coaxial.size(); ++k) {
    energy += add_instrument(material.coaxial[k].joints, material.coaxial[k].first_joint, shape.coaxial[k],
                             shape.joints_mm, 4 + static_cast<int>(k), hessian, gradient);
  }
  return energy;
}

double add_stretch_derivatives(const ChainMaterial& material, const ChainShape& shape,
                               const std::vector<double>& geometric_force_n, math::BandMatrix& hessian,
                               std::vector<double>& gradient) {
  double energy = 0.0;
  for (int i = 0; i < shape.rods(); ++i) {
    energy += add_stretch(material.stretch_n_per_mm[at(i)], material.length_mm[at(i)],
                          geometric_force_n[at(i)], shape.joints_mm[at(i)] - shape.joints_mm[at(i + 1)],
                          hessian.block() * i, hessian, gradient);
  }
  return energy;
}

void TridiagonalScratch::reserve(int rods) {
  for (auto* v : {&diagonal, &off, &rhs}) v->reserve(at(rods));
}

void TridiagonalScratch::resize(int rods) {
  for (auto* v : {&diagonal, &off, &rhs}) v->resize(at(rods));
}

namespace {

/// Solves the symmetric tridiagonal system in scratch: diagonal, off (entry i couples i − 1 and i), rhs → rhs.
void solve_tridiagonal(TridiagonalScratch& s) {
  const int n = static_cast<int>(s.rhs.size());
  for (int i = 1; i < n; ++i) {
    const double factor = s.off[at(i)] / s.diagonal[at(i - 1)];
    s.diagonal[at(i)] -= factor * s.off[at(i)];
    s.rhs[at(i)] -= factor * s.rhs[at(i - 1)];
  }
  for (int i = n - 1; i >= 0; --i) {
    if (i + 1 < n) s.rhs[at(i)] -= s.off[at(i + 1)] * s.rhs[at(i + 1)];
    s.rhs[at(i)] /= s.diagonal[at(i)];
  }
}

}  // namespace

void geometric_force_n(const ChainMaterial& material, const ChainShape& shape,
                       const std::vector<double>& gradient, const std::vector<char>& held,
                       TridiagonalScratch& s, std::vector<double>& out) {
  const int rods = shape.rods();
  s.resize(rods);
  out.resize(at(rods));
  const int stride = shape.unknowns_per_joint();
  const auto free_part = [&](int joint, const Eigen::Vector3d& v) {
    const char* fixed = held.data() + stride * joint;
    return Eigen::Vector3d(fixed[0] ? 0.0 : v[0], fixed[1] ? 0.0 : v[1], fixed[2] ? 0.0 : v[2]);
  };
  const auto force_on = [&](int joint) {
    return free_part(joint, Eigen::Map<const Eigen::Vector3d>(gradient.data() + stride * joint));
  };
  for (int i = 0; i < rods; ++i) {
    const Eigen::Vector3d e = shape.frames[at(i)].col(2);
    const Eigen::Vector3d tip = free_part(i, e);
    s.diagonal[at(i)] = tip.dot(e) + free_part(i + 1, e).dot(e);
    s.rhs[at(i)] = -e.dot(force_on(i) - force_on(i + 1));
    s.off[at(i)] = i == 0 ? 0.0 : -tip.dot(shape.frames[at(i - 1)].col(2));
    if (!(s.diagonal[at(i)] > 1e-6)) {
      s.diagonal[at(i)] = 1.0;
      s.rhs[at(i)] = 0.0;
      s.off[at(i)] = 0.0;
    }
  }
  solve_tridiagonal(s);
  for (int i = 0; i < rods; ++i) {
    const double present = axial_force_n(material, shape, i);
    const double balancing = s.rhs[at(i)];
    out[at(i)] = present * balancing <= 0.0                ? 0.0
                 : std::abs(present) < std::abs(balancing) ? present
                                                           : balancing;
  }
}

namespace {

/// Turns the rods of `out` so that the held coordinates of its tip come to `wanted`: each direction moves by
/// w (I − e eᵀ) λ with w growing from 0 at the hand to 1 at the tip, λ from three linear equations, repeated.
bool close_tip(const Eigen::Vector3d& wanted, const std::array<bool, 3>& held, ChainShape& out) {
  const int rods = out.rods();
  constexpr int kSweeps = 20;
  constexpr double kTolerance_mm = 1e-12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    Eigen::Vector3d miss = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3; ++c) miss[c] = held[at(c)] ? wanted[c] - out.joints_mm[0][c] : 0.0;
    if (miss.norm() <= kTolerance_mm * (1.0 + wanted.norm())) return true;
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    const auto weight = [&](int i) { return static_cast<double>(rods - 1 - i) / rods; };
    for (int i = 0; i < rods; ++i) {
      const Eigen::Vector3d t = out.joints_mm[at(i)] - out.joints_mm[at(i + 1)];
      m += weight(i) * t.norm() * (Eigen::Matrix3d::Identity() - t * t.transpose() / t.squaredNorm());
    }
    for (int c = 0; c < 3; ++c) {
      if (held[at(c)]) continue;
      m.row(c).setZero();
      m.col(c).setZero();
      m(c, c) = 1.0;
    }
    const Eigen::Vector3d lambda = m.ldlt().solve(miss);
    Eigen::Vector3d old = out.joints_mm[at(rods)];
    for (int i = rods - 1; i >= 0; --i) {
      const Eigen::Vector3d t = out.joints_mm[at(i)] - old;
      const double length = t.norm();
      const Eigen::Vector3d e = t / length;
      old = out.joints_mm[at(i)];
      out.joints_mm[at(i)] =
          out.joints_mm[at(i + 1)] + length * (e + weight(i) * (lambda - e * e.dot(lambda))).normalized();
    }
  }
  return false;
}

}  // namespace

namespace {

/// Carries the frames of an instrument to the joints of `out` and turns them by their spins.
/// @param spins  of the first rod, those of the others `stride` apart
bool carry_frames(const RodFrames& base, const double* spins, int stride, double alpha,
                  const std::vector<Eigen::Vector3d>& joints_mm, RodFrames& out) {
  const int rods = static_cast<int>(base.frames.size());
  for (int i = 0; i < rods; ++i) {
    const Frame& old = base.frames[at(i)];
    const Eigen::Vector3d e = (joints_mm[at(i)] - joints_mm[at(i + 1)]).normalized();
    if (!(e.dot(old.col(2)) > -0.5)) return false;
    const double spin = alpha * spins[stride * i];
    Eigen::Vector3d m1 = math::parallel_transport(old.col(0), old.col(2), e);
    m1 = math::normal_part(math::spin_about(m1, e, spin), e);
    out.frames[at(i)].col(0) = m1;
    out.frames[at(i)].col(1) = e.cross(m1);
    out.frames[at(i)].col(2) = e;
    out.spin_rad[at(i)] = base.spin_rad[at(i)] + spin;
  }
  // Those at the ends mean nothing, but they belong to the state and its hash.
  out.twist_rad[0] = base.twist_rad[0];
  out.twist_rad[at(rods)] = base.twist_rad[at(rods)];
  for (int j = 1; j < rods; ++j) {
    const double spun_tip = out.spin_rad[at(j - 1)] - base.spin_rad[at(j - 1)];
    const double spun_hand = out.spin_rad[at(j)] - base.spin_rad[at(j)];
    out.twist_rad[at(j)] =
        twist_between(out.frames[at(j)], out.frames[at(j - 1)], base.twist_rad[at(j)] + spun_tip - spun_hand);
  }
  return true;
}

}  // namespace

bool retract(const ChainShape& base, const std::vector<double>& direction, double alpha,
             const std::array<bool, 3>& tip_held, ChainShape& out) {
  const int rods = base.rods();
  const int stride = base.unknowns_per_joint();
  out.coaxial.resize(base.coaxial.size());
  out.resize(rods);
  const auto step = [&](int joint) {
    return Eigen::Vector3d(alpha * Eigen::Map<const Eigen::Vector3d>(direction.data() + stride * joint));
  };
  out.joints_mm[at(rods)] = base.joints_mm[at(rods)] + step(rods);
  for (int i = rods - 1; i >= 0; --i) {
    const Eigen::Vector3d t = base.joints_mm[at(i)] - base.joints_mm[at(i + 1)];
    const Eigen::Vector3d moved = step(i) - step(i + 1);
    const double length = t.norm() + t.dot(moved) / t.norm();
    const Eigen::Vector3d turned = t + moved;
    if (!(length > 0.5 * t.norm()) || !(turned.dot(t) > 0.0)) return false;
    out.joints_mm[at(i)] = out.joints_mm[at(i + 1)] + length * turned.normalized();
  }
  if ((tip_held[0] || tip_held[1] || tip_held[2]) && !close_tip(base.joints_mm[0] + step(0), tip_held, out))
    return false;

  const double* spins = direction.data() + 3;
  if (!carry_frames(base, spins, stride, alpha, out.joints_mm, out)) return false;
  for (const RodFrames& other : base.coaxial) {
    RodFrames& moved = out.coaxial[at(static_cast<int>(&other - base.coaxial.data()))];
    if (!carry_frames(other, ++spins, stride, alpha, out.joints_mm, moved)) return false;
  }
  return true;
}

}  // namespace endowire::rod

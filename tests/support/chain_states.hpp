#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "endowire/math/band_ldlt.hpp"
#include "endowire/math/transport.hpp"
#include "endowire/rod/chain.hpp"
#include "support/frames.hpp"

namespace endowire::test {

/// Joints at equal arcs 0, l, 2l, …
inline std::vector<double> even_arcs(int rods, double rod_length_mm) {
  std::vector<double> arcs;
  for (int i = 0; i <= rods; ++i) arcs.push_back(i * rod_length_mm);
  return arcs;
}

/// A straight untwisted chain from `hand_mm` along the unit `direction`.
inline rod::ChainShape straight_chain(const std::vector<double>& arcs, const Eigen::Vector3d& hand_mm,
                                      const Eigen::Vector3d& direction) {
  rod::ChainShape shape;
  const int rods = static_cast<int>(arcs.size()) - 1;
  shape.resize(rods);
  rod::Frame frame;
  frame.col(2) = direction;
  frame.col(0) = math::any_normal(direction);
  frame.col(1) = direction.cross(frame.col(0));
  for (std::size_t i = 0; i < arcs.size(); ++i)
    shape.joints_mm[i] = hand_mm + (arcs.back() - arcs[i]) * direction;
  for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
    shape.frames[i] = frame;
    shape.spin_rad[i] = 0.0;
  }
  for (double& twist : shape.twist_rad) twist = 0.0;
  return shape;
}

/// The frames of an instrument on a chain moved by h·d: transported to the new tangents and spun.
/// @param spin  place of the instrument's spin among the unknowns of a joint, `stride` of them
inline void move_frames(const std::vector<Eigen::Vector3d>& joints_mm, const std::vector<double>& d, double h,
                        std::size_t stride, std::size_t spin, rod::RodFrames& f) {
  const rod::RodFrames old = f;
  const std::size_t rods = old.frames.size();
  for (std::size_t i = 0; i < rods; ++i) {
    const Eigen::Vector3d e = (joints_mm[i] - joints_mm[i + 1]).normalized();
    const rod::Frame& from = old.frames[i];
    const double turn = h * d[stride * i + spin];
    const Eigen::Vector3d m1 = math::normal_part(
        math::spin_about(math::parallel_transport(from.col(0), from.col(2), e), e, turn), e);
    f.frames[i].col(0) = m1;
    f.frames[i].col(1) = e.cross(m1);
    f.frames[i].col(2) = e;
    f.spin_rad[i] += turn;
  }
  for (std::size_t j = 1; j < rods; ++j) {
    const double turned = h * (d[stride * (j - 1) + spin] - d[stride * j + spin]);
    f.twist_rad[j] = rod::twist_between(f.frames[j], f.frames[j - 1], old.twist_rad[j] + turned);
  }
}

/// A chain moved along straight lines in its unknowns: joints by h·d, frames transported to the new tangents
/// and spun by h·dθ. Along these curves the derivatives of a chain are defined.
inline rod::ChainShape moved_chain(const rod::ChainShape& base, const std::vector<double>& d, double h) {
  rod::ChainShape out = base;
  const auto stride = static_cast<std::size_t>(base.unknowns_per_joint());
  for (std::size_t i = 0; i < out.joints_mm.size(); ++i)
    out.joints_mm[i] += h * Eigen::Map<const Eigen::Vector3d>(d.data() + stride * i);
  move_frames(out.joints_mm, d, h, stride, 3, out);
  for (std::size_t k = 0; k < out.coaxial.size(); ++k)
    move_frames(out.joints_mm, d, h, stride, 4 + k, out.coaxial[k]);
  return out;
}

/// A bent, twisted, slightly stretched chain: each rod turns from the one before it by about `bend_rad`.
inline rod::ChainShape random_chain(const std::vector<double>& arcs, double bend_rad, double twist_rad,
                                    double stretch, Random& random) {
  rod::ChainShape shape;
  const auto rods = arcs.size() - 1;
  shape.resize(static_cast<int>(rods));
  rod::Frame frame = random.frame();
  shape.joints_mm[rods] = random.vector();
  for (std::size_t i = rods; i-- > 0;) {
    if (i + 1 < rods) {
      Eigen::Vector3d turn = random.vector();
      turn = turn.cwiseProduct(Eigen::Vector3d(bend_rad, bend_rad, twist_rad));
      frame = moved(frame, turn);
    }
    shape.frames[i] = frame;
    const double length = (arcs[i + 1] - arcs[i]) * (1.0 + stretch * random.normal());
    shape.joints_mm[i] = shape.joints_mm[i + 1] + length * frame.col(2);
    shape.spin_rad[i] = random.normal();
  }
  for (std::size_t j = 1; j < rods; ++j) {
    shape.twist_rad[j] = rod::twist_between(shape.frames[j], shape.frames[j - 1], 0.0);
  }
  return shape;
}

/// A direction in all unknowns of a chain.
inline std::vector<double> random_direction(std::size_t unknowns, Random& random) {
  std::vector<double> d(unknowns);
  for (double& v : d) v = random.normal();
  return d;
}

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// vᵀHv
inline double quadratic(math::BandMatrix& hessian, const std::vector<double>& v) {
  std::vector<double> hv(v.size());
  hessian.multiply(v, hv);
  return dot(v, hv);
}

}  // namespace endowire::test

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

/// A chain moved along straight lines in its unknowns: joints by h·d, frames transported to the new tangents
/// and spun by h·dθ. Along these curves the derivatives of a chain are defined.
inline rod::ChainShape moved_chain(const rod::ChainShape& base, const std::vector<double>& d, double h) {
  rod::ChainShape out = base;
  const auto rods = static_cast<std::size_t>(base.rods());
  for (std::size_t i = 0; i <= rods; ++i)
    out.joints_mm[i] += h * Eigen::Map<const Eigen::Vector3d>(d.data() + 4 * i);
  for (std::size_t i = 0; i < rods; ++i) {
    const Eigen::Vector3d e = (out.joints_mm[i] - out.joints_mm[i + 1]).normalized();
    const rod::Frame& old = base.frames[i];
    const double spin = h * d[4 * i + 3];
    const Eigen::Vector3d m1 =
        math::normal_part(math::spin_about(math::parallel_transport(old.col(0), old.col(2), e), e, spin), e);
    out.frames[i].col(0) = m1;
    out.frames[i].col(1) = e.cross(m1);
    out.frames[i].col(2) = e;
    out.spin_rad[i] += spin;
  }
  for (std::size_t j = 1; j < rods; ++j) {
    out.twist_rad[j] = rod::twist_between(out.frames[j], out.frames[j - 1],
                                          base.twist_rad[j] + h * (d[4 * j - 1] - d[4 * j + 3]));
  }
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

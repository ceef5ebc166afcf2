#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "endowire/math/transport.hpp"
#include "endowire/rod/joint_energy.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::test {

/// Approximately normal numbers, the same on every platform: twelve uniform ones, summed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : mix_(seed) {}
  double uniform(double low, double high) { return mix_.uniform(low, high); }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += mix_.uniform();
    return sum;
  }
  Eigen::Vector3d vector() {
    const double x = normal();
    const double y = normal();
    return {x, y, normal()};
  }
  Eigen::Vector3d unit() { return vector().normalized(); }
  rod::Frame frame() {
    const double w = normal();
    const Eigen::Vector3d v = vector();
    return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  }

 private:
  vessel::SplitMix mix_;
};

/// A frame moved as the derivatives of a joint mean it: the tangent along the great arc of (w₁ m₁ + w₂ m₂) by its
/// length, the directors transported in parallel, then spun by w₃.
inline rod::Frame moved(const rod::Frame& frame, const Eigen::Vector3d& w) {
  const Eigen::Vector3d arc = w[0] * frame.col(0) + w[1] * frame.col(1);
  const double angle = arc.norm();
  const Eigen::Vector3d from = frame.col(2);
  Eigen::Vector3d to = from;
  if (angle > 0.0) to = std::cos(angle) * from + std::sin(angle) / angle * arc;
  to.normalize();
  rod::Frame out;
  out.col(0) =
      math::normal_part(math::spin_about(math::parallel_transport(frame.col(0), from, to), to, w[2]), to);
  out.col(1) = to.cross(out.col(0));
  out.col(2) = to;
  return out;
}

/// How far a frame is from orthonormal and right-handed.
inline double frame_error(const rod::Frame& frame) {
  return (frame.transpose() * frame - rod::Frame::Identity()).norm() + std::abs(frame.determinant() - 1.0);
}

}  // namespace endowire::test

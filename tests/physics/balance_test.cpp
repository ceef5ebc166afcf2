// V16: the internal forces and moments of a chain sum to zero on any shape.
//
// Its energy does not change when all of it moves or turns. Moved by a: δx = a. Turned by ω: δx = ω × x and every rod spins by ω·e,
// since its frame would keep from spinning under transport alone. Hence
//
//   Σ gᵢ = 0,   Σ xᵢ × gᵢ + Σ γᵢ eᵢ = 0,   g = ∂E/∂x, γ = ∂E/∂spin
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "support/chains.hpp"

namespace endowire::test {
namespace {

/// A bent, twisted, stretched chain of an anisotropic, pre-curved and pre-twisted wire, some of it beyond its kink curvature.
void disturb(Chain& chain, std::mt19937& random) {
  const auto uniform = [&](double range) {
    return range * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
  };
  sim::ChainProblem& problem = chain.problem;
  std::vector<Eigen::Vector3d> joints = problem.shape.joints_mm;
  const Eigen::Vector3d origin(50.0, -30.0, 20.0);
  for (Eigen::Vector3d& x : joints) x += origin + Eigen::Vector3d(uniform(0.3), uniform(0.6), uniform(0.6));
  chain.lay_untwisted(joints);
  for (int i = 0; i < problem.shape.rods(); ++i) chain.spin(i, uniform(1.0));
  for (rod::JointMaterial& joint : problem.material.joints) {
    joint.bend_n_mm2 *= 1.0 + uniform(0.5);
    joint.bend_n_mm2[1] *= 1.0 + uniform(0.5);
    joint.rest_bend_rad = {uniform(0.2), uniform(0.2)};
    joint.rest_twist_rad = uniform(0.3);
    joint.kink_per_mm = 0.1 + std::abs(uniform(1.0));
  }
}

TEST(V16Balance, InternalForcesAndMomentsSumToZero) {
  constexpr int kChainRods = 30;
  std::mt19937 random(7);
  for (int shape_number = 0; shape_number < 20; ++shape_number) {
    Chain chain(uniform_wire(10.0, 100.0), kChainRods, 1.5);
    disturb(chain, random);
    const rod::ChainShape& shape = chain.problem.shape;
    math::BandMatrix hessian;
    hessian.resize(4 * (kChainRods + 1));
    hessian.set_zero();
    std::vector<double> gradient(4 * (kChainRods + 1), 0.0);
    rod::add_joint_derivatives(chain.problem.material, shape, hessian, gradient);
    double bending_n = 0.0;  // the stretch, far stiffer, must not hide an imbalance of the rest
    for (int pass = 0; pass < 2; ++pass) {
      Eigen::Vector3d force = Eigen::Vector3d::Zero();
      Eigen::Vector3d moment = Eigen::Vector3d::Zero();
      double force_size = 0.0;
      double moment_size = 0.0;
      for (std::size_t i = 0; i <= kChainRods; ++i) {
        const Eigen::Vector3d g(gradient[4 * i], gradient[4 * i + 1], gradient[4 * i + 2]);
        force += g;
        moment += shape.joints_mm[i].cross(g);
        force_size += g.norm();
        moment_size += shape.joints_mm[i].norm() * g.norm();
        if (i == kChainRods) continue;
        moment += gradient[4 * i + 3] * shape.frames[i].col(2);
        moment_size += std::abs(gradient[4 * i + 3]);
      }
      constexpr double kRounding = 1e3 * std::numeric_limits<double>::epsilon();
      EXPECT_GT(force_size, 1.0);
      EXPECT_LT(force.norm(), kRounding * force_size) << "shape " << shape_number << " pass " << pass;
      EXPECT_LT(moment.norm(), kRounding * moment_size) << "shape " << shape_number << " pass " << pass;
      if (pass == 1) {
        EXPECT_GT(force_size, bending_n);  // the stretch did take part
        break;
      }
      bending_n = force_size;
      const std::vector<double> none(kChainRods, 0.0);
      rod::add_stretch_derivatives(chain.problem.material, shape, none, hessian, gradient);
    }
  }
}

}  // namespace
}  // namespace endowire::test

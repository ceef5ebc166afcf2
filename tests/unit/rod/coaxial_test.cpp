// Instruments that share a centreline: energies that add, derivatives in all unknowns, what a joint of each is made of.
#include "endowire/rod/coaxial.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "support/chain_states.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double kGravity_m_per_s2 = 9.81;

/// A wire with a curved tip, a second around all of it, and a third that ends behind its tip.
class Bundle : public testing::Test {
 protected:
  Bundle()
      : arcs_{0.0, 1.5, 3.0, 5.5, 8.0, 12.0, 14.0, 19.0, 22.0, 26.0},
        first_(test::curved_tip_wire()),
        second_(test::hydrophilic_035_angled()) {
    fill_material(first_, arcs_, kGravity_m_per_s2, 1e-3, material_);
    alone_ = material_;
    add_coaxial({&second_, kGravity_m_per_s2, 0.0}, 0.0, material_);
    add_coaxial({&second_, kGravity_m_per_s2, 0.0}, kBehind_mm, material_);
  }

  /// Each instrument twisted in its own way.
  ChainShape state(std::uint64_t seed) const {
    test::Random random(seed);
    ChainShape shape = test::random_chain(arcs_, 0.2, 0.2, 1e-3, random);
    for (const double turned_rad : {0.7, -1.9}) add_coaxial_frames(turned_rad, shape);
    std::vector<double> spins(unknowns(), 0.0);
    for (std::size_t i = 0; i < spins.size(); ++i)
      if (i % 6 > 3) spins[i] = random.normal();
    return test::moved_chain(shape, spins, 0.2);
  }
  std::size_t unknowns() const { return 6 * arcs_.size(); }

  double derivatives(const ChainShape& shape, math::BandMatrix& hessian,
                     std::vector<double>& gradient) const {
    hessian.resize(static_cast<int>(unknowns()), shape.unknowns_per_joint());
    hessian.set_zero();
    gradient.assign(unknowns(), 0.0);
    std::vector<double> force;
    for (int i = 0; i < shape.rods(); ++i) force.push_back(axial_force_n(material_, shape, i));
    return add_joint_derivatives(material_, shape, hessian, gradient) +
           add_stretch_derivatives(material_, shape, force, hessian, gradient);
  }

  static constexpr double kBehind_mm = 4.25;  // in the middle of rod 2
  std::vector<double> arcs_;
  MaterialLine first_, second_;
  ChainMaterial alone_, material_;
};

TEST_F(Bundle, ItsEnergyIsThatOfEachInstrumentInItsOwnFrames) {
  const ChainShape shape = state(1);
  double sum = 0.0;
  for (int k = -1; k < 2; ++k) {
    ChainShape one = shape;
    one.coaxial.clear();
    ChainMaterial of_one = alone_;
    if (k >= 0) {
      const auto i = static_cast<std::size_t>(k);
      static_cast<RodFrames&>(one) = shape.coaxial[i];
      of_one.joints = material_.coaxial[i].joints;
      for (int j = 0; j < material_.coaxial[i].first_joint; ++j)
        of_one.joints[static_cast<std::size_t>(j)] = JointMaterial{};  // no stiffness at all
    }
    std::fill(of_one.stretch_n_per_mm.begin(), of_one.stretch_n_per_mm.end(), 0.0);
    sum += chain_energy(of_one, one);
  }
  ChainMaterial unstretched = material_;
  std::fill(unstretched.stretch_n_per_mm.begin(), unstretched.stretch_n_per_mm.end(), 0.0);
  EXPECT_NEAR(chain_energy(unstretched, shape), sum, 1e-12 * sum);
}

TEST_F(Bundle, TaylorSlopes) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const ChainShape base = state(seed);
    math::BandMatrix hessian;
    std::vector<double> gradient;
    const double energy = derivatives(base, hessian, gradient);
    EXPECT_NEAR(energy, chain_energy(material_, base), 1e-12 * (1.0 + energy));
    test::Random random(100 + seed);
    const std::vector<double> all = test::random_direction(unknowns(), random);
    for (std::size_t spin = 3; spin < 6; ++spin) {  // the stretch, which is much larger, would hide the spins
      std::vector<double> d = all;
      for (std::size_t i = 0; i < d.size(); ++i)
        if (i % 6 != spin) d[i] = 0.0;
      test::expect_taylor([&](double h) { return chain_energy(material_, test::moved_chain(base, d, h)); },
                          test::dot(gradient, d), test::quadratic(hessian, d), energy,
                          "spin " + std::to_string(spin), 1e-2);
    }
    const double curvature = test::quadratic(hessian, all);
    test::expect_taylor([&](double h) { return chain_energy(material_, test::moved_chain(base, all, h)); },
                        test::dot(gradient, all), curvature, energy + std::abs(curvature), "all", 1e-3);
  }
}

// Breaks with an entry in the wrong place of the band.
TEST_F(Bundle, HessianIsTheSymmetricPartOfTheDifferencedGradient) {
  const ChainShape base = state(7);
  math::BandMatrix hessian;
  std::vector<double> gradient;
  derivatives(base, hessian, gradient);
  const auto n = static_cast<Eigen::Index>(unknowns());
  MatrixXd exact = MatrixXd::Zero(n, n);
  MatrixXd differenced = MatrixXd::Zero(n, n);
  constexpr double kStep = 1e-5;
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<double> unit(unknowns(), 0.0);
    unit[static_cast<std::size_t>(j)] = 1.0;
    math::BandMatrix unused;
    std::vector<double> ahead, behind;
    derivatives(test::moved_chain(base, unit, kStep), unused, ahead);
    derivatives(test::moved_chain(base, unit, -kStep), unused, behind);
    std::vector<double> column(unknowns());
    hessian.multiply(unit, column);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      exact(i, j) = column[k];
      differenced(i, j) = (ahead[k] - behind[k]) / (2.0 * kStep);
    }
  }
  const MatrixXd symmetric = 0.5 * (differenced + differenced.transpose());
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double scale = 1.0 + std::sqrt(std::abs(exact(i, i) * exact(j, j)));
      ASSERT_NEAR(symmetric(i, j), exact(i, j), 2e-5 * scale) << i << " " << j;
    }
  }
}

// Breaks when an instrument that ends behind the tip is counted from the tip of the chain.
TEST_F(Bundle, AJointIsMadeOfWhatOfEachInstrumentIsThere) {
  const CoaxialMaterial& third = material_.coaxial[1];
  ASSERT_EQ(third.first_joint, 3);
  const JointMaterial direct = joint_material(second_, 0.0, 6.75 - kBehind_mm);  // its first half rods
  const JointMaterial& joint = third.joints[3];
  EXPECT_DOUBLE_EQ(joint.span_mm, direct.span_mm);
  EXPECT_DOUBLE_EQ(joint.bend_n_mm2[0], direct.bend_n_mm2[0]);
  EXPECT_DOUBLE_EQ(joint.rest_bend_rad[0], direct.rest_bend_rad[0]);
  double added_n = 0.0;
  for (std::size_t i = 0; i < arcs_.size(); ++i) added_n += material_.weight_n[i] - alone_.weight_n[i];
  EXPECT_NEAR(added_n,
              1e-3 * kGravity_m_per_s2 * (second_.mass_g(0.0, 26.0) + second_.mass_g(0.0, 26.0 - kBehind_mm)),
              1e-12);
  EXPECT_EQ(material_.weight_n[0] - alone_.weight_n[0], 1e-3 * kGravity_m_per_s2 * second_.mass_g(0.0, 0.75))
      << "the third does not reach the tip";
}

TEST_F(Bundle, EndsInTheMiddleOfARodOnly) {
  EXPECT_DOUBLE_EQ(nearest_rod_middle_mm(material_, 4.4), kBehind_mm);
  EXPECT_THROW(add_coaxial({&second_, 0.0, 0.0}, 4.4, material_), base::ContractError);
}

}  // namespace
}  // namespace endowire::rod

// Energy of a whole chain in the unknowns of the solver: joints and spins, frames transported along straight lines.
#include "endowire/rod/chain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>
#include <ostream>

#include "support/chain_states.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Case {
  std::string name;
  double bend_rad, twist_rad, stretch;
  bool kinked;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class ChainStates : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    Instrument wire = test::curved_tip_wire();
    if (GetParam().kinked) {
      for (Section& s : wire.sections) s.kink_curvature_per_mm = 0.08;
    }
    const MaterialLine line(wire);
    // Non-uniform rods: a border that takes the length of the wrong rod shows.
    arcs_ = {0.0, 1.5, 3.0, 5.5, 8.0, 12.0, 14.0, 19.0, 22.0, 26.0};
    fill_material(line, arcs_, 9.81, 1e-3, material_);
    for (JointMaterial& joint : material_.joints) joint.bend_n_mm2[1] *= 1.7;  // anisotropic
  }

  ChainShape state(std::uint64_t seed) {
    test::Random random(seed);
    return test::random_chain(arcs_, GetParam().bend_rad, GetParam().twist_rad, GetParam().stretch, random);
  }
  std::size_t unknowns() const { return 4 * arcs_.size(); }

  /// All derivatives; the axial forces in the Hessian are the present ones, which makes it exact.
  double derivatives(const ChainShape& shape, math::BandMatrix& hessian,
                     std::vector<double>& gradient) const {
    hessian.resize(static_cast<int>(unknowns()));
    hessian.set_zero();
    gradient.assign(unknowns(), 0.0);
    std::vector<double> force(arcs_.size() - 1);
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] = axial_force_n(material_, shape, static_cast<int>(i));
    return add_joint_derivatives(material_, shape, hessian, gradient) +
           add_stretch_derivatives(material_, shape, force, hessian, gradient);
  }

  std::vector<double> arcs_;
  ChainMaterial material_;
};

TEST_P(ChainStates, TaylorSlopes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const ChainShape base = state(seed);
    math::BandMatrix hessian;
    std::vector<double> gradient;
    const double energy = derivatives(base, hessian, gradient);
    EXPECT_NEAR(energy, chain_energy(material_, base), 1e-12 * (1.0 + energy));
    test::Random random(100 + seed);
    const std::vector<double> d = test::random_direction(unknowns(), random);
    const double slope = test::dot(gradient, d);
    const double curvature = test::quadratic(hessian, d);
    EXPECT_GT(std::abs(curvature), 1e-3);
    if (GetParam().bend_rad > 0.0) {
      EXPECT_GT(std::abs(slope), 1e-3);
    }
    test::expect_taylor([&](double h) { return chain_energy(material_, test::moved_chain(base, d, h)); },
                        slope, curvature, energy + std::abs(curvature), GetParam().name, 1e-3);
    // Spins only: the stretch, which is a thousand times larger, hides nothing.
    std::vector<double> spins = d;
    for (std::size_t i = 0; i < spins.size(); ++i) {
      if (i % 4 != 3) spins[i] = 0.0;
    }
    test::expect_taylor([&](double h) { return chain_energy(material_, test::moved_chain(base, spins, h)); },
                        test::dot(gradient, spins), test::quadratic(hessian, spins), energy,
                        GetParam().name + " spins", 1e-2);
  }
}

// The gradient differenced along transported frames, made symmetric, is the Hessian: every entry, not only directions.
// Breaks with an entry in the wrong place of the band, or when the band is too narrow for a coupling.
TEST_P(ChainStates, HessianIsTheSymmetricPartOfTheDifferencedGradient) {
  const ChainShape base = state(7);
  math::BandMatrix hessian;
  std::vector<double> gradient;
  derivatives(base, hessian, gradient);
  const auto n = static_cast<Eigen::Index>(unknowns());
  MatrixXd exact = MatrixXd::Zero(n, n);
  MatrixXd differenced = MatrixXd::Zero(n, n);
  const double h = GetParam().kinked ? 1e-6 : 1e-5;
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<double> unit(unknowns(), 0.0);
    unit[static_cast<std::size_t>(j)] = 1.0;
    math::BandMatrix unused;
    std::vector<double> ahead, behind;
    derivatives(test::moved_chain(base, unit, h), unused, ahead);
    derivatives(test::moved_chain(base, unit, -h), unused, behind);
    std::vector<double> column(unknowns());
    hessian.multiply(unit, column);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      exact(i, j) = column[k];
      differenced(i, j) = (ahead[k] - behind[k]) / (2.0 * h);
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

// Forces and moments inside a chain sum to zero: a rigid motion does no work. Breaks with a force on one end only.
TEST_P(ChainStates, ARigidMotionDoesNoWork) {
  const ChainShape base = state(8);
  math::BandMatrix hessian;
  std::vector<double> gradient;
  derivatives(base, hessian, gradient);
  test::Random random(9);
  const Vector3d velocity = random.vector();
  const Vector3d omega = random.vector();
  double work = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const Vector3d g = Eigen::Map<const Vector3d>(gradient.data() + 4 * i);
    const Vector3d v = velocity + omega.cross(base.joints_mm[i]);
    work += g.dot(v);
    scale += g.norm() * v.norm();
    if (i + 1 < arcs_.size()) work += gradient[4 * i + 3] * omega.dot(base.frames[i].col(2));
  }
  EXPECT_NEAR(work, 0.0, 1e-11 * (1.0 + scale));
}

INSTANTIATE_TEST_SUITE_P(All, ChainStates,
                         testing::Values(Case{"straight", 0.0, 0.0, 0.0, false},
                                         Case{"gentle", 0.1, 0.1, 1e-4, false},
                                         Case{"curly", 0.5, 0.6, 1e-3, false},
                                         Case{"twisted", 0.2, 1.2, 1e-4, false},
                                         Case{"kinked", 0.3, 0.2, 1e-4, true}),
                         [](const auto& instance) { return instance.param.name; });

class Retract : public testing::Test {
 protected:
  void SetUp() override {
    arcs_ = test::even_arcs(20, 2.0);
    test::Random random(31);
    base_ = test::random_chain(arcs_, 0.1, 0.1, 1e-3, random);
    direction_ = test::random_direction(4 * arcs_.size(), random);
    for (double& v : direction_) v *= 0.1;
  }
  std::vector<double> arcs_;
  ChainShape base_;
  std::vector<double> direction_;
};

// Rods take exactly the length that the linear step predicts, |t| + α e·δt. Breaks when lengths drift at second order:
// the axial forces would then jump by newtons within an iteration.
TEST_F(Retract, KeepsThePredictedLengths) {
  for (const double alpha : {1.0, 0.37, 0.0}) {
    ChainShape out;
    ASSERT_TRUE(retract(base_, direction_, alpha, {false, false, false}, out));
    for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
      const Vector3d t = base_.joints_mm[i] - base_.joints_mm[i + 1];
      const Vector3d moved = alpha * (Eigen::Map<const Vector3d>(direction_.data() + 4 * i) -
                                      Eigen::Map<const Vector3d>(direction_.data() + 4 * i + 4));
      EXPECT_NEAR((out.joints_mm[i] - out.joints_mm[i + 1]).norm(), t.norm() + t.normalized().dot(moved),
                  1e-12);
      EXPECT_LT(test::frame_error(out.frames[i]), 1e-13);
      EXPECT_LT((out.frames[i].col(2) - (out.joints_mm[i] - out.joints_mm[i + 1]).normalized()).norm(),
                1e-13);
      EXPECT_DOUBLE_EQ(out.spin_rad[i], base_.spin_rad[i] + alpha * direction_[4 * i + 3]);
    }
    for (std::size_t j = 1; j + 1 < arcs_.size(); ++j) {
      EXPECT_NEAR(
          std::remainder(out.twist_rad[j] - twist_between(out.frames[j], out.frames[j - 1], 0.0), 2.0 * M_PI),
          0.0, 1e-12);
    }
  }
}

// To first order the curve is the straight step: the hand's end exactly, each joint up to O(α²). Breaks when the line
// search follows another direction than Newton chose.
TEST_F(Retract, LeavesAlongTheDirection) {
  test::expect_order(
      [&](double alpha) {
        ChainShape out;
        if (!retract(base_, direction_, alpha, {false, false, false}, out)) return HUGE_VAL;
        double worst = 0.0;
        for (std::size_t i = 0; i < arcs_.size(); ++i) {
          worst = std::max(worst, (out.joints_mm[i] - base_.joints_mm[i] -
                                   alpha * Eigen::Map<const Vector3d>(direction_.data() + 4 * i))
                                      .norm());
        }
        return worst;
      },
      2.0, 1e-13, "retraction");
  ChainShape out;
  ASSERT_TRUE(retract(base_, direction_, 0.0, {false, false, false}, out));
  for (std::size_t i = 0; i < arcs_.size(); ++i)
    EXPECT_LT((out.joints_mm[i] - base_.joints_mm[i]).norm(), 1e-12);
}

// A held coordinate of the tip ends where it began (its step is zero); the lengths still hold.
TEST_F(Retract, RespectsAHeldTip) {
  for (const std::array<bool, 3> held :
       {std::array{true, false, false}, std::array{false, true, true}, std::array{true, true, true}}) {
    std::vector<double> d = direction_;
    for (double& v : d) v *= 0.3;
    for (std::size_t c = 0; c < 3; ++c) {
      if (held[c]) d[c] = 0.0;
    }
    ChainShape out, free;
    ASSERT_TRUE(retract(base_, d, 1.0, held, out));
    ASSERT_TRUE(retract(base_, d, 1.0, {false, false, false}, free));
    double would_move = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!held[c]) continue;
      const auto k = static_cast<Eigen::Index>(c);
      EXPECT_NEAR(out.joints_mm[0][k], base_.joints_mm[0][k], 1e-10);
      would_move = std::max(would_move, std::abs(free.joints_mm[0][k] - base_.joints_mm[0][k]));
    }
    EXPECT_GT(would_move, 1e-3) << "the tip would not have moved anyway: nothing was tested";
    for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
      EXPECT_NEAR((out.joints_mm[i] - out.joints_mm[i + 1]).norm(),
                  (free.joints_mm[i] - free.joints_mm[i + 1]).norm(), 1e-12);
      EXPECT_LT(test::frame_error(out.frames[i]), 1e-13);
    }
  }
}

// A step that would turn a rod right round, or swallow it, is refused rather than followed.
TEST_F(Retract, RefusesStepsThatTurnARodTooFar) {
  std::vector<double> d(direction_.size(), 0.0);
  const Vector3d t = base_.joints_mm[10] - base_.joints_mm[11];
  for (std::size_t j = 0; j <= 10; ++j) {
    for (std::size_t c = 0; c < 3; ++c) d[4 * j + c] = -0.8 * t[static_cast<Eigen::Index>(c)];
  }
  ChainShape out;
  EXPECT_FALSE(retract(base_, d, 1.0, {false, false, false}, out));
  EXPECT_TRUE(retract(base_, d, 0.3, {false, false, false}, out));
}

// In equilibrium the force that balances the joints is the axial force: the Hessian is then exact and Newton quadratic.
TEST(GeometricForce, IsTheAxialForceInEquilibrium) {
  // A straight weightless chain under a tip force along it, stretched as that force asks.
  for (const double force_n : {-0.4, 0.7}) {
    const MaterialLine line(test::uniform_wire(10.0, 8.0, 200.0));
    const std::vector<double> arcs = test::even_arcs(12, 3.0);
    ChainMaterial material;
    fill_material(line, arcs, 0.0, 0.0, material);
    const Vector3d axis = Vector3d(1.0, 2.0, -0.5).normalized();
    ChainShape shape = test::straight_chain(arcs, Vector3d::Zero(), axis);
    for (std::size_t i = arcs.size() - 1; i-- > 0;) {
      shape.joints_mm[i] = shape.joints_mm[i + 1] + (3.0 + force_n / material.stretch_n_per_mm[i]) * axis;
    }
    math::BandMatrix hessian;
    hessian.resize(static_cast<int>(4 * arcs.size()));
    hessian.set_zero();
    std::vector<double> gradient(4 * arcs.size(), 0.0);
    add_joint_derivatives(material, shape, hessian, gradient);
    for (std::size_t c = 0; c < 3; ++c) gradient[c] -= force_n * axis[static_cast<Eigen::Index>(c)];
    std::vector<char> held(gradient.size(), 0);
    for (std::size_t c = 0; c < 4; ++c) held[held.size() - 1 - c] = 1;
    TridiagonalScratch scratch;
    std::vector<double> geometric;
    geometric_force_n(material, shape, gradient, held, scratch, geometric);
    for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
      EXPECT_NEAR(axial_force_n(material, shape, static_cast<int>(i)), force_n, 1e-9);
      EXPECT_NEAR(geometric[i], force_n, 1e-9);
    }
    // Out of equilibrium it must not follow a stray stretch: of the two forces the smaller one is taken.
    shape.joints_mm[0] += 1e-3 * axis;
    const double stray = axial_force_n(material, shape, 0);
    ASSERT_GT(std::abs(stray - force_n), 0.1);
    geometric_force_n(material, shape, gradient, held, scratch, geometric);
    const double expected =
        stray * force_n < 0.0 ? 0.0 : std::copysign(std::min(std::abs(stray), std::abs(force_n)), stray);
    EXPECT_NEAR(geometric[0], expected, 1e-9);
  }
}

// Weight less buoyancy of a whole chain is that of the wire; 1 g is 9.81e-3 N. Breaks when half rods at the ends are
// lost or counted twice.
TEST(FillMaterial, WeightsSpansAndLengthsAddUp) {
  const MaterialLine line(test::curved_tip_wire());
  const std::vector<double> arcs{0.0, 1.0, 3.5, 4.0, 9.0, 11.0, 20.0};
  ChainMaterial material;
  fill_material(line, arcs, 9.81, 1.06e-3, material);
  const double exact = (line.mass_g(0.0, 20.0) - 1.06e-3 * line.volume_mm3(0.0, 20.0)) * 9.81e-3;
  EXPECT_NEAR(std::accumulate(material.weight_n.begin(), material.weight_n.end(), 0.0), exact, 1e-15);
  EXPECT_GT(exact, 0.0);
  EXPECT_DOUBLE_EQ(material.joints[3].span_mm, 0.5 * (9.0 - 3.5));
  EXPECT_DOUBLE_EQ(material.length_mm[4], 2.0);
  EXPECT_NEAR(material.stretch_n_per_mm[1], 1900.0 / 2.5, 1e-9);
  // All of the rest bend between the first and the last half rod is on the joints.
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();
  for (std::size_t j = 1; j + 1 < arcs.size(); ++j) bend += material.joints[j].rest_bend_rad;
  EXPECT_NEAR(bend.x(), 0.05 * (10.0 - 0.5), 1e-12);
  // Changing the chain from a joint on gives what filling it anew gives.
  ChainMaterial again = material;
  std::vector<double> other = arcs;
  other[5] = 12.0;
  other[6] = 22.0;
  again.arc_mm = other;
  ImmersedWire{&line, 9.81, 1.06e-3}.fill(5, again.rods(), again);
  fill_material(line, other, 9.81, 1.06e-3, material);
  EXPECT_EQ(again.length_mm, material.length_mm);
  EXPECT_EQ(again.weight_n, material.weight_n);
  EXPECT_EQ(again.stretch_n_per_mm, material.stretch_n_per_mm);
  for (std::size_t j = 0; j < arcs.size(); ++j) {
    EXPECT_EQ(again.joints[j].span_mm, material.joints[j].span_mm);
    EXPECT_EQ(again.joints[j].rest_bend_rad, material.joints[j].rest_bend_rad);
  }
}

}  // namespace
}  // namespace endowire::rod

// Derivatives of the joint energy by Taylor slope: along great arcs of both tangents with transported frames, the
// remainder of the gradient must fall with h², that of the Hessian with h³.
#include "endowire/rod/joint_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "support/frames.hpp"
#include "support/taylor.hpp"

namespace endowire::rod {
namespace {

using Eigen::Vector3d;
using test::moved;

struct State {
  std::string name;
  double bend_rad;  ///< angle between the rods
  double twist_rad;
  bool anisotropic;
  bool rest;          ///< bias angles and rest twist
  double kink_ratio;  ///< φ/l̄ over κ_m; 0: no kink law
};

std::ostream& operator<<(std::ostream& out, const State& s) {
  return out << s.name;
}

JointMaterial material_of(const State& s) {
  JointMaterial m;
  m.span_mm = 3.0;
  m.bend_n_mm2 = {5.0, s.anisotropic ? 9.0 : 5.0};
  m.twist_n_mm2 = 4.0;
  if (s.rest) {
    m.rest_bend_rad = {0.2, -0.1};
    m.rest_twist_rad = 0.05;
  }
  if (s.kink_ratio > 0.0) m.kink_per_mm = s.bend_rad / m.span_mm / s.kink_ratio;
  return m;
}

/// Two frames with the given angle and twist, in a random plane.
void frames_of(const State& s, test::Random& random, Frame& hand, Frame& tip) {
  hand = random.frame();
  const double plane = random.uniform(0.0, 6.28);
  tip = moved(hand, {s.bend_rad * std::cos(plane), s.bend_rad * std::sin(plane), s.twist_rad});
}

class JointStates : public testing::TestWithParam<State> {};

TEST_P(JointStates, TaylorSlopes) {
  test::Random random(21);
  for (int trial = 0; trial < 12; ++trial) {
    const JointMaterial m = material_of(GetParam());
    Frame hand, tip;
    frames_of(GetParam(), random, hand, tip);
    JointDerivatives d;
    const double near = GetParam().twist_rad;
    joint_derivatives(m, hand, tip, twist_between(hand, tip, near), d);
    Turns v;
    for (int i = 0; i < 6; ++i) v[i] = random.normal();
    v.normalize();
    const auto energy = [&](double h) {
      const Frame a = moved(hand, h * v.head<3>());
      const Frame b = moved(tip, h * v.tail<3>());
      return joint_energy(m, a, b, twist_between(a, b, near + h * (v[5] - v[2])));
    };
    ASSERT_NEAR(d.energy_mj, energy(0.0), 1e-13 * (1.0 + d.energy_mj));
    const double largest_step =
        GetParam().kink_ratio > 0.0 ? 0.001 : 0.05;  // the law begins: stay on one side
    test::expect_taylor(energy, d.gradient.dot(v), v.dot(d.hessian * v), d.gradient.norm(), GetParam().name,
                        largest_step);
    // Both derivatives are there: a test of zeros against zeros would pass too.
    EXPECT_GT(d.hessian.norm(), 1e-3);
    if (GetParam().bend_rad > 0.01 || GetParam().rest) {
      EXPECT_GT(d.gradient.norm(), 1e-4);
    }
    EXPECT_LT((d.hessian - d.hessian.transpose()).norm(), 1e-12 * d.hessian.norm());
  }
}

// Turning the whole joint, or spinning both rods of a straight one together, costs nothing. Breaks when the frames
// of the two rods are not treated alike.
TEST_P(JointStates, ARigidTurnCostsNothing) {
  test::Random random(22);
  const JointMaterial m = material_of(GetParam());
  for (int trial = 0; trial < 10; ++trial) {
    Frame hand, tip;
    frames_of(GetParam(), random, hand, tip);
    const double twist = twist_between(hand, tip, GetParam().twist_rad);
    const Eigen::Matrix3d turn = random.frame();
    const Frame hand2 = turn * hand;
    const Frame tip2 = turn * tip;
    const double energy = joint_energy(m, hand, tip, twist);
    EXPECT_NEAR(twist_between(hand2, tip2, twist), twist, 1e-12);
    EXPECT_NEAR(joint_energy(m, hand2, tip2, twist), energy, 1e-12 * (1.0 + energy));
    // Infinitesimally: ω seen from each rod is a turn of it; the gradient along any ω vanishes.
    JointDerivatives d;
    joint_derivatives(m, hand, tip, twist, d);
    const Vector3d omega = random.vector();
    Turns w;
    for (const auto& [frame, first] : {std::pair{&hand, 0}, std::pair{&tip, 3}}) {
      const Vector3d along = omega.cross(frame->col(2));
      w[first] = along.dot(frame->col(0));
      w[first + 1] = along.dot(frame->col(1));
      w[first + 2] = omega.dot(frame->col(2));
    }
    EXPECT_NEAR(d.gradient.dot(w), 0.0, 1e-11 * (1.0 + d.gradient.norm() * w.norm()));
  }
}

// ∂E/∂κ̄ and its gradient drive the wire through the sheath. Breaks with a wrong sign there.
TEST_P(JointStates, RestDerivatives) {
  test::Random random(23);
  JointMaterial m = material_of(GetParam());
  Frame hand, tip;
  frames_of(GetParam(), random, hand, tip);
  const double twist = twist_between(hand, tip, GetParam().twist_rad);
  JointDerivatives d;
  joint_derivatives(m, hand, tip, twist, d);
  constexpr double h = 1e-4;
  for (int a = 0; a < 2; ++a) {
    JointDerivatives ahead, behind;
    const double rest = m.rest_bend_rad[a];
    m.rest_bend_rad[a] = rest + h;
    joint_derivatives(m, hand, tip, twist, ahead);
    m.rest_bend_rad[a] = rest - h;
    joint_derivatives(m, hand, tip, twist, behind);
    m.rest_bend_rad[a] = rest;
    EXPECT_NEAR(d.rest_gradient[a], (ahead.energy_mj - behind.energy_mj) / (2.0 * h), 1e-9);
    EXPECT_LT((d.rest_turn.row(a).transpose() - (ahead.gradient - behind.gradient) / (2.0 * h)).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, JointStates,
                         testing::Values(State{"gentle", 0.3, 0.2, false, false, 0.0},
                                         State{"straight", 0.0, 0.0, false, false, 0.0},
                                         State{"nearly_straight", 1e-7, 0.1, false, false, 0.0},
                                         State{"nearly_straight_with_rest", 1e-5, 0.0, true, true, 0.0},
                                         State{"straight_with_rest", 0.0, 0.3, true, true, 0.0},
                                         State{"at_the_end_of_the_series", std::acos(1.0 - 0.05), 0.2, true,
                                               true, 0.0},
                                         State{"strongly_bent", 2.5, 0.4, false, false, 0.0},
                                         State{"strongly_bent_anisotropic", 2.5, 0.4, true, true, 0.0},
                                         State{"right_angle", 0.5 * std::numbers::pi, 0.3, true, true, 0.0},
                                         State{"twisted", 0.4, 2.5, true, true, 0.0},
                                         State{"twisted_by_turns", 0.4, 14.0, true, true, 0.0},
                                         State{"anisotropic", 0.5, 0.6, true, false, 0.0},
                                         State{"anisotropic_rest", 0.5, -0.6, true, true, 0.0},
                                         State{"kink_law_begun", 0.6, 0.2, true, true, 0.95},
                                         State{"beyond_the_kink", 0.6, 0.2, false, true, 1.2},
                                         State{"beyond_the_kink_bent", 2.0, 0.2, true, true, 1.5}),
                         [](const auto& instance) { return instance.param.name; });

// |κ| = φ: a joint bent by φ out of a straight rest has ½ EI φ²/l̄ exactly, at any angle and in any plane. Breaks with
// 2 tan(φ/2), or when a twisted joint bends more softly.
TEST(JointEnergy, BendingIsQuadraticInTheAngle) {
  test::Random random(24);
  JointMaterial m;
  m.span_mm = 2.0;
  m.bend_n_mm2 = {7.0, 7.0};
  m.twist_n_mm2 = 3.0;
  for (double phi = 0.0; phi < 3.1; phi += 0.05) {
    for (const double twist : {0.0, 1.0, -2.9}) {
      const State s{"", phi, twist, false, false, 0.0};
      Frame hand, tip;
      frames_of(s, random, hand, tip);
      const double exact = 0.5 * 7.0 / 2.0 * phi * phi + 0.5 * 3.0 / 2.0 * twist * twist;
      EXPECT_NEAR(joint_energy(m, hand, tip, twist_between(hand, tip, twist)), exact, 1e-10 * (1.0 + exact))
          << phi;
    }
  }
}

// The rest shape is where the energy vanishes, and it is a bend of |κ̄| towards κ̄ in the material frame.
TEST(JointEnergy, VanishesAtTheRestShape) {
  JointMaterial m;
  m.span_mm = 2.0;
  m.bend_n_mm2 = {7.0, 11.0};
  m.twist_n_mm2 = 3.0;
  m.rest_bend_rad = {0.3, -0.4};
  const Frame hand = Frame::Identity();
  const Frame tip = moved(hand, {0.3, -0.4, 0.0});
  EXPECT_NEAR(joint_energy(m, hand, tip, 0.0), 0.0, 1e-28);
  EXPECT_GT(joint_energy(m, hand, moved(hand, {-0.3, 0.4, 0.0}), 0.0), 0.1);
  EXPECT_GT(joint_energy(m, hand, moved(hand, {0.4, 0.3, 0.0}), 0.0), 0.1);
}

// The kink law: nothing below 0.9 κ_m, EI κ_m²/6 per length at κ_m, growing with the third power.
TEST(JointEnergy, KinkLawStiffensTowardsItsCurvature) {
  JointMaterial m;
  m.span_mm = 2.0;
  m.bend_n_mm2 = {6.0, 6.0};
  m.twist_n_mm2 = 3.0;
  m.kink_per_mm = 0.4;
  const auto extra = [&m](double curvature) {
    const Frame hand = Frame::Identity();
    const double phi = curvature * m.span_mm;
    return joint_energy(m, hand, moved(hand, {phi, 0.0, 0.0}), 0.0) - 0.5 * 6.0 * phi * phi / 2.0;
  };
  EXPECT_NEAR(extra(0.359), 0.0, 1e-12);
  EXPECT_NEAR(extra(0.4), 2.0 * 6.0 * 0.16 / 6.0, 1e-9);
  EXPECT_NEAR(extra(0.44), 8.0 * extra(0.4), 1e-8);
}

// Folded flat there is no energy to speak of a finite one: the line search must see a wall there.
TEST(JointEnergy, IsInfiniteWhenFoldedFlat) {
  const Frame hand = Frame::Identity();
  Frame tip = hand;
  tip.col(2) = -tip.col(2);
  tip.col(1) = -tip.col(1);
  EXPECT_EQ(joint_energy(JointMaterial{}, hand, tip, 0.0), std::numeric_limits<double>::infinity());
}

// Unwrapping: followed in small steps the twist counts turns, both ways. Breaks when it is wrapped into ±π, which
// would let a torqued wire forget its turns.
TEST(TwistBetween, CountsTurns) {
  test::Random random(25);
  const Frame hand = random.frame();
  for (const double step : {0.3, -0.3}) {
    Frame tip = moved(hand, {0.8, 0.3, 0.0});
    double twist = 0.0;
    for (int k = 1; k <= 70; ++k) {
      tip = moved(tip, {0.0, 0.0, step});
      twist = twist_between(hand, tip, twist);
      ASSERT_NEAR(twist, k * step, 1e-11);
    }
    for (int k = 69; k >= 0; --k) {
      tip = moved(tip, {0.0, 0.0, -step});
      twist = twist_between(hand, tip, twist);
      ASSERT_NEAR(twist, k * step, 1e-11);
    }
  }
}

// Spinning the rod on the hand's side takes twist away. Breaks with the opposite sign, which makes torque go backwards.
TEST(TwistBetween, SignIsTipLessHand) {
  const Frame frame = Frame::Identity();
  EXPECT_NEAR(twist_between(frame, moved(frame, {0.0, 0.0, 0.4}), 0.0), 0.4, 1e-15);
  EXPECT_NEAR(twist_between(moved(frame, {0.0, 0.0, 0.4}), frame, 0.0), -0.4, 1e-15);
}

}  // namespace
}  // namespace endowire::rod

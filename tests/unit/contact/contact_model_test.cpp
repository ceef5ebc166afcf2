// The convex model of all contacts: its derivatives at any motion, and what it says about contacts that open and close.
#include "endowire/contact/contact_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chain_states.hpp"
#include "support/frames.hpp"
#include "support/taylor.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector3d;

constexpr int kJoints = 6;
constexpr std::size_t kUnknowns = 4 * kJoints;

/// Contacts on rods 0 … 4, with two walls each, some of them touching, and friction that sticks or slides.
ContactModel random_model(test::Random& random) {
  ContactModel model;
  for (int rod = 0; rod + 1 < kJoints; ++rod) {
    for (const double fraction : {0.0, 0.4}) {
      LinearContact& c = model.add();
      c.rod = rod;
      c.fraction = fraction;
      c.radius_mm = 0.45;
      c.walls = 2;
      for (std::size_t k = 0; k < 2; ++k) {
        c.wall[k].normal = random.unit();
        c.wall[k].depth_mm = 0.3 * random.normal();
        c.wall[k].zero_mm = 0.02;
        c.wall[k].stiffness_n_per_mm = 2.0;
      }
      c.axial = c.wall[0].normal.unitOrthogonal();
      c.around = c.wall[0].normal.cross(c.axial);
      c.slip_mm = 0.3 * Eigen::Vector2d(random.normal(), random.normal());
      c.friction = {1.5, 0.3};
    }
  }
  return model;
}

std::vector<double> random_motion(test::Random& random, double size) {
  std::vector<double> step = test::random_direction(kUnknowns, random);
  for (double& v : step) v *= size;
  return step;
}

/// C at a motion; the derivatives are thrown away.
double value_at(ContactModel model, const std::vector<double>& step, const GuidedJoint& guided) {
  math::BandMatrix unused;
  unused.resize(kUnknowns);
  std::vector<double> gradient(kUnknowns, 0.0);
  return model.add_derivatives(step, solve::ContactHessian::present, guided, unused, gradient).energy_mj;
}

// Taylor slopes about motions that open, close and slide contacts, with all joints free and with one on the sheath's line.
// Breaks with any missing factor between sample, joint and spin, or when the guided joint is moved off its line.
TEST(ContactModel, TaylorSlopesAtAMotion) {
  test::Random random(101);
  const GuidedJoint free;
  const GuidedJoint guided{kJoints - 1, Vector3d(2, -1, 2) / 3.0};
  for (const GuidedJoint& joint : {free, guided}) {
    for (int trial = 0; trial < 10; ++trial) {
      ContactModel model = random_model(random);
      const std::vector<double> step = random_motion(random, 0.2);
      std::vector<double> d = random_motion(random, 1.0);
      if (joint.joint >= 0) d[4 * kJoints - 3] = d[4 * kJoints - 2] = 0.0;
      math::BandMatrix hessian;
      hessian.resize(kUnknowns);
      hessian.set_zero();
      std::vector<double> gradient(kUnknowns, 0.0);
      const ModelPart part =
          model.add_derivatives(step, solve::ContactHessian::present, joint, hessian, gradient);
      EXPECT_EQ(part.energy_mj, value_at(model, step, joint));
      EXPECT_GT(std::abs(test::dot(gradient, d)), 1e-3);
      const auto along = [&](double h) {
        std::vector<double> there = step;
        for (std::size_t i = 0; i < there.size(); ++i) there[i] += h * d[i];
        return value_at(model, there, joint);
      };
      test::expect_taylor(along, test::dot(gradient, d), test::quadratic(hessian, d), part.energy_mj, "model",
                          1e-4);
    }
  }
}

// Convex: between two motions it lies on or below its chord. Breaks when a wall pulls, or friction softens.
TEST(ContactModel, IsConvex) {
  test::Random random(102);
  for (int trial = 0; trial < 100; ++trial) {
    const ContactModel model = random_model(random);
    const std::vector<double> a = random_motion(random, 0.5);
    const std::vector<double> b = random_motion(random, 0.5);
    std::vector<double> middle(kUnknowns);
    for (std::size_t i = 0; i < kUnknowns; ++i) middle[i] = 0.5 * (a[i] + b[i]);
    const double chord = 0.5 * (value_at(model, a, {}) + value_at(model, b, {}));
    EXPECT_LE(value_at(model, middle, {}), chord * (1.0 + 1e-12));
  }
}

/// One wall below a rod of two joints, its surface `gap` away.
ContactModel floor(double gap_mm) {
  ContactModel model;
  LinearContact& c = model.add();
  c.walls = 1;
  c.wall[0].normal = Vector3d::UnitZ();
  c.wall[0].depth_mm = -gap_mm;
  c.wall[0].stiffness_n_per_mm = 4.0;
  return model;
}

// A contact closes within the model, and says so once.
TEST(ContactModel, ContactsCloseAndOpenWithTheMotion) {
  ContactModel model = floor(0.1);
  math::BandMatrix hessian;
  hessian.resize(8);
  std::vector<double> step(8, 0.0);
  const auto at = [&](double z, solve::ContactHessian kind) {
    step[2] = z;
    hessian.set_zero();
    std::vector<double> gradient(8, 0.0);
    const ModelPart part = model.add_derivatives(step, kind, {}, hessian, gradient);
    return std::tuple{part.energy_mj, part.changed, gradient[2], hessian.lower(2, 2)};
  };
  EXPECT_EQ(at(0.0, solve::ContactHessian::present), std::tuple(0.0, false, 0.0, 0.0));
  const auto [energy, changed, force, stiffness] = at(-0.3, solve::ContactHessian::present);
  EXPECT_NEAR(energy, 0.5 * 4.0 * 0.04, 1e-15);
  EXPECT_TRUE(changed);
  EXPECT_NEAR(force, -0.8, 1e-15);
  EXPECT_EQ(stiffness, 4.0);
  EXPECT_FALSE(std::get<1>(at(-0.3, solve::ContactHessian::present)));
  // Assumed closed: the derivatives are those of the spring, pulling where it would; the value stays that of the wall.
  const auto [open_energy, open_changed, pull, spring] = at(0.2, solve::ContactHessian::assumed);
  EXPECT_EQ(open_energy, 0.0);
  EXPECT_TRUE(open_changed);
  EXPECT_NEAR(pull, 4.0 * 0.3, 1e-15);
  EXPECT_EQ(spring, 4.0);
  EXPECT_EQ(at(0.2, solve::ContactHessian::present), std::tuple(0.0, true, 0.0, 0.0));
}

// A joint on the sheath's line moves by its first unknown alone.
TEST(ContactModel, TheGuidedJointStaysOnItsLine) {
  LinearContact c;
  c.rod = 0;
  c.fraction = 0.25;
  const Vector3d direction = Vector3d(1, 2, 2) / 3.0;
  const std::vector<double> step{1.0, 2.0, 3.0, 9.0, 0.6, 7.0, 8.0, 9.0};
  EXPECT_LT((motion_of(c, step, {1, direction}) - (0.75 * Vector3d(1, 2, 3) + 0.25 * 0.6 * direction)).norm(),
            1e-15);
  EXPECT_LT((motion_of(c, step, {}) - (0.75 * Vector3d(1, 2, 3) + 0.25 * Vector3d(0.6, 7, 8))).norm(), 1e-15);
}

}  // namespace
}  // namespace endowire::contact

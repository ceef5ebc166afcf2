// The inserted length as an unknown: derivatives of everything that hangs on it.
#include "endowire/sim/feed.hpp"

#include <gtest/gtest.h>

#include "endowire/sim/chain_problem.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "support/chain_states.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

/// A bent chain that comes out of a sheath at arc 20.7 mm; the last rod lies in the sheath.
class Sheathed : public testing::Test {
 protected:
  static constexpr double kInserted_mm = 20.7;

  explicit Sheathed(rod::Instrument wire = varied_wire()) : line_(std::move(wire)) {
    problem_.line = &line_;
    problem_.feed.active = true;
    problem_.feed.push = {5.0, 2.0};
    problem_.feed.torque = {3.0, 4.0};
    problem_.feed.inserted_mm = kInserted_mm;
    problem_.feed.stretch_mm = 0.03;
    problem_.feed.twist_rad = -0.2;
  }

  /// Rest curvature, a taper and a kink law, all where the entering rod is.
  static rod::Instrument varied_wire() {
    rod::Instrument wire = test::curved_tip_wire();
    wire.sections[0].length_mm = 24.0;
    wire.sections[0].flexural_rigidity_n_mm2 = {6.0, 14.0};
    wire.sections[0].torsional_rigidity_n_mm2 = {5.0, 11.0};
    wire.sections[0].axial_rigidity_n = {1900.0, 1900.0};
    wire.sections[0].kink_curvature_per_mm = 0.12;
    return wire;
  }

  void lay(double bend_rad, std::uint64_t seed) {
    test::Random random(seed);
    const std::vector<double> arcs{0.0, 4.0, 8.0, 12.0, 16.0, kInserted_mm, kInserted_mm + kSheathRod_mm};
    problem_.material.resize(6);
    problem_.material.arc_mm = arcs;
    rod::ImmersedWire{&line_, 9.81, 0.0}.fill(0, 6, problem_.material);
    problem_.shape = test::random_chain(arcs, bend_rad, 0.1, 1e-3, random);
    problem_.fit_entering(kInserted_mm);
    problem_.release_all();
    problem_.hold_joint(5, true, true, true);
    direction_ = test::random_direction(4 * arcs.size(), random);
    for (std::size_t i = 4 * 6; i < direction_.size(); ++i) direction_[i] = 0.0;
    direction_[21] = direction_[22] = 0.0;
  }

  /// Energy a way h along direction_, whose feed is entry 20 and whose turn at the hand is entry 23.
  double energy_at(double h) const {
    ChainProblem there = problem_;
    std::vector<double> moved = direction_;
    moved[20] = 0.0;
    there.shape = test::moved_chain(problem_.shape, moved, h);
    there.feed.inserted_mm += h * direction_[20];
    there.feed.stretch_mm -= h * direction_[20];
    there.feed.twist_rad -= h * direction_[23];
    there.fit_entering(there.feed.inserted_mm);
    return there.energy_mj();
  }

  /// Derivatives of the energy in this state.
  struct Linearised {
    double energy_mj = 0.0;
    math::BandMatrix hessian;
    std::vector<double> gradient;
  };
  Linearised linearised() {
    Linearised model;
    model.hessian.resize(problem_.unknowns());
    model.gradient.assign(direction_.size(), 0.0);
    model.energy_mj = problem_.linearise(model.hessian, model.gradient);
    return model;
  }

  /// Energy over inserted length alone from here on.
  void feed_only() {
    std::fill(direction_.begin(), direction_.end(), 0.0);
    direction_[20] = 1.0;
  }

  /// What is left of the energy behind its gradient falls with the square of the way, in many states.
  void expect_gradient_of_everything() {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      lay(0.25, seed);
      const Linearised here = linearised();
      EXPECT_NEAR(here.energy_mj, problem_.energy_mj(), 1e-9 * here.energy_mj);
      EXPECT_GT(std::abs(here.gradient[20]), 1e-3) << "nothing depends on the feed";
      test::expect_order(
          [&](double h) { return energy_at(h) - here.energy_mj - h * test::dot(here.gradient, direction_); },
          2.0, 1e-12 * here.energy_mj, "seed " + std::to_string(seed), 0.02);
    }
  }

  /// In one state, along the feed alone.
  Linearised expect_second_derivative_of_the_feed() {
    lay(0.2, 7);
    feed_only();
    Linearised here = linearised();
    test::expect_taylor([&](double h) { return energy_at(h); }, here.gradient[20],
                        test::quadratic(here.hessian, direction_), here.energy_mj, "feed", 0.05);
    return here;
  }

  rod::MaterialLine line_;
  ChainProblem problem_;
  std::vector<double> direction_;
};

TEST_F(Sheathed, GradientOfEverythingTogether) {
  expect_gradient_of_everything();
}

// A wire that is not round, and less so further on: both directions push at the hand in their own measure.
class FlatSheathed : public Sheathed {
 protected:
  FlatSheathed() : Sheathed(flat_wire()) {}
  static rod::Instrument flat_wire() {
    rod::Instrument wire = varied_wire();
    wire.sections[0].length_mm = 20.0;
    wire.sections[0].flexural_ratio = 0.2;
    wire.sections[1].flexural_ratio = 0.7;
    wire.sections[1].kink_curvature_per_mm = 0.12;
    wire.sections[1].flexural_rigidity_n_mm2 = {14.0, 90.0, 4, 3.0};
    return wire;
  }
};

TEST_F(FlatSheathed, GradientOfEverythingTogether) {
  expect_gradient_of_everything();
}

class RubbingSheathed : public Sheathed {
 protected:
  RubbingSheathed() : Sheathed(rubbing_wire()) {}
  static rod::Instrument rubbing_wire() {
    rod::Instrument wire = varied_wire();
    for (rod::Section& section : wire.sections) section.friction = 1.5;
    return wire;
  }
};

// What enters slides along the wall and rubs. Breaks when its samples move by the fed length and not by the strain more.
TEST_F(RubbingSheathed, GradientWithContactAtTheEnteringRod) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    lay(0.02, seed);
    problem_.shape.joints_mm[4] += 0.3 * problem_.shape.frames[4].col(2);  // 6 % of strain: its share is seen
    problem_.shape = test::moved_chain(problem_.shape, std::vector<double>(28, 0.0), 1.0);
    // A wide tube whose wall the entering rod has just entered.
    constexpr double kRadius_mm = 60.0;
    const Vector3d n = problem_.shape.frames[4].col(0);
    const Vector3d middle = 0.5 * (problem_.shape.joints_mm[4] + problem_.shape.joints_mm[5]);
    const vessel::TubeField tube(middle + (kRadius_mm - line_.radius_mm(18.0) + 0.1) * n,
                                 problem_.shape.frames[4].col(2), kRadius_mm);
    rod::ChainShape before = problem_.shape;  // it has slid since, and rubs
    for (std::size_t j = 0; j < 5; ++j) before.joints_mm[j] -= 0.2 * problem_.shape.frames[4].col(2);
    problem_.contact.begin({line_, problem_.material, before}, {});
    problem_.contact.place({line_, problem_.material, before}, 5, tube, {});
    problem_.contact.detect({line_, problem_.material, problem_.shape}, tube, {});
    static_cast<void>(problem_.energy_mj());
    problem_.contact.renew_lagged();
    feed_only();
    const Linearised here = linearised();
    double pressed_n = 0.0;
    for (const contact::Sample& s : problem_.contact.samples())
      if (s.rod == 4 && s.fraction > 0.0) pressed_n += s.normal_n;
    ASSERT_GT(pressed_n, 0.01) << "the entering rod touches nothing";
    ASSERT_NEAR(here.energy_mj, problem_.energy_mj(), 1e-12 * here.energy_mj);
    constexpr double h = 1e-5;
    EXPECT_NEAR(here.gradient[20], (energy_at(h) - energy_at(-h)) / (2.0 * h), 1e-5) << "seed " << seed;
  }
}

// A trial that is not taken leaves nothing behind. Breaks when the entering rod keeps the length that the last trial gave it.
TEST_F(Sheathed, ATrialThatIsNotTakenChangesNothing) {
  lay(0.25, 9);
  const Linearised before = linearised();
  feed_only();
  direction_[20] = 0.3;
  EXPECT_GT(std::abs(problem_.try_step(direction_, 1.0) - before.energy_mj), 1e-6);
  const Linearised after = linearised();
  EXPECT_EQ(after.energy_mj, before.energy_mj);
  EXPECT_EQ(after.gradient, before.gradient);
  EXPECT_GT(std::abs(problem_.try_step(direction_, 1.0) - before.energy_mj), 1e-6);
  EXPECT_NEAR(problem_.energy_mj(), before.energy_mj, 1e-12 * before.energy_mj);
}

class SheathedUniform : public Sheathed {
 protected:
  SheathedUniform() : Sheathed(test::uniform_wire(8.0, 6.0, 200.0)) {}
};

class SheathedAtARamp : public Sheathed {
 protected:
  SheathedAtARamp() : Sheathed(wire_with_a_ramp()) {}
  /// Where this wire leaves the sheath its rest curvature is on the way to none.
  static rod::Instrument wire_with_a_ramp() {
    rod::Instrument wire = test::uniform_wire(8.0, 6.0, 21.0);
    wire.sections.push_back(wire.sections[0]);
    wire.sections[1].length_mm = 200.0;
    wire.sections[0].rest_curvature_per_mm = 0.08;
    wire.sections[0].rest_plane_rad = 0.4;
    return wire;
  }
};

// Breaks without the slope of the rest curvature in the feed's Hessian.
TEST_F(SheathedAtARamp, SecondDerivativeOfTheFeed) {
  expect_second_derivative_of_the_feed();
}

// On a uniform wire without a kink nothing is left out of the feed's row.
TEST_F(SheathedUniform, HessianOfTheFeed) {
  Linearised here = expect_second_derivative_of_the_feed();
  // Its row: what the gradients by all others change by.
  std::vector<double> row(direction_.size());
  here.hessian.multiply(direction_, row);
  const auto gradient_at = [&](double h) {
    ChainProblem there = problem_;
    there.feed.inserted_mm += h;
    there.feed.stretch_mm -= h;
    there.fit_entering(there.feed.inserted_mm);
    math::BandMatrix unused;
    unused.resize(there.unknowns());
    std::vector<double> g(direction_.size(), 0.0);
    static_cast<void>(there.linearise(unused, g));
    return g;
  };
  constexpr double h = 1e-5;
  const std::vector<double> ahead = gradient_at(h);
  const std::vector<double> behind = gradient_at(-h);
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_NEAR(row[i], (ahead[i] - behind[i]) / (2.0 * h), 1e-5 * (1.0 + std::abs(row[i])))
        << "unknown " << i;
}

/// What changes, at once as the sections say, where the wire leaves the sheath: its rest curvature, its rigidities, or the ratio of them.
enum class Change { rest_curvature, rigidity, ratio };

class SheathedAtABorder : public Sheathed, public testing::WithParamInterface<Change> {
 protected:
  SheathedAtABorder() : Sheathed(wire_with_a_border()) {}
  static rod::Instrument wire_with_a_border() {
    rod::Instrument wire = test::uniform_wire(8.0, 6.0, kInserted_mm);
    rod::Section& tip = wire.sections[0];
    rod::Section shaft = tip;
    shaft.length_mm = 200.0;
    switch (GetParam()) {
      case Change::rest_curvature:
        tip.rest_curvature_per_mm = 0.08;
        break;
      case Change::rigidity:
        shaft.flexural_rigidity_n_mm2 = 32.0;
        shaft.torsional_rigidity_n_mm2 = 24.0;
        shaft.axial_rigidity_n = 4000.0;
        break;
      case Change::ratio:
        tip.flexural_ratio = 0.3;
        break;
    }
    wire.sections.push_back(shaft);
    return wire;
  }
};

// The energy over the inserted length has no kink where the border comes out of the sheath: its slope is the same on both sides. Breaks when the
// ramps of rod::kRamp_mm are taken out, or are as short as the way looked at; Newton's method then goes to and fro over the border.
TEST_P(SheathedAtABorder, TheEnergyHasNoKinkInTheInsertedLength) {
  lay(0.2, 7);
  feed_only();
  constexpr double h = 1e-5;
  const double here = energy_at(0.0);
  const double slope_before_n = (here - energy_at(-h)) / h;
  const double slope_behind_n = (energy_at(h) - here) / h;
  constexpr double kMostStiffness_n_per_mm = 500.0;  // mostly EA over the entering rod, 425
  EXPECT_NEAR(slope_behind_n, slope_before_n, kMostStiffness_n_per_mm * h);
}

INSTANTIATE_TEST_SUITE_P(All, SheathedAtABorder,
                         testing::Values(Change::rest_curvature, Change::rigidity, Change::ratio));

}  // namespace
}  // namespace endowire::sim

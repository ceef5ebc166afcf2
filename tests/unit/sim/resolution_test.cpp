// Rods are as long as curvature, lumen, rest curve and turn allow; changes are few, small and do not flicker.
#include "endowire/sim/resolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "endowire/base/error.hpp"
#include "endowire/sim/vessel_ahead.hpp"
#include "support/chain_states.hpp"
#include "support/fields.hpp"
#include "support/simulations.hpp"
#include "support/wires.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

constexpr double kWide_mm = 40.0;

/// A wire that runs straight, along an arc, and straight again.
class BentWire : public testing::Test {
 protected:
  BentWire() : line_(test::uniform_wire(50.0, 40.0, 400.0)) {}

  /// Direction at a way from the hand's end: a bend of `radius_mm` from `from_mm` on, by one radian.
  void lay(const std::vector<double>& arcs, double from_mm, double radius_mm) {
    rod::fill_material(line_, arcs, 0.0, 0.0, material_);
    shape_ = test::straight_chain(arcs, Vector3d::Zero(), Vector3d::UnitZ());
    std::vector<double> d(4 * arcs.size(), 0.0);
    Vector3d at = Vector3d::Zero();
    for (std::size_t j = arcs.size() - 1; j-- > 0;) {
      const double middle = arcs.back() - 0.5 * (arcs[j] + arcs[j + 1]);
      const double angle = std::clamp((middle - from_mm) / radius_mm, 0.0, 1.0);
      at += (arcs[j + 1] - arcs[j]) * Vector3d(std::sin(angle), 0.0, std::cos(angle));
      const Vector3d to = at - shape_.joints_mm[j];
      for (std::size_t c = 0; c < 3; ++c) d[4 * j + c] = to[static_cast<Eigen::Index>(c)];
    }
    shape_ = test::moved_chain(shape_, d, 1.0);
  }

  [[nodiscard]] Resolution resolution(const ResolutionSpec& spec, const vessel::Field& field) const {
    return {spec, {&line_, 0.0, 0.0}, field};
  }

  /// Until nothing changes any more.
  RodChanges settle(Resolution& resolution) {
    RodChanges sum;
    for (int k = 0; k < 60; ++k) {
      const RodChanges now = resolution.adapt(material_, shape_);
      if (now.divided + now.joined == 0) return sum;
      sum.divided += now.divided;
      sum.joined += now.joined;
      sum.energy_mj += now.energy_mj;
    }
    ADD_FAILURE() << "still changing";
    return sum;
  }

  [[nodiscard]] double length_mm(int rod) const { return material_.length_mm[static_cast<std::size_t>(rod)]; }
  [[nodiscard]] double turn_rad(int joint) const {
    const auto j = static_cast<std::size_t>(joint);
    return std::acos(std::min(1.0, shape_.frames[j].col(2).dot(shape_.frames[j - 1].col(2))));
  }
  [[nodiscard]] double twist_rad() const {
    return std::accumulate(shape_.twist_rad.begin(), shape_.twist_rad.end(), 0.0);
  }

  rod::MaterialLine line_;
  rod::ChainMaterial material_;
  rod::ChainShape shape_;
  vessel::TubeField wide_{Vector3d::Zero(), Vector3d::UnitZ(), kWide_mm};
};

// In the bend rods are as long as the tolerance of the shape allows, far from it as long as may be.
// The rods that lie aside of the curve by more, or all rods as short as those of the bend, are what it would find.
TEST_F(BentWire, RodsAreShortInTheBendOnly) {
  for (const double radius : {15.0, 60.0}) {
    lay(test::even_arcs(15, 16.0), 100.0, radius);
    ResolutionSpec spec;
    Resolution adapted = resolution(spec, wide_);
    settle(adapted);
    double longest = 0.0;
    double shortest = HUGE_VAL;
    for (int i = 0; i + 2 < shape_.rods(); ++i) {
      const double middle = 240.0 - 0.5 * (material_.arc_mm[static_cast<std::size_t>(i)] +
                                           material_.arc_mm[static_cast<std::size_t>(i) + 1]);
      const bool bent = middle > 100.0 && middle < 100.0 + radius;
      const double sagitta = length_mm(i) * length_mm(i) / (8.0 * radius);
      if (bent) {
        EXPECT_LT(sagitta, 1.1 * spec.shape_tolerance_mm) << radius << ": " << i;
      }
      longest = std::max(longest, length_mm(i));
      shortest = std::min(shortest, length_mm(i));
    }
    EXPECT_EQ(longest, spec.longest_mm);
    EXPECT_EQ(shortest, radius < 20.0 ? 2.0 : 4.0);
  }
}

// Rods follow from the number of cells of the grid that the criteria ask for, not from where the wire began.
TEST_F(BentWire, CoarseAndFineBeginningsEndAlike) {
  const ResolutionSpec spec;
  std::vector<std::vector<double>> ends;
  for (const double start : {8.0, 1.0}) {
    lay(test::even_arcs(static_cast<int>(240.0 / start), start), 100.0, 15.0);
    Resolution adapted = resolution(spec, wide_);
    settle(adapted);
    ends.push_back(material_.arc_mm);
  }
  // Hysteresis leaves a factor between dividing and joining.
  EXPECT_LE(ends[0].size(), ends[1].size());
  EXPECT_LT(static_cast<double>(ends[1].size()), 1.6 * static_cast<double>(ends[0].size()));
}

TEST_F(BentWire, NarrowLumensShortenRods) {
  for (const double radius : {0.6, 1.5, 3.0}) {
    const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), radius);
    lay(test::even_arcs(60, 4.0), 500.0, 15.0);
    const ResolutionSpec spec;
    Resolution adapted = resolution(spec, tube);
    settle(adapted);
    double longest = 0.0;
    for (int i = 0; i + 2 < shape_.rods(); ++i) longest = std::max(longest, length_mm(i));
    EXPECT_LE(longest, spec.lumen_diameters * 2.0 * radius);
    EXPECT_GT(longest, 0.45 * spec.lumen_diameters * 2.0 * radius);
  }
}

// φ_m: no joint of a bent wire turns by more.
TEST_F(BentWire, NoJointTurnsByMoreThanTheLargestAngle) {
  ResolutionSpec spec;
  spec.shape_tolerance_mm = 1.0;
  spec.max_turn_rad = 0.1;
  lay(test::even_arcs(60, 4.0), 100.0, 12.0);
  Resolution adapted = resolution(spec, wide_);
  settle(adapted);
  for (int j = 1; j + 2 < shape_.rods(); ++j) EXPECT_LT(turn_rad(j), 1.05 * spec.max_turn_rad) << j;
}

// A curved tip has its bias angles, straight as it may lie.
TEST_F(BentWire, TheRestCurveShortensRods) {
  line_ = rod::MaterialLine(test::curved_tip_wire());
  ResolutionSpec spec;
  spec.max_bias_rad = 0.06;
  lay(test::even_arcs(60, 4.0), 500.0, 15.0);
  Resolution adapted = resolution(spec, wide_);
  settle(adapted);
  for (int j = 1; j + 2 < shape_.rods(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    EXPECT_LE(material_.joints[k].rest_bend_rad.norm(), spec.max_bias_rad * (1.0 + 1e-9)) << j;
  }
}

// Once settled nothing changes, nor when the curvature moves by a seventh to and fro.
TEST_F(BentWire, ThereIsNoFlicker) {
  lay(test::even_arcs(60, 4.0), 100.0, 15.0);
  Resolution adapted = resolution({}, wide_);
  settle(adapted);
  int changes = 0;
  for (const double radius : {15.0, 13.0, 15.0, 17.0, 15.0, 13.0, 17.0, 15.0}) {
    lay(std::vector<double>(material_.arc_mm), 100.0, radius);
    const RodChanges now = settle(adapted);
    changes += now.divided + now.joined;
  }
  // The first swing may cross a threshold, the others cross none.
  const std::vector<double> after = material_.arc_mm;
  for (const double radius : {15.0, 13.0, 15.0, 17.0, 15.0}) {
    lay(std::vector<double>(material_.arc_mm), 100.0, radius);
    settle(adapted);
  }
  EXPECT_EQ(material_.arc_mm, after);
  EXPECT_LT(changes, 12);
}

// One change in a neighbourhood: of two rods side by side at most one is divided, or the two are joined.
TEST_F(BentWire, NeighboursDoNotChangeInOneStep) {
  lay(test::even_arcs(30, 8.0), 100.0, 10.0);
  Resolution adapted = resolution({}, wide_);
  for (int step = 0; step < 12; ++step) {
    const std::vector<double> before = material_.arc_mm;
    adapted.adapt(material_, shape_);
    const std::set<double> old(before.begin(), before.end());
    for (std::size_t i = 0; i + 1 < before.size(); ++i) {
      const auto in = [&](std::size_t k) {
        return std::count_if(material_.arc_mm.begin(), material_.arc_mm.end(),
                             [&](double a) { return a > before[k] && a < before[k + 1]; });
      };
      EXPECT_LE(in(i), 1);
      if (i + 2 < before.size()) {
        EXPECT_LE(in(i) + in(i + 1), 1) << "step " << step << ", rod " << i;
      }
    }
  }
}

// What a change must not lose: length, the integral of twist, the tip to the tolerance, and the rods at the sheath.
TEST_F(BentWire, ChangesKeepLengthTwistAndTip) {
  lay(test::even_arcs(60, 4.0), 100.0, 15.0);
  std::vector<double> spin(4 * material_.arc_mm.size(), 0.0);
  for (std::size_t i = 0; i < shape_.frames.size(); ++i) spin[4 * i + 3] = -0.02 * material_.arc_mm[i];
  shape_ = test::moved_chain(shape_, spin, 1.0);
  const double twist = twist_rad();
  const Vector3d tip = shape_.joints_mm[0];
  const Vector3d sheath = shape_.joints_mm[shape_.joints_mm.size() - 2];
  Resolution adapted = resolution({}, wide_);
  const RodChanges changes = settle(adapted);
  EXPECT_GT(changes.divided, 5);
  EXPECT_GT(changes.joined, 5);
  EXPECT_NEAR(twist_rad(), twist, 0.02 * std::abs(twist));
  EXPECT_LT((shape_.joints_mm[0] - tip).norm(), 0.2);
  EXPECT_EQ((shape_.joints_mm[shape_.joints_mm.size() - 2] - sheath).norm(), 0.0);
  EXPECT_EQ(material_.arc_mm.front(), 0.0);
  EXPECT_EQ(material_.arc_mm.back(), 240.0);
  const double length = std::accumulate(material_.length_mm.begin(), material_.length_mm.end(), 0.0);
  EXPECT_NEAR(length, 240.0, 1e-9);
  const double least = 0.5 * 50.0 / 15.0;  // energy of the arc, one radian of it
  EXPECT_LT(changes.energy_mj, 0.1 * least);
}

// The budget: once that much energy has been injected, the rest waits for the next step, and comes then.
TEST_F(BentWire, AChangeWaitsWhenTheBudgetIsSpent) {
  const auto steps_until_settled = [&](double budget_mj) {
    ResolutionSpec spec;
    spec.budget_mj = budget_mj;
    lay(test::even_arcs(30, 8.0), 100.0, 10.0);
    Resolution adapted = resolution(spec, wide_);
    int steps = 0;
    for (; steps < 200; ++steps) {
      const RodChanges now = adapted.adapt(material_, shape_);
      if (now.divided + now.joined == 0) break;
    }
    return steps;
  };
  const int free = steps_until_settled(1e3);
  const std::vector<double> arcs = material_.arc_mm;
  const int thrifty = steps_until_settled(1e-9);
  EXPECT_GT(thrifty, 2 * free);
  EXPECT_LT(thrifty, 200);
  // The same but for what hysteresis leaves open.
  EXPECT_NEAR(static_cast<double>(material_.arc_mm.size()), static_cast<double>(arcs.size()), 4.0);
}

// Numbers that would make no rods, or rods without end, are refused by name.
TEST(ResolutionSpec, NumbersOutOfRangeAreRefused) {
  ResolutionSpec spec;
  EXPECT_NO_THROW(spec.validate("rods"));
  for (double ResolutionSpec::*value :
       {&ResolutionSpec::rod_length_mm, &ResolutionSpec::longest_mm, &ResolutionSpec::shortest_mm,
        &ResolutionSpec::shape_tolerance_mm, &ResolutionSpec::max_turn_rad, &ResolutionSpec::max_bias_rad,
        &ResolutionSpec::lumen_diameters, &ResolutionSpec::budget_mj}) {
    for (const double bad : {0.0, -1.0, 1e9, std::nan("")}) {
      ResolutionSpec changed;
      changed.*value = bad;
      EXPECT_THROW(changed.validate("rods"), base::InputError) << bad;
    }
  }
  SimulationSpec whole;
  whole.solver.rods.shortest_mm = 0.0;
  EXPECT_THROW(Simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), whole),
               base::InputError);
}

TEST_F(BentWire, UniformRodsStayAsTheyAre) {
  ResolutionSpec spec;
  spec.adaptive = false;
  lay(test::even_arcs(60, 4.0), 100.0, 5.0);
  const std::vector<double> before = material_.arc_mm;
  Resolution uniform = resolution(spec, wide_);
  const RodChanges changes = uniform.adapt(material_, shape_);
  EXPECT_EQ(changes.divided + changes.joined, 0);
  EXPECT_EQ(material_.arc_mm, before);
}

// The curvature of a bent tube seen from its straight part, of a straight one, and of a dead end.
TEST(VesselAhead, IsTheCurvatureOfTheTube) {
  const vessel::BentTubeField bent(Vector3d(0.0, 0.0, 20.0), Vector3d::UnitZ(), Vector3d::UnitX(), 25.0, 1.5,
                                   3.0);
  EXPECT_NEAR(vessel_curvature_ahead_per_mm(bent, {0.0, 0.0, 20.0}, Vector3d::UnitZ()), 1.0 / 25.0,
              0.1 / 25.0);
  // From its wall, and looking askance, about the same; from further off less, since the straight part counts.
  const Vector3d askance = Vector3d(0.0, 0.4, 1.0).normalized();
  EXPECT_NEAR(vessel_curvature_ahead_per_mm(bent, {0.0, 2.5, 20.0}, askance), 1.0 / 25.0, 0.1 / 25.0);
  const double from_afar = vessel_curvature_ahead_per_mm(bent, {0.0, 0.0, 10.0}, Vector3d::UnitZ());
  EXPECT_GT(from_afar, 0.2 / 25.0);
  EXPECT_LT(from_afar, 0.6 / 25.0);
  const vessel::TubeField straight(Vector3d::Zero(), Vector3d::UnitZ(), 3.0);
  EXPECT_EQ(vessel_curvature_ahead_per_mm(straight, {1.0, 0.0, 20.0}, Vector3d::UnitZ()), 0.0);
  const test::DeadEndField dead_end(3.0, 20.0);
  EXPECT_NEAR(vessel_curvature_ahead_per_mm(dead_end, {0.0, 0.0, 20.5}, Vector3d::UnitZ()), 1.0 / 3.0, 1e-6);
}

// In a step: rods come and go while the wire runs through a bend, and what they cost is told.
TEST(AdaptiveSimulation, RodsComeAndGoInABend) {
  sim::Simulation simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
  int divided = 0;
  int joined = 0;
  double energy_mj = 0.0;
  int most = 0;
  for (int k = 0; k < 260; ++k) {
    const StepReport& report = simulation.step({k < 130 ? 1.0 : -1.0, 0.01});
    ASSERT_TRUE(report.converged) << k;
    divided += report.rods_divided;
    joined += report.rods_joined;
    energy_mj = std::max(energy_mj, report.resolution_energy_mj);
    most = std::max(most, report.rods);
  }
  EXPECT_GT(divided, 5);
  EXPECT_GT(joined, 5);
  EXPECT_GT(energy_mj, 0.0);
  EXPECT_LT(energy_mj, 2.0 * ResolutionSpec{}.budget_mj);
  EXPECT_LT(most, simulation.most_rods());
}

// After save and restore in the middle of a run with changing rods, the same bits.
TEST(AdaptiveSimulation, SaveAndRestoreKeepTheBits) {
  const auto command = [](int k) { return Command{k % 60 < 45 ? 1.0 : -1.0, 0.02}; };
  sim::Simulation once(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
  State middle;
  for (int k = 0; k < 180; ++k) {
    if (k == 77) middle = once.state();
    once.step(command(k));
  }
  sim::Simulation again(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
  again.restore(middle);
  for (int k = 77; k < 180; ++k) again.step(command(k));
  EXPECT_EQ(again.state_hash(), once.state_hash());
}

}  // namespace
}  // namespace endowire::sim

// The loop of one instrument in vessels with closed forms: what goes in comes out, and nothing goes through.
#include "endowire/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "endowire/base/error.hpp"
#include "support/fields.hpp"
#include "support/simulations.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;
using test::bent_tube;
using test::curved_tip_wire;
using test::origin_access;
using test::run;
using test::straight_tube;

/// Length of the polyline beyond the sheath: the last rod lies in it.
double length_beyond_sheath(const State& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < s.joints_mm.size(); ++i)
    sum += (s.joints_mm[i] - s.joints_mm[i + 1]).norm();
  return sum;
}

/// The deepest that any point of the wire's surface stands in the wall, looked at every 0.25 mm.
double depth_in_wall(const State& s, const vessel::Field& field, double radius) {
  double deepest = -1e9;
  for (std::size_t i = 0; i + 2 < s.joints_mm.size(); ++i) {
    for (int k = 0; k < 16; ++k) {
      const Vector3d p = s.joints_mm[i] + k / 16.0 * (s.joints_mm[i + 1] - s.joints_mm[i]);
      deepest = std::max(deepest, radius - field.at(p).distance_mm);
    }
  }
  return deepest;
}

// What the hand feeds is in the vessel, but for what slips. Breaks when a joint that enters brings length with it or loses
// some, or when slip is counted with the wrong sign.
TEST(Feed, InsertedLengthIsWhatWasCommandedLessSlip) {
  for (const auto& field : {straight_tube(), bent_tube()}) {
    Simulation simulation(field, curved_tip_wire(), origin_access(), {});
    double commanded = 0.0;
    double slipped = 0.0;
    for (int i = 0; i < 110; ++i) {
      const double advance = i % 3 == 0 ? 0.37 : 1.0;
      commanded += advance;
      const StepReport& report = simulation.step({advance, 0.01});
      ASSERT_TRUE(report.converged) << i;
      slipped += report.hand_slip_mm;
      ASSERT_NEAR(report.inserted_length_mm, commanded - slipped, 1e-9);
      ASSERT_DOUBLE_EQ(report.inserted_length_mm, simulation.state().inserted_mm);
      if (simulation.state().joints_mm.empty()) continue;
      // The rods are rigid but for EA: the polyline has the length that was fed, to the strain of the forces here.
      ASSERT_NEAR(length_beyond_sheath(simulation.state()), report.inserted_length_mm,
                  1e-9 + report.inserted_length_mm * (0.5 + report.push_force_n) / 1000.0);
      // The last rod lies in the sheath, from the access on, along its direction.
      const auto n = simulation.state().joints_mm.size();
      const Vector3d& end = simulation.state().joints_mm[n - 2];
      ASSERT_EQ(end, Vector3d::Zero());
      ASSERT_LT((end - simulation.state().joints_mm[n - 1]).normalized().cross(Vector3d::UnitZ()).norm(),
                1e-12);
      ASSERT_GE((simulation.state().joints_mm[n - 3] - end).norm(), 0.4) << "the entering rod is too short";
    }
    EXPECT_LT(std::abs(slipped), 0.5);
  }
}

// The wire stays in the lumen, whatever it does there: to the hard cap of the wall everywhere along it.
TEST(Feed, TheWireStaysInTheLumen) {
  const auto field = bent_tube();
  Simulation simulation(field, curved_tip_wire(), origin_access(), {});
  for (int i = 0; i < 120; ++i) {
    const StepReport& report = simulation.step({1.0, 0.1});
    ASSERT_TRUE(report.converged) << i;
    if (simulation.state().joints_mm.empty()) continue;
    ASSERT_LT(depth_in_wall(simulation.state(), *field, 0.4445), 0.15 + 0.02) << i;
    ASSERT_LE(report.max_wall_deflection_mm, 0.15);
  }
}

// Advance, withdrawal and torque, each by its sign. Breaks when one of them is dropped in a step that has several.
TEST(Feed, AdvancesWithdrawsAndTurnsInOneMotion) {
  Simulation simulation(straight_tube(), curved_tip_wire(0.0), origin_access(), {});
  run(simulation, 60, {1.0, 0.0});
  const State before = simulation.state();
  const Vector3d tip_before = before.directors.front();
  StepReport report = simulation.step({1.0, 0.15});
  ASSERT_TRUE(report.converged);
  EXPECT_NEAR(simulation.state().inserted_mm - before.inserted_mm, 1.0, 1e-2);
  EXPECT_NEAR(simulation.state().hand_turn_rad - before.hand_turn_rad, 0.15, 1e-2);
  report = simulation.step({-2.0, -0.15});
  ASSERT_TRUE(report.converged);
  EXPECT_NEAR(simulation.state().inserted_mm - before.inserted_mm, -1.0, 1e-2);
  EXPECT_NEAR(simulation.state().hand_turn_rad - before.hand_turn_rad, 0.0, 1e-2);
  // Without friction the whole wire turns with the hand, the tip too: right-handed about the advance.
  run(simulation, 20, {0.0, 0.5 * std::numbers::pi / 20.0});
  const Vector3d tip_after = simulation.state().directors.front();
  const double turned =
      std::atan2(tip_before.cross(tip_after).dot(Vector3d::UnitZ()), tip_before.dot(tip_after));
  EXPECT_GT(turned, 0.3);
}

// Pulled out wholly and pushed in again, the wire lies as it did the first time. Breaks when friction, twist or spin of
// the first insertion survives in the sheath.
TEST(Feed, ReentryGivesTheShapeOfTheFirstEntry) {
  Simulation simulation(bent_tube(), curved_tip_wire(), origin_access(), {});
  run(simulation, 70, {1.0, 0.0});
  const State first = simulation.state();
  int steps = 0;
  while (simulation.state().inserted_mm > 0.0 && steps++ < 90) {
    ASSERT_TRUE(simulation.step({-1.0, 0.0}).converged) << simulation.state().inserted_mm;
  }
  EXPECT_TRUE(simulation.state().joints_mm.empty());
  EXPECT_EQ(simulation.step({0.0, 0.0}).push_force_n, 0.0);
  run(simulation, 1, {-simulation.state().inserted_mm, 0.0});
  EXPECT_EQ(simulation.state().inserted_mm, 0.0);
  run(simulation, 70, {1.0, 0.0});
  EXPECT_LT(test::shape_difference_mm(first, simulation.state()), 1e-3);
}

// A wire that is only turned in its sheath comes out turned.
TEST(Feed, TurnsInTheSheathCount) {
  Simulation straight(straight_tube(), curved_tip_wire(), origin_access(), {});
  run(straight, 40, {1.0, 0.0});
  Simulation turned(straight_tube(), curved_tip_wire(), origin_access(), {});
  run(turned, 9, {0.0, 10.0 * std::numbers::pi / 180.0});
  EXPECT_TRUE(turned.state().joints_mm.empty());
  run(turned, 40, {1.0, 0.0});
  // Gravity is along y: only the distance from the axis is the same in both planes.
  const double angle = std::acos(straight.state().directors.front().dot(turned.state().directors.front()));
  EXPECT_NEAR(angle, 0.5 * std::numbers::pi, 0.2);
}

// Against the end of a vessel the hand slips: its force stays below the grip's limit, the slip is reported. Breaks when
// the feed is a prescribed motion, which makes tens of newtons of one millimetre.
TEST(HandSlip, PushIsLimitedAgainstAClosedEnd) {
  rod::Instrument wire = curved_tip_wire();
  wire.grip_force_n = 0.3;  // of a fingertip: below the buckling force in this narrow tube
  const auto field = std::make_shared<test::DeadEndField>(0.8, 60.0);
  Simulation simulation(field, wire, origin_access(), {});
  double slipped = 0.0;
  double largest = 0.0;
  bool reported = false;
  for (int i = 0; i < 90; ++i) {
    const StepReport& report = simulation.step({1.0, 0.0});
    ASSERT_TRUE(report.converged) << i;
    ASSERT_LE(report.push_force_n, wire.grip_force_n * (1.0 + 1e-9)) << i;
    largest = std::max(largest, report.push_force_n);
    slipped += report.hand_slip_mm;
    for (const Event& event : report.events) reported = reported || event.kind == EventKind::hand_slip;
    if (!simulation.state().joints_mm.empty()) {
      ASSERT_LT(depth_in_wall(simulation.state(), *field, 0.4445), 0.15 + 0.02) << i;
    }
  }
  EXPECT_NEAR(largest, wire.grip_force_n, 1e-6);
  EXPECT_GT(slipped, 10.0);
  EXPECT_TRUE(reported);
  EXPECT_NEAR(slipped, 90.0 - simulation.state().inserted_mm, 1e-9);
}

// 300 mm into a dead end 60 mm deep: the wire stays in the vessel and every step converges.
TEST(HandSlip, SlowThreeHundredMillimetresIntoADeadEnd) {
  const auto field = std::make_shared<test::DeadEndField>(3.0, 60.0);
  Simulation simulation(field, curved_tip_wire(), origin_access(), {});
  for (int i = 0; i < 300; ++i) {
    const StepReport& report = simulation.step({1.0, 0.0});
    ASSERT_TRUE(report.converged) << i;
    ASSERT_LE(report.push_force_n, 2.0 * (1.0 + 1e-9)) << i;
    if (simulation.state().joints_mm.empty()) continue;
    ASSERT_LT(depth_in_wall(simulation.state(), *field, 0.4445), 0.15 + 0.02) << i;
  }
}

// Ten millimetres in one command are ten of one. Breaks when a long command is taken in one leap or in unequal pieces.
TEST(Commands, TenMillimetresAtOnceAreTenOfOne) {
  Simulation once(bent_tube(), curved_tip_wire(), origin_access(), {});
  Simulation often(bent_tube(), curved_tip_wire(), origin_access(), {});
  run(once, 6, {10.0, 0.5});
  run(often, 60, {1.0, 0.05});
  EXPECT_NEAR(once.state().inserted_mm, often.state().inserted_mm, 1e-9);
  EXPECT_LT(test::shape_difference_mm(once.state(), often.state()), 1e-9);
}

// The same bits through snaps: a strongly curved tip in a bend stores turns and whips round. Breaks when one snap of a long
// command spoils the prediction of all its other pieces.
TEST(Commands, PiecesOfALongCommandSnapAsTheyWouldAlone) {
  rod::Instrument whipping = curved_tip_wire();
  whipping.sections[0].length_mm = 30.0;
  whipping.sections[0].rest_curvature_per_mm = 0.1;
  Simulation once(bent_tube(), whipping, origin_access(), {});
  Simulation often(bent_tube(), whipping, origin_access(), {});
  constexpr int kPieces = 8;  // of 1 mm or 9.3°
  int snaps = 0;
  for (int k = 0; k < 25; ++k) {
    const Command piece = k < 7 ? Command{1.0, 0.0} : Command{0.0, 0.1625};
    const StepReport& report = once.step({kPieces * piece.advance_mm, kPieces * piece.torque_rad});
    ASSERT_TRUE(report.converged);
    snaps += report.snapped ? 1 : 0;
    for (int i = 0; i < kPieces; ++i) ASSERT_TRUE(often.step(piece).converged);
    State same = often.state();
    same.steps = once.state().steps;
    EXPECT_EQ(same.hash(), once.state_hash()) << "command " << k;
  }
  EXPECT_GT(snaps, 0);
}

// A command that is no number changes nothing and has not converged.
TEST(Commands, NotANumberIsRefused) {
  Simulation simulation(straight_tube(), curved_tip_wire(), origin_access(), {});
  run(simulation, 30, {1.0, 0.0});
  const State before = simulation.state();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const Command& bad : {Command{nan, 0.0}, Command{0.0, nan}, Command{infinite, 0.0},
                             Command{0.0, -infinite}, Command{1e12, 0.0}}) {
    const StepReport& report = simulation.step(bad);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.solve.converged());
    ASSERT_FALSE(report.events.empty());
    EXPECT_EQ(report.events.front().kind, EventKind::not_converged);
    EXPECT_EQ(simulation.state().joints_mm, before.joints_mm);
    EXPECT_EQ(simulation.state().inserted_mm, before.inserted_mm);
  }
  EXPECT_TRUE(simulation.step({1.0, 0.0}).converged) << "a refused command broke the simulation";
}

// A settled wire that nothing is done to does not move: no creep, no drift of its friction.
TEST(Commands, NothingDoneNothingMoves) {
  Simulation simulation(bent_tube(), curved_tip_wire(0.2), origin_access(), {});
  run(simulation, 70, {1.0, 0.05});
  run(simulation, 1, {0.0, 0.0});
  const State before = simulation.state();
  run(simulation, 300, {0.0, 0.0});
  EXPECT_LT(test::shape_difference_mm(before, simulation.state()), 1e-3);
  EXPECT_NEAR(simulation.state().inserted_mm, before.inserted_mm, 1e-6);
}

// The wire's end stays outside: there is nothing left to push.
TEST(Feed, StopsAtTheEndOfTheWire) {
  rod::Instrument wire = curved_tip_wire();
  wire.sections[1].length_mm = 40.0;
  Simulation simulation(straight_tube(), wire, origin_access(), {});
  for (int i = 0; i < 80; ++i) ASSERT_TRUE(simulation.step({1.0, 0.0}).converged) << i;
  EXPECT_LE(simulation.state().inserted_mm, 50.0);
  EXPECT_GT(simulation.state().inserted_mm, 44.0);
}

std::string refusal(const test::FieldPointer& field, const Access& access,
                    rod::Instrument wire = curved_tip_wire()) {
  return test::message_of<base::InputError>([&] { Simulation(field, wire, access, {}); });
}

// The messages that a user sees for a wrong access: field, value, what is allowed.
TEST(Construction, NamesWhatIsWrongWithTheAccess) {
  EXPECT_EQ(refusal(straight_tube(), {Vector3d::Zero(), Vector3d::Zero()}),
            "access.direction is [0, 0, 0]; must be a finite vector, not zero");
  EXPECT_EQ(refusal(straight_tube(), {Vector3d::Zero(), Vector3d(0, std::nan(""), 1)}),
            "access.direction is [0, nan, 1]; must be a finite vector, not zero");
  EXPECT_EQ(refusal(straight_tube(), {Vector3d(std::nan(""), 0, 0), Vector3d::UnitZ()}),
            "access.position_mm is [nan, 0, 0]; must be finite");
  EXPECT_EQ(refusal(straight_tube(), {Vector3d(5, 0, 0), Vector3d::UnitZ()}),
            "access.position_mm is [5, 0, 0], 2 mm outside the lumen; must lie inside");
  EXPECT_EQ(
      refusal(straight_tube(), {Vector3d(2.75, 0, 0), Vector3d::UnitZ()}),
      "access.position_mm is [2.75, 0, 0], 0.25 mm from the wall; must be at least 0.4445 mm, the radius of "
      "curved_tip");
  rod::Instrument wire = curved_tip_wire();
  wire.sections[0].friction = 3.0;
  EXPECT_EQ(refusal(straight_tube(), origin_access(), wire),
            "curved_tip: section[0].friction is 3; must be 0 … 2");
}

// A state of another kind is refused before anything is touched.
TEST(Restore, RefusesAnInconsistentState) {
  Simulation simulation(straight_tube(), curved_tip_wire(), origin_access(), {});
  run(simulation, 40, {1.0, 0.0});
  const State good = simulation.state();
  const std::uint64_t hash = simulation.state_hash();
  const auto refused = [&](auto spoil) {
    State bad = good;
    spoil(bad);
    EXPECT_THROW(simulation.restore(bad), base::InputError);
    EXPECT_EQ(simulation.state_hash(), hash);
  };
  refused([](State& s) { s.joints_mm.pop_back(); });
  refused([](State& s) { s.directors.pop_back(); });
  refused([](State& s) { s.spin_rad.clear(); });
  refused([](State& s) { s.twist_rad.push_back(0.0); });
  refused([](State& s) { s.directors.clear(); });
  refused([](State& s) { s.arc_mm.pop_back(); });
  refused([](State& s) { std::swap(s.arc_mm[2], s.arc_mm[3]); });
  refused([](State& s) { s.arc_mm[1] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](State& s) { s.friction.traction_n_per_mm.pop_back(); });
  refused([](State& s) { s.friction.normal_n_per_mm.push_back(0.0); });
  refused([](State& s) { std::swap(s.friction.arc_mm[2], s.friction.arc_mm[3]); });
  refused([](State& s) {  // more friction than this wire has samples
    for (double arc = 1e6; s.friction.arc_mm.size() < 100000; arc += 1.0) {
      s.friction.arc_mm.push_back(arc);
      s.friction.traction_n_per_mm.push_back(Eigen::Vector2d::Zero());
      s.friction.normal_n_per_mm.push_back(0.0);
    }
  });
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  refused([&](State& s) { s.joints_mm[3].y() = not_a_number; });
  refused([&](State& s) { s.directors[0].x() = not_a_number; });
  refused([&](State& s) { s.spin_rad[1] = not_a_number; });
  refused([&](State& s) { s.twist_rad[1] = not_a_number; });
  refused([&](State& s) { s.grip_stretch_mm = not_a_number; });
  refused([&](State& s) { s.friction.traction_n_per_mm[1].x() = not_a_number; });
  refused([&](State& s) { s.friction.normal_n_per_mm[1] = not_a_number; });
  refused([&](State& s) { s.drift.joints_mm[1].z() = not_a_number; });
  refused([](State& s) { s.inserted_mm = s.arc_mm.back(); });
  refused([](State& s) { s.inserted_mm = 1e9; });
  refused([](State& s) { s.joints_mm[3].x() += 1e9; });  // would be sampled without end
  refused([](State& s) { s.joints_mm[3] = s.joints_mm[2]; });
  refused([](State& s) {
    for (Vector3d& joint : s.joints_mm) joint.x() += 50.0;
  });
  refused([](State& s) { s.directors[2] *= 2.0; });
  refused([](State& s) { s.drift.joints_mm.pop_back(); });
  refused([](State& s) { std::swap(s.drift.arc_mm[1], s.drift.arc_mm[2]); });
  refused([](State& s) {  // more rods than this wire has
    s.joints_mm.resize(1001, Vector3d::Zero());
    s.directors.resize(1000, Vector3d::UnitX());
    s.spin_rad.resize(1000);
    s.twist_rad.resize(1001);
  });
  EXPECT_NO_THROW(simulation.restore(good));
  EXPECT_EQ(simulation.state_hash(), hash);
}

// Snapshot: what viewers see is the state.
TEST(Snapshots, ShowTheState) {
  Simulation simulation(bent_tube(), curved_tip_wire(), origin_access(), {});
  run(simulation, 80, {1.0, 0.02});
  Snapshot snapshot;
  simulation.snapshot(snapshot);
  const State& state = simulation.state();
  ASSERT_EQ(snapshot.points.size(), state.joints_mm.size());
  EXPECT_EQ(snapshot.inserted_length_mm, state.inserted_mm);
  double force = 0.0;
  for (std::size_t i = 0; i < snapshot.points.size(); ++i) {
    EXPECT_EQ(snapshot.points[i].position_mm, state.joints_mm[i]);
    EXPECT_GE(snapshot.points[i].wall_force_n_per_mm, 0.0);
    force = std::max(force, snapshot.points[i].wall_force_n_per_mm);
    if (i > 0) {
      EXPECT_GT(snapshot.points[i].arc_mm, snapshot.points[i - 1].arc_mm);
    }
  }
  EXPECT_GT(force, 1e-4);
  // In the middle of the bend the wire is curved as the tube is, or a little less.
  double largest = 0.0;
  for (std::size_t i = 4; i + 1 < snapshot.points.size(); ++i)
    largest = std::max(largest, snapshot.points[i].curvature_per_mm);
  EXPECT_NEAR(largest, 1.0 / 25.0, 0.03);
}

}  // namespace
}  // namespace endowire::sim

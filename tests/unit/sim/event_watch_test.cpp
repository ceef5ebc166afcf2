#include "endowire/sim/event_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "endowire/base/error.hpp"
#include "support/hand_made_trees.hpp"
#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

using Eigen::Vector3d;

Snapshot tip_at(const Vector3d& tip_mm) {
  Snapshot snapshot;
  snapshot.points.resize(2);
  snapshot.points[0].position_mm = tip_mm;
  snapshot.points[1].position_mm = tip_mm - Vector3d(0, 0, 10);
  snapshot.points[1].arc_mm = 10.0;
  for (SnapshotPoint& point : snapshot.points) point.radius_mm = 0.45;
  return snapshot;
}

/// Feeds made-up steps to a watch and keeps what it tells.
class EventWatchTest : public ::testing::Test {
 protected:
  /// A step of 1 mm that shows these signs, the tip as far as the hand.
  std::vector<Event> step(std::vector<Event> signs = {}, double advance_mm = 1.0) {
    report_.events = std::move(signs);
    hand_mm_ += advance_mm;
    return step_at({0, 0, hand_mm_}, {advance_mm, 0.0});
  }
  std::vector<Event> step_at(const Vector3d& tip_mm, const Command& command = {1.0, 0.0}) {
    const auto begun = watch_.after(command, report_, tip_at(tip_mm));
    return {begun.begin(), begun.end()};
  }
  /// Kinds told over many steps.
  static int count(const std::vector<Event>& events, EventKind kind) {
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.kind == kind; }));
  }

  StepReport report_;
  EventWatch watch_;
  double hand_mm_ = 0.0;
};

class EveryKind : public EventWatchTest, public ::testing::WithParamInterface<EventKind> {};

TEST_P(EveryKind, IsToldOnceHoweverManyStepsShowIt) {
  const Event sign{GetParam(), 2.0, {1, 2, 3}};
  EXPECT_TRUE(step().empty());
  const std::vector<Event> begun = step({sign});
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0], sign);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(step({sign}).empty()) << i;
}

TEST_P(EveryKind, FlickersAreOneEventAndALongSilenceEndsIt) {
  const Event sign{GetParam(), 2.0, {1, 2, 3}};
  int told = 0;
  for (int i = 0; i < 30; ++i)
    told += static_cast<int>(step(i % 3 == 0 ? std::vector{sign} : std::vector<Event>{}).size());
  EXPECT_EQ(told, GetParam() == EventKind::snap ? 10 : 1);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(step().empty());
  EXPECT_EQ(step({sign}).size(), 1U) << "after 4 mm of silence";
}

INSTANTIATE_TEST_SUITE_P(All, EveryKind,
                         ::testing::Values(EventKind::snap, EventKind::perforation, EventKind::kink,
                                           EventKind::exit, EventKind::too_narrow, EventKind::hand_slip,
                                           EventKind::not_converged));

TEST_F(EventWatchTest, OfSeveralSignsInOneStepTheStrongestIsTold) {
  const std::vector<Event> begun = step({{EventKind::snap, 2.0, Vector3d::Zero()},
                                         {EventKind::snap, 9.0, Vector3d::Zero()},
                                         {EventKind::snap, 3.0, Vector3d::Zero()}});
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0].value, 9.0);
}

TEST_F(EventWatchTest, AHandThatOnlyTurnsEndsEventsToo) {
  const Event sign{EventKind::kink, 2.0, Vector3d::Zero()};
  EXPECT_EQ(step({sign}).size(), 1U);
  report_.events.clear();
  for (int i = 0; i < 4; ++i) step_at({0, 0, hand_mm_}, {0.0, 0.18});  // 10 degrees
  EXPECT_EQ(step({sign}).size(), 1U);
}

TEST_F(EventWatchTest, AHandThatRestsEndsNothing) {
  const Event sign{EventKind::kink, 2.0, Vector3d::Zero()};
  EXPECT_EQ(step({sign}).size(), 1U);
  report_.events.clear();
  for (int i = 0; i < 100; ++i) step_at({0, 0, hand_mm_}, {0.0, 0.0});
  EXPECT_TRUE(step({sign}).empty());
}

// Such a command is refused by the step: the hand does not move, so nothing ends and no stall is missed later.
TEST_F(EventWatchTest, ACommandThatIsNoNumberMovesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Event sign{EventKind::kink, 2.0, Vector3d::Zero()};
  EXPECT_EQ(step({sign}).size(), 1U);
  report_.events.clear();
  for (const Command& refused : {Command{nan, 0.0}, Command{HUGE_VAL, 0.0}, Command{0.0, nan}})
    EXPECT_TRUE(step_at({0, 0, hand_mm_}, refused).empty());
  EXPECT_TRUE(step({sign}).empty()) << "it was under way";
  std::vector<Event> told;
  for (int i = 0; i < 20; ++i)
    for (const Event& e : step_at({0, 0, hand_mm_})) told.push_back(e);
  EXPECT_EQ(count(told, EventKind::stall), 1);
}

TEST_F(EventWatchTest, MemoryOfAnotherVesselIsRefused) {
  EventWatch branched(std::make_shared<const vessel::CentrelineTree>(test::bent_tube_tree()));
  for (const std::int32_t branch : {-2, 2}) {
    EventMemory memory = branched.memory();
    memory.branch = branch;
    EXPECT_THROW(branched.restore(memory), base::InputError) << branch;
    memory = branched.memory();
    memory.place.branch = branch;
    EXPECT_THROW(branched.restore(memory), base::InputError) << branch;
  }
  EventMemory memory = branched.memory();
  memory.branch = memory.place.branch = 1;
  branched.restore(memory);
  EXPECT_EQ(branched.memory().branch, 1);
  EXPECT_THROW(watch_.restore(memory), base::InputError) << "it has no branches";
}

TEST_F(EventWatchTest, ATipThatStaysWhileTheHandPushesIsAStall) {
  report_.push_force_n = 0.7;
  std::vector<Event> told;
  for (int i = 0; i < 40; ++i)
    for (const Event& e : step_at({0, 0, 0.02 * i})) told.push_back(e);
  ASSERT_EQ(count(told, EventKind::stall), 1);
  EXPECT_EQ(told[0].value, 0.7);
  // Free, and stuck again.
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(step_at({0, 0, 0.8 * i}).empty());
  told.clear();
  for (int i = 0; i < 20; ++i)
    for (const Event& e : step_at({0, 0, 8.8})) told.push_back(e);
  EXPECT_EQ(count(told, EventKind::stall), 1);
}

TEST_F(EventWatchTest, SlowProgressWithdrawalAndTurningAreNoStalls) {
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(step_at({0, 0, 0.2 * i}).empty()) << "a fifth of the advance";
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(step_at({0, 0, 8.0}, {-1.0, 0.0}).empty());
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(step_at({0, 0, 8.0}, {0.0, 0.2}).empty());
  for (int i = 0; i < 40; ++i)
    EXPECT_TRUE(step_at({0, 0, 8.0}, {i % 4 == 3 ? -1.0 : 1.0, 0.0}).empty()) << "4 mm of slack";
}

TEST_F(EventWatchTest, LoopsThatLieInEachOtherAreToldOnce) {
  Snapshot loop = tip_at({0, 0, 0});
  loop.points.resize(4, loop.points[0]);
  loop.points[1].position_mm = {20, 0, 0};
  loop.points[2].position_mm = {10, 20, 0};
  loop.points[3].position_mm = {10, -20, 0};
  for (std::size_t i = 0; i < 4; ++i) loop.points[i].arc_mm = 20.0 * static_cast<double>(i);
  const auto begun = watch_.after({1.0, 0.0}, report_, loop);
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0].kind, EventKind::self_overlap);
  EXPECT_NEAR(begun[0].value, -0.9, 1e-9);
  EXPECT_TRUE(watch_.after({1.0, 0.0}, report_, loop).empty());
}

class BranchWatch : public EventWatchTest {
 protected:
  BranchWatch() {
    watch_ = EventWatch(std::make_shared<const vessel::CentrelineTree>(test::tree_with_side_vessel()));
  }
};

TEST_F(BranchWatch, TheFirstBranchIsNoEventTheNextOneIs) {
  for (int z = 0; z < 60; z += 2) EXPECT_TRUE(step_at({0, 0, 1.0 * z}, {2.0, 0.0}).empty());
  std::vector<Event> told;
  std::vector<double> places;
  for (int x = 0; x < 60; ++x)
    for (const Event& e : step_at({1.0 * x, 0, 60.0})) {
      told.push_back(e);
      places.push_back(x);
    }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].kind, EventKind::new_branch);
  EXPECT_EQ(told[0].branch, 2);
  EXPECT_EQ(told[0].value, 2.0);
  EXPECT_EQ(places[0], 6.0) << "ostium at 5 mm, then half a radius of 2 mm";
  // Back out: the stem again.
  told.clear();
  for (int x = 60; x > 0; x -= 2)
    for (const Event& e : step_at({1.0 * x, 0, 60.0}, {-2.0, 0.0})) told.push_back(e);
  for (int z = 60; z > 40; z -= 2)
    for (const Event& e : step_at({0, 0, 1.0 * z}, {-2.0, 0.0})) told.push_back(e);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].branch, 0);
}

// Breaks when each stretch between two bifurcations counts: an aorta has one at every vessel that leaves it.
TEST_F(BranchWatch, TheNextStretchOfTheSameVesselIsNoEvent) {
  for (int z = 0; z <= 98; z += 2) EXPECT_TRUE(step_at({0, 0, 1.0 * z}, {2.0, 0.0}).empty()) << z;
  for (int z = 98; z > 40; z -= 2) EXPECT_TRUE(step_at({0, 0, 1.0 * z}, {-2.0, 0.0}).empty()) << z;
  std::vector<Event> told;
  for (int x = 0; x <= 80; x += 2)
    for (const Event& e : step_at({1.0 * x, 0, 60.0}, {2.0, 0.0})) told.push_back(e);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].branch, 2);
  for (int z = 62; z <= 88; z += 2)
    EXPECT_TRUE(step_at({80.0, 0, 1.0 * z}, {2.0, 0.0}).empty()) << "the side vessel goes on, z = " << z;
  // Back into the stem, beyond the bifurcation: its other stretch.
  for (int x = 78; x >= 0; x -= 2)
    for (const Event& e : step_at({1.0 * x, 0, 60.0}, {-2.0, 0.0})) told.push_back(e);
  for (int z = 62; z <= 80; z += 2)
    for (const Event& e : step_at({0, 0, 1.0 * z}, {2.0, 0.0})) told.push_back(e);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].branch, 1);
}

TEST_F(BranchWatch, ATipThatRubsOnTheCarinaDoesNotFlicker) {
  for (int z = 50; z <= 58; z += 2) EXPECT_TRUE(step_at({0, 0, 1.0 * z}, {2.0, 0.0}).empty());
  int told = 0;
  for (int i = 0; i < 50; ++i) told += static_cast<int>(step_at({i % 2 == 0 ? 4.0 : 5.6, 0, 60.0}).size());
  EXPECT_EQ(told, 0);
}

// A watch is a value: put back together with the state, the events go on as the original's.
TEST(EventWatch, SavedAndPutBackInMidRunItTellsTheSame) {
  const auto tree = std::make_shared<const vessel::CentrelineTree>(test::bent_tube_tree());
  const auto commands = [](int i) { return Command{i % 80 < 40 ? 1.0 : -1.0, 0.1}; };
  Simulation original(test::bent_tube(1.0), test::curved_tip_wire(), test::origin_access(), {});
  EventWatch watch(tree);
  Snapshot snapshot;
  const auto play = [&](Simulation& simulation, EventWatch& by, int from, int to) {
    std::vector<Event> told;
    for (int i = from; i < to; ++i) {
      const StepReport& report = simulation.step(commands(i));
      simulation.snapshot(snapshot);
      for (const Event& event : by.after(commands(i), report, snapshot)) told.push_back(event);
    }
    return told;
  };
  static_cast<void>(play(original, watch, 0, 67));
  const State saved = original.state();
  const EventWatch saved_watch = watch;
  const std::vector<Event> expected = play(original, watch, 67, 200);
  EXPECT_FALSE(expected.empty());
  Simulation other(test::bent_tube(1.0), test::curved_tip_wire(), test::origin_access(), {});
  other.restore(saved);
  EventWatch other_watch(tree);
  other_watch.restore(saved_watch.memory());
  EXPECT_EQ(play(other, other_watch, 67, 200), expected);
  EXPECT_EQ(other.state_hash(), original.state_hash());
}

}  // namespace
}  // namespace endowire::sim

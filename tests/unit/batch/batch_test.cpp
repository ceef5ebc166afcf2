#include "endowire/batch/batch.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <cfenv>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "endowire/base/error.hpp"
#include "endowire/vessel/random.hpp"
#include "support/fields.hpp"
#include "support/simulations.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::batch {
namespace {

using sim::Command;
using sim::Simulation;

constexpr std::size_t count = 12;
constexpr int steps = 60;

/// So that threads are threads on any machine: oneTBB runs no more than there are cores.
const tbb::global_control many_threads(tbb::global_control::max_allowed_parallelism, 8);

Simulation make(const test::FieldPointer& field) {
  return {field, test::curved_tip_wire(), test::origin_access(), {}};
}

std::vector<Simulation> make_all(const test::FieldPointer& field, std::size_t n = count) {
  std::vector<Simulation> all;
  for (std::size_t i = 0; i < n; ++i) all.push_back(make(field));
  return all;
}

/// Another hand for each simulation: in, out and round.
Command hand(std::size_t simulation, int step) {
  vessel::SplitMix random(1000 * simulation + static_cast<std::uint64_t>(step));
  return {random.uniform(-0.4, 1.6), random.uniform(-0.15, 0.2)};
}

std::vector<Command> hands(int step, std::size_t n = count) {
  std::vector<Command> commands;
  for (std::size_t i = 0; i < n; ++i) commands.push_back(hand(i, step));
  return commands;
}

class Threads : public testing::TestWithParam<int> {};

// Breaks with anything that simulations share and change, or that depends on the thread.
TEST_P(Threads, EveryStateHasTheBitsOfASimulationSteppedAlone) {
  const test::FieldPointer field = test::bent_tube();
  Batch batch(make_all(field), GetParam());
  EXPECT_EQ(batch.threads(), GetParam());
  std::vector<Simulation> alone = make_all(field);
  std::set<std::uint64_t> last;
  for (int step = 0; step < steps; ++step) {
    const std::span<const sim::StepReport> reports = batch.step(hands(step));
    last.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const sim::StepReport& expected = alone[i].step(hand(i, step));
      ASSERT_EQ(batch.simulation(i).state_hash(), alone[i].state_hash()) << i << ", step " << step;
      ASSERT_EQ(reports[i].push_force_n, expected.push_force_n);
      ASSERT_EQ(reports[i].newton_iterations, expected.newton_iterations);
      ASSERT_EQ(reports[i].events, expected.events);
      ASSERT_TRUE(reports[i].converged);
      last.insert(alone[i].state_hash());
    }
  }
  EXPECT_EQ(last.size(), count) << "the hands are all alike: nothing was tried";
}

INSTANTIATE_TEST_SUITE_P(All, Threads, testing::Values(1, 2, 3, 8));

TEST(Batch, StepsOnSeveralThreadsAndTheirNumberCanBeSet) {
  Batch batch(make_all(test::bent_tube(), 64), 4);
  const auto used = [&] {
    std::mutex guard;
    std::set<std::thread::id> ids;
    for (int step = 0; step < 20; ++step)
      batch.step(hands(step, 64), [&](std::size_t, const Simulation&, const sim::StepReport&) {
        const std::lock_guard lock(guard);
        ids.insert(std::this_thread::get_id());
      });
    return ids.size();
  };
  EXPECT_GT(used(), 1U);
  batch.set_threads(1);
  EXPECT_EQ(batch.threads(), 1);
  EXPECT_EQ(used(), 1U);
  batch.set_threads(0);
  EXPECT_GE(batch.threads(), 1);
}

// Without it the worker threads would round to nearest while the caller's share is rounded upwards.
TEST(Batch, TheCallersRoundingHoldsOnEveryThread) {
  const test::FieldPointer field = test::bent_tube();
  Batch batch(make_all(field), 4);
  std::vector<Simulation> upwards = make_all(field);
  std::vector<Simulation> nearest = make_all(field);
  for (int step = 0; step < 20; ++step)
    for (std::size_t i = 0; i < count; ++i) nearest[i].step(hand(i, step));
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  for (int step = 0; step < 20; ++step) {
    batch.step(hands(step));
    for (std::size_t i = 0; i < count; ++i) upwards[i].step(hand(i, step));
  }
  std::fesetround(FE_TONEAREST);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(batch.simulation(i).state_hash(), upwards[i].state_hash()) << i;
    EXPECT_NE(upwards[i].state_hash(), nearest[i].state_hash())
        << "rounding does not show: nothing was tried";
  }
}

/// A tube that cannot be asked while it is broken.
class BreakableField final : public vessel::Field {
 public:
  [[nodiscard]] vessel::WallDistance at(const Eigen::Vector3d& p) const override {
    if (broken) throw std::runtime_error("the field is broken");
    return tube_->at(p);
  }
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& p) const override {
    return tube_->lumen_radius_mm(p);
  }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& p) const override {
    return tube_->tissue_to_next_lumen_mm(p);
  }
  [[nodiscard]] int exit_at(const Eigen::Vector3d& p) const override { return tube_->exit_at(p); }
  [[nodiscard]] double error_mm() const override { return tube_->error_mm(); }

  std::atomic<bool> broken = false;

 private:
  test::FieldPointer tube_ = test::bent_tube();
};

TEST(Batch, ASimulationThatThrowsIsToldAndLeftOutUntilItIsRestored) {
  const auto breakable = std::make_shared<BreakableField>();
  std::vector<Simulation> all = make_all(test::bent_tube(), 3);
  all[1] = make(breakable);
  Batch batch(std::move(all), 2);
  Simulation alone = make(test::bent_tube());
  const std::vector<Command> push(3, Command{1.0, 0.02});
  for (int i = 0; i < 20; ++i) {
    batch.step(push);
    alone.step(push[0]);
  }
  const sim::State saved = batch.simulation(1).state();
  breakable->broken = true;
  std::span<const sim::StepReport> reports = batch.step(push);
  alone.step(push[0]);
  EXPECT_FALSE(reports[1].converged);
  EXPECT_EQ(batch.error(1), "the field is broken");
  EXPECT_TRUE(batch.error(0).empty());
  EXPECT_TRUE(reports[0].converged && reports[2].converged);
  breakable->broken = false;
  reports = batch.step(push);
  alone.step(push[0]);
  EXPECT_FALSE(reports[1].converged) << "a simulation that broke off in the middle of a step went on";
  EXPECT_EQ(batch.simulation(2).state_hash(), alone.state_hash());
  batch.restore(1, saved);
  EXPECT_TRUE(batch.error(1).empty());
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(batch.step(push)[1].converged);
  EXPECT_EQ(batch.simulation(1).state_hash(), alone.state_hash());
}

TEST(Batch, AFailedSolveIsDataOfThatSimulationAlone) {
  Batch batch(make_all(test::bent_tube(), 2), 2);
  const std::vector<Command> commands{{1.0, 0.0}, {std::nan(""), 0.0}};
  const auto reports = batch.step(commands);
  EXPECT_TRUE(reports[0].converged);
  EXPECT_FALSE(reports[1].converged);
  EXPECT_TRUE(batch.error(1).empty());
}

TEST(Batch, BadInputIsRefusedWithItsRange) {
  const auto message = [](auto call) { return test::message_of<base::InputError>(call); };
  EXPECT_EQ(message([] { Batch({}, 1); }), "simulations is an empty list; must hold at least one");
  EXPECT_EQ(message([] { Batch(make_all(test::bent_tube(), 1), -1); }),
            "threads is -1; must be 0 … 1024, 0 for all cores");
  Batch batch(make_all(test::bent_tube(), 2), 1);
  EXPECT_EQ(message([&] { batch.set_threads(5000); }), "threads is 5000; must be 0 … 1024, 0 for all cores");
  EXPECT_EQ(message([&] { batch.step(std::vector<Command>(3)); }),
            "commands is a list of 3; must be of 2, one a simulation");
  EXPECT_EQ(batch.simulation(0).state().steps, 0U);
}

}  // namespace
}  // namespace endowire::batch

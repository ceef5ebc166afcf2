#include "endowire/io/run_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace endowire::io {
namespace {

sim::Snapshot straight_wire(std::size_t points) {
  sim::Snapshot snapshot;
  snapshot.points.resize(points);
  for (std::size_t i = 0; i < points; ++i)
    snapshot.points[i].position_mm = {0.0, 0.0, -1.0 * static_cast<double>(i)};
  return snapshot;
}

/// A run whose wall force is largest at one step.
RunHistory history_of(std::uint64_t steps, std::uint64_t strongest, std::uint64_t event_every = 0) {
  RunHistory history(steps);
  const sim::Snapshot wire = straight_wire(3);
  for (std::uint64_t step = 1; step <= steps; ++step) {
    sim::StepReport report;
    report.max_force_5mm_n = step == strongest ? 9.0 : 0.1;
    report.inserted_length_mm = static_cast<double>(step);
    history.add(step, 0.1 * static_cast<double>(step), report, wire,
                event_every > 0 && step % event_every == 0);
  }
  return history;
}

TEST(RunHistory, KeepsEveryStepOfAnOrdinaryRun) {
  const RunHistory history = history_of(450, 123);
  EXPECT_EQ(history.every(), 1U);
  ASSERT_EQ(history.steps().size(), 450U);
  EXPECT_EQ(history.steps()[122].wall_force_n, 9.0);
  EXPECT_EQ(history.steps()[449].inserted_mm, 450.0);
}

TEST(RunHistory, IsBoundedHoweverLongTheRunAndLosesNoPeak) {
  const RunHistory history = history_of(100'001, 77'777, 10);
  EXPECT_LE(history.steps().size(), RunHistory::most_steps);
  EXPECT_LE(history.frames().size(), RunHistory::most_frames);
  double most = 0.0;
  std::uint64_t before = 0;
  for (const HistoryStep& step : history.steps()) {
    EXPECT_GT(step.step, before);
    before = step.step;
    most = std::max(most, step.wall_force_n);
  }
  EXPECT_EQ(most, 9.0);
}

TEST(RunHistory, HasShapesAtEqualIntervalsAtEventsAndAtTheEnd) {
  RunHistory history(1'000);
  const sim::Snapshot wire = straight_wire(3);
  for (std::uint64_t step = 1; step <= 1'000; ++step)
    history.add(step, 0.0, {}, step < 20 ? straight_wire(0) : wire, step == 333);
  std::vector<std::uint64_t> steps;
  for (const KeyFrame& frame : history.frames()) steps.push_back(frame.step);
  EXPECT_EQ(steps.front(), 21U) << "the wire is in the sheath until step 20; every seventh step is kept";
  EXPECT_EQ(steps.back(), 1'000U);
  EXPECT_NE(std::find(steps.begin(), steps.end(), 333U), steps.end());
  for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_LE(steps[i] - steps[i - 1], 7U);
}

}  // namespace
}  // namespace endowire::io

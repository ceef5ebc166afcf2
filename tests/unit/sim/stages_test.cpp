// Who listens to the stages of a step changes nothing, and hears of all of them.
#include <gtest/gtest.h>

#include <array>

#include "endowire/base/stage.hpp"
#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

/// Counts how often each stage begins or goes on.
class Listener final : public base::StageObserver {
 public:
  base::Stage enter(base::Stage stage) noexcept override {
    const base::Stage before = now;
    now = stage;
    ++entered.at(static_cast<std::size_t>(stage));
    return before;
  }
  [[nodiscard]] int times(base::Stage stage) const { return entered.at(static_cast<std::size_t>(stage)); }

  base::Stage now = base::Stage::outside;
  std::array<int, base::kStages> entered{};
};

Simulation bent() {
  return {test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {}};
}

// Breaks when a result comes to depend on who watches.
TEST(Stages, AnObservedRunHasTheBitsOfAnUnobservedOne) {
  Listener listener;
  Simulation alone = bent();
  Simulation observed = bent();
  observed.observe_stages(&listener);
  for (int i = 0; i < 80; ++i) {
    const Command command{i % 7 == 6 ? -0.5 : 1.0, 0.05};
    ASSERT_EQ(alone.step(command).newton_iterations, observed.step(command).newton_iterations) << i;
    ASSERT_EQ(alone.state_hash(), observed.state_hash()) << i;
  }
}

// Breaks when a stage is no longer told, or one of its scopes does not give back the stage around it.
TEST(Stages, EveryStageIsToldAndLeft) {
  Listener listener;
  Simulation simulation = bent();
  simulation.observe_stages(&listener);
  test::run(simulation, 40, {1.0, 0.05});
  for (int i = 0; i < 40; ++i) {
    listener.entered = {};
    const StepReport& report = simulation.step({1.0, 0.05});
    ASSERT_EQ(listener.now, base::Stage::outside) << i;
    ASSERT_EQ(listener.times(base::Stage::outside), 1) << i;
    if (report.splits > 0) continue;  // the report tells of the last piece alone
    EXPECT_EQ(listener.times(base::Stage::factorise), report.solve.factorisations) << i;
    EXPECT_EQ(listener.times(base::Stage::place), 1) << i;
    EXPECT_GT(listener.times(base::Stage::linearise), report.solve.iterations) << i;
    for (const base::Stage stage : {base::Stage::predict, base::Stage::detect, base::Stage::contact_model,
                                    base::Stage::line_search, base::Stage::verify, base::Stage::rest})
      EXPECT_GT(listener.times(stage), 0) << i << ", stage " << static_cast<int>(stage);
  }
}

// An observer may go before the simulation does, if it says so.
TEST(Stages, ADismissedObserverHearsNothing) {
  Simulation simulation = bent();
  Listener listener;
  simulation.observe_stages(&listener);
  test::run(simulation, 3, {1.0, 0.0});
  simulation.observe_stages(nullptr);
  const std::array<int, base::kStages> before = listener.entered;
  test::run(simulation, 3, {1.0, 0.0});
  EXPECT_EQ(listener.entered, before);
  EXPECT_GT(listener.times(base::Stage::rest), 0);
}

}  // namespace
}  // namespace endowire::sim

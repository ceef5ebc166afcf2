// Equal histories give equal bits: across runs, and after a state was saved and put back into another simulation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "endowire/vessel/random.hpp"
#include "support/fields.hpp"
#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

struct Case {
  std::string name;
  test::FieldPointer field;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

/// Seeded hands: in, out, round, sometimes in one long command that is cut into pieces.
std::vector<Command> hands(int steps) {
  vessel::SplitMix random(7);
  std::vector<Command> commands;
  for (int i = 0; i < steps; ++i) {
    const double advance = random.uniform(-0.5, 1.5) * (i % 17 == 16 ? 3.0 : 1.0);
    commands.push_back({advance, random.uniform(-0.15, 0.2)});
  }
  return commands;
}

class Determinism : public testing::TestWithParam<Case> {
 protected:
  Simulation make() const { return {GetParam().field, test::curved_tip_wire(), test::origin_access(), {}}; }
};

// Breaks with an uninitialised number, an address that enters a result, or a global.
TEST_P(Determinism, TwoRunsHaveEqualHashesAtEveryStep) {
  Simulation a = make();
  Simulation b = make();
  int converged = 0;
  std::uint64_t last = 0;
  int changed = 0;
  for (const Command& command : hands(150)) {
    const StepReport& ra = a.step(command);
    const StepReport& rb = b.step(command);
    ASSERT_EQ(a.state_hash(), b.state_hash()) << "step " << a.state().steps;
    ASSERT_EQ(ra.newton_iterations, rb.newton_iterations);
    ASSERT_EQ(ra.push_force_n, rb.push_force_n);
    ASSERT_EQ(ra.max_force_5mm_n, rb.max_force_5mm_n);
    converged += ra.converged;
    changed += a.state_hash() != last;
    last = a.state_hash();
  }
  EXPECT_EQ(converged, 150);
  EXPECT_EQ(changed, 150);
  EXPECT_GT(a.state().inserted_mm, 60.0);
}

// A state is all that a simulation remembers. Breaks when something that shapes the next step (a lagged force, a trust
// radius, a detected wall) is kept beside it.
TEST_P(Determinism, ARestoredStateGoesOnAsTheOriginal) {
  const std::vector<Command> commands = hands(150);
  for (const int middle : {0, 1, 30, 77, 149}) {
    Simulation original = make();
    for (int i = 0; i < middle; ++i) original.step(commands[static_cast<std::size_t>(i)]);
    const State saved = original.state();
    Simulation other = make();
    // Another past, which must not show.
    for (int i = 0; i < 40; ++i) other.step({1.0, -0.1});
    other.restore(saved);
    ASSERT_EQ(other.state_hash(), original.state_hash());
    ASSERT_TRUE(other.state() == saved);
    for (std::size_t i = static_cast<std::size_t>(middle); i < commands.size(); ++i) {
      original.step(commands[i]);
      other.step(commands[i]);
      ASSERT_EQ(other.state_hash(), original.state_hash()) << "saved after " << middle << ", step " << i;
    }
  }
}

// Back to an earlier state in the same simulation, and the same way again.
TEST_P(Determinism, AnEarlierStateCanBeRepeated) {
  const std::vector<Command> commands = hands(80);
  Simulation simulation = make();
  for (int i = 0; i < 40; ++i) simulation.step(commands[static_cast<std::size_t>(i)]);
  const State saved = simulation.state();
  std::vector<std::uint64_t> first;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 40; i < 80; ++i) {
      simulation.step(commands[i]);
      if (round == 0) {
        first.push_back(simulation.state_hash());
      } else {
        ASSERT_EQ(simulation.state_hash(), first[i - 40]) << i;
      }
    }
    simulation.restore(saved);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Determinism,
                         testing::Values(Case{"straight", test::straight_tube()},
                                         Case{"bent", test::bent_tube()},
                                         Case{"narrow_bend", test::bent_tube(1.0)},
                                         Case{"dead_end", std::make_shared<test::DeadEndField>(3.0, 45.0)}),
                         [](const auto& instance) { return instance.param.name; });

// Breaks when a field is added to the state and forgotten in its hash: two different runs would be called the same.
TEST(StateHash, SeesEveryField) {
  Simulation simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
  test::run(simulation, 60, {1.0, 0.05});
  const State base = simulation.state();
  ASSERT_GT(base.friction.arc_mm.size(), 10U);
  const auto nudge = [](double& v) { v = std::nextafter(v, 1e300); };
  const std::vector<std::pair<std::string, std::function<void(State&)>>> changes{
      {"inserted", [&](State& s) { nudge(s.inserted_mm); }},
      {"hand turn", [&](State& s) { nudge(s.hand_turn_rad); }},
      {"grip stretch", [&](State& s) { nudge(s.grip_stretch_mm); }},
      {"grip twist", [&](State& s) { nudge(s.grip_twist_rad); }},
      {"steps", [](State& s) { ++s.steps; }},
      {"joints", [&](State& s) { nudge(s.joints_mm[3].y()); }},
      {"last joint", [&](State& s) { nudge(s.joints_mm.back().z()); }},
      {"directors", [&](State& s) { nudge(s.directors[2].x()); }},
      {"spin", [&](State& s) { nudge(s.spin_rad[1]); }},
      {"twist", [&](State& s) { nudge(s.twist_rad[4]); }},
      {"friction arc", [&](State& s) { nudge(s.friction.arc_mm[5]); }},
      {"anchor along", [&](State& s) { nudge(s.friction.traction_n_per_mm[5].x()); }},
      {"anchor around", [&](State& s) { nudge(s.friction.traction_n_per_mm[6].y()); }},
      {"normal force", [&](State& s) { nudge(s.friction.normal_n_per_mm[7]); }},
      {"arcs", [&](State& s) { nudge(s.arc_mm[3]); }},
      {"drift advance", [&](State& s) { nudge(s.drift.advance_mm); }},
      {"drift slip", [&](State& s) { nudge(s.drift.slip_mm); }},
      {"drift arc", [&](State& s) { nudge(s.drift.arc_mm[2]); }},
      {"drift of a joint", [&](State& s) { nudge(s.drift.joints_mm[2].y()); }},
      {"drift forgotten", [](State& s) { s.drift.arc_mm.clear(), s.drift.joints_mm.clear(); }},
      {"a joint more", [](State& s) { s.joints_mm.push_back(s.joints_mm.back()); }},
      {"friction forgotten", [](State& s) { s.friction.clear(); }},
      {"two joints swapped", [](State& s) { std::swap(s.joints_mm[2], s.joints_mm[3]); }},
  };
  std::vector<std::uint64_t> hashes{base.hash()};
  for (const auto& [name, change] : changes) {
    State other = base;
    change(other);
    EXPECT_FALSE(other == base) << name;
    EXPECT_NE(other.hash(), base.hash()) << name;
    hashes.push_back(other.hash());
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end())
      << "two different states share a hash";
  State same = base;
  EXPECT_EQ(same.hash(), base.hash());
}

}  // namespace
}  // namespace endowire::sim

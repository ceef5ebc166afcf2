// A random hand in real vessels: every step converges, few are split, one detection a step unless it snaps, and the judge, which shares
// nothing with our contact, finds no crossing.
#include <gtest/gtest.h>

#include <cstdio>
#include <initializer_list>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/seeded_hand.hpp"
#include "support/temporary_folder.hpp"
#include "vessel_run.hpp"

namespace endowire {
namespace {

/// A vessel, where the wire enters it, and how much of the wire may go in: more than the vessel is long, so that the wire
/// also meets its ends, closed or open.
struct Entry {
  const char* vessel;
  std::uint64_t seed;
  double most_mm;
  int opening;  ///< 0: at the place below
  sim::Access access;
  int steps = 2000;
};

std::ostream& operator<<(std::ostream& out, const Entry& entry) {
  return out << entry.vessel << ", seed " << entry.seed;
}

class RandomHand : public testing::TestWithParam<Entry> {};

TEST_P(RandomHand, ConvergesSplitsRarelyDetectsOnceAndCrossesNoWall) {
  const Entry& entry = GetParam();
  const test::Vessel* vessel = test::shared_vessel(entry.vessel);
  if (vessel == nullptr) GTEST_SKIP() << "../shared/vessels/" << entry.vessel << " is not here";
  const sim::Access access = entry.opening > 0 ? vessel->through_opening(entry.opening) : entry.access;
  test::SeededHand hand(entry.seed, entry.most_mm);
  const test::TemporaryFolder folder;
  const test::RunFigures run = test::play(
      *vessel, access, entry.steps,
      [&hand](const sim::Simulation& now) { return hand.next(now.state().inserted_mm); }, folder.path());
  std::printf("%s, seed %d: %s\n", entry.vessel, static_cast<int>(entry.seed), run.text().c_str());
  test::expect_all_that_must_hold(run);
  EXPECT_GT(run.most_inserted_mm, 50.0) << "the hand went nowhere";
}

Entry entry(const char* vessel, std::uint64_t seed) {
  for (const Entry& known : std::initializer_list<Entry>{
           {"femoral_to_neuro", seed, 620.0, 0, {{-30.0, 66.5, 6.5}, {-0.75, -0.65, 0.15}}},
           {"femoral_to_neuro_fine", seed, 620.0, 3, {}},
           {"aortoiliac", seed, 120.0, 0, {{211.2, 106.8, 29.9}, {0.2, 0.97, -0.11}}},
           {"carotid_bifurcation", seed, 130.0, 1, {}},
           {"branching_phantom", seed, 380.0, 8, {}}}) {
    if (std::string(known.vessel) == vessel) return known;
  }
  throw std::invalid_argument(vessel);
}

std::vector<Entry> entries(std::uint64_t first_seed, std::uint64_t last_seed, int steps = 2000) {
  std::vector<Entry> out;
  for (const char* vessel : {"femoral_to_neuro", "femoral_to_neuro_fine", "aortoiliac", "carotid_bifurcation",
                             "branching_phantom"}) {
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      out.push_back(entry(vessel, seed));
      out.back().steps = steps;
    }
  }
  return out;
}

std::string name_of(const testing::TestParamInfo<Entry>& entry) {
  return std::string(entry.param.vessel) + "_" + std::to_string(entry.param.seed);
}

INSTANTIATE_TEST_SUITE_P(Vessels, RandomHand, testing::ValuesIn(entries(1, 1)), name_of);
INSTANTIATE_TEST_SUITE_P(Long, RandomHand, testing::ValuesIn(entries(2, 12)), name_of);
// With tests/vessels/generated_hand_test.cpp, a million commands.
INSTANTIATE_TEST_SUITE_P(LongEndurance, RandomHand, testing::ValuesIn(entries(101, 104, 20000)), name_of);

}  // namespace
}  // namespace endowire

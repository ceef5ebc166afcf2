// A random hand in real vessels: every step converges, few are split, one detection a step, and the judge, which shares
// nothing with our contact, finds no crossing.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>

#include "support/seeded_hand.hpp"
#include "support/temporary_folder.hpp"
#include "vessel_run.hpp"

namespace endowire {
namespace {

constexpr int kSteps = 2000;

/// A vessel, where the wire enters it, and how much of the wire may go in: more than the vessel is long, so that the wire
/// also meets its ends, closed or open.
struct Entry {
  const char* vessel;
  std::uint64_t seed;
  double most_mm;
  int opening;  ///< 0: at the place below
  sim::Access access;
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
      *vessel, access, kSteps,
      [&hand](const sim::Simulation& now) { return hand.next(now.state().inserted_mm); }, folder.path());
  std::printf("%s, seed %d: %s\n", entry.vessel, static_cast<int>(entry.seed), run.text().c_str());
  test::expect_all_that_must_hold(run);
  EXPECT_GT(run.most_inserted_mm, 50.0) << "the hand went nowhere";
}

INSTANTIATE_TEST_SUITE_P(
    Vessels, RandomHand,
    testing::Values(Entry{"femoral_to_neuro", 1, 620.0, 0, {{-30.0, 66.5, 6.5}, {-0.75, -0.65, 0.15}}},
                    Entry{"femoral_to_neuro_fine", 1, 620.0, 3, {}},
                    Entry{"carotid_bifurcation", 1, 130.0, 1, {}},
                    Entry{"branching_phantom", 1, 380.0, 8, {}}),
    [](const testing::TestParamInfo<Entry>& entry) { return std::string(entry.param.vessel); });

}  // namespace
}  // namespace endowire

// A random hand in vessels made in code, of several people each: what holds in real vessels holds here.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "endowire/vessel/generate.hpp"
#include "support/seeded_hand.hpp"
#include "support/temporary_folder.hpp"
#include "support/thin_wire.hpp"
#include "vessel_run.hpp"

namespace endowire {
namespace {

struct Person {
  const char* anatomy;
  std::uint64_t seed;  ///< of the anatomy and of the hand
  bool thin;           ///< whether a coronary wire is what fits
  int steps;
};

std::ostream& operator<<(std::ostream& out, const Person& person) {
  return out << person.anatomy << ", seed " << person.seed;
}

class GeneratedHand : public testing::TestWithParam<Person> {};

TEST_P(GeneratedHand, ConvergesSplitsRarelyDetectsOnceAndCrossesNoWall) {
  const Person& person = GetParam();
  vessel::GenerateRequest request;
  request.name = person.anatomy;
  request.seed = person.seed;
  const vessel::GeneratedVessel made = vessel::generate(request);
  const test::TemporaryFolder folder;
  const test::Vessel vessel = test::made_vessel(made.mesh, folder.path());
  test::SeededHand hand(person.seed, 1.1 * made.route_mm);
  const test::RunFigures run = test::play(
      vessel, {made.access_position_mm, made.access_direction}, person.steps,
      [&hand](const sim::Simulation& now) { return hand.next(now.state().inserted_mm); }, folder.path(),
      person.thin ? test::thin_wire() : test::hydrophilic_wire());
  std::printf("%s, seed %d: %s\n", person.anatomy, static_cast<int>(person.seed), run.text().c_str());
  test::expect_all_that_must_hold(run);
  EXPECT_GT(run.most_inserted_mm, 50.0) << "the hand went nowhere";
}

std::vector<Person> people(std::uint64_t first_seed, std::uint64_t last_seed, int steps) {
  std::vector<Person> out;
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    for (const char* anatomy : {"aortic_arch", "iliofemoral", "renal"})
      out.push_back({anatomy, seed, false, steps});
    for (const char* anatomy : {"coronary", "carotid_siphon"}) out.push_back({anatomy, seed, true, steps});
  }
  return out;
}

std::string name_of(const testing::TestParamInfo<Person>& person) {
  return std::string(person.param.anatomy) + "_" + std::to_string(person.param.seed);
}

INSTANTIATE_TEST_SUITE_P(Vessels, GeneratedHand, testing::ValuesIn(people(1, 1, 1000)), name_of);
INSTANTIATE_TEST_SUITE_P(LongEndurance, GeneratedHand, testing::ValuesIn(people(2, 6, 20000)), name_of);

}  // namespace
}  // namespace endowire

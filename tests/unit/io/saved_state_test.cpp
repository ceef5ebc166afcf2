#include "endowire/io/saved_state.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "endowire/base/error.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/repair.hpp"
#include "endowire/vessel/storage.hpp"
#include "support/generated_meshes.hpp"
#include "support/hand_made_trees.hpp"
#include "support/simulations.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

constexpr std::uint64_t scene_key = 0x1234;

/// A curved tip that leans on the wall of a tube made of triangles, with all that is remembered of it.
class SavedStateTest : public ::testing::Test {
 protected:
  SavedStateTest() {
    for (int i = 0; i < 40; ++i) step();
    saved_.seed = 7;
    saved_.state = wire_.state();
    saved_.events = watch_.memory();
    saved_.last = snapshot_;
    bytes_ = pack_state(saved_, scene_key);
  }
  void step() {
    const sim::Command command{1.0, 0.05};
    const sim::StepReport& report = wire_.step(command);
    wire_.snapshot(snapshot_);
    static_cast<void>(watch_.after(command, report, snapshot_));
  }
  static sim::Simulation begin() {
    static const auto field = std::make_shared<const vessel::MeshField>(
        vessel::MeshField::build(vessel::repair(test::closed_tube(3.0, 100.0, 24, 40), "tube")));
    return {field, test::curved_tip_wire(), sim::Access{{0.0, 0.0, 5.0}, Eigen::Vector3d::UnitZ()},
            sim::SimulationSpec{}};
  }

  std::shared_ptr<const vessel::CentrelineTree> tree_ =
      std::make_shared<const vessel::CentrelineTree>(test::bent_tube_tree());
  sim::Simulation wire_ = begin();
  sim::EventWatch watch_{tree_};
  sim::Snapshot snapshot_;
  SavedState saved_;
  std::string bytes_;
};

TEST_F(SavedStateTest, EveryBitComesBack) {
  const SavedState read = unpack_state(bytes_, scene_key, "state");
  EXPECT_EQ(read.seed, saved_.seed);
  EXPECT_EQ(read.state, saved_.state);
  EXPECT_GT(read.state.friction.arc_mm.size(), 0U);  // there is something to lose
  EXPECT_EQ(pack_state(read, scene_key), bytes_);    // events and forces too
  ASSERT_EQ(read.last.points.size(), snapshot_.points.size());
  EXPECT_EQ(read.last.points[3].position_mm, snapshot_.points[3].position_mm);
  EXPECT_EQ(read.last.push_force_n, snapshot_.push_force_n);
  EXPECT_EQ(read.events.tip_then_mm, watch_.memory().tip_then_mm);
  for (std::size_t k = 0; k < sim::event_kinds; ++k)
    EXPECT_EQ(read.events.episodes[k].sign.kind, static_cast<sim::EventKind>(k));
}

TEST_F(SavedStateTest, NoSeedIsNotASeedOfNought) {
  saved_.seed.reset();
  EXPECT_EQ(unpack_state(pack_state(saved_, scene_key), scene_key, "state").seed, std::nullopt);
  saved_.seed = 0;
  EXPECT_EQ(unpack_state(pack_state(saved_, scene_key), scene_key, "state").seed, 0U);
}

// A step that failed may leave a residual that is no number; the wire can be saved all the same.
TEST_F(SavedStateTest, TheSignOfAFailedStepMayBeNoNumber) {
  saved_.events.episodes[6].sign.value = std::numeric_limits<double>::quiet_NaN();
  const SavedState read = unpack_state(pack_state(saved_, scene_key), scene_key, "state");
  EXPECT_TRUE(std::isnan(read.events.episodes[6].sign.value));
}

TEST_F(SavedStateTest, BytesCutAnywhereAreRefused) {
  for (std::size_t size = 0; size < bytes_.size(); ++size)
    EXPECT_THROW(static_cast<void>(unpack_state(bytes_.substr(0, size), scene_key, "state")),
                 base::InputError)
        << size;
  EXPECT_THROW(static_cast<void>(unpack_state(bytes_ + '\0', scene_key, "state")), base::InputError);
}

TEST_F(SavedStateTest, AnyFlippedBitIsNoticed) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    EXPECT_THROW(static_cast<void>(unpack_state(damaged, scene_key, "state")), base::InputError) << at;
  }
}

TEST_F(SavedStateTest, MessagesSayWhatIsWrong) {
  EXPECT_EQ(
      test::message_of<base::InputError>(
          [&] { static_cast<void>(unpack_state(bytes_, scene_key + 1, "state")); }),
      "state: saved state is unusable: it belongs to another scene, instrument or vessel; must be written by "
      "this version");
  saved_.last.points[0].position_mm.x() += 1.0;
  EXPECT_EQ(test::message_of<base::InputError>(
                [&] { static_cast<void>(unpack_state(pack_state(saved_, scene_key), scene_key, "state")); }),
            "state: saved state is unusable: its forces are not those of its shape; must be written by this "
            "version");
  saved_.last.points[0].position_mm.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(test::message_of<base::InputError>(
                [&] { static_cast<void>(unpack_state(pack_state(saved_, scene_key), scene_key, "state")); }),
            "state: saved state is unusable: a number is not finite; must be written by this version");
}

/// As someone would write it who knows the format.
std::string sealed(std::string bytes) {
  const auto payload =
      std::as_bytes(std::span(bytes.data(), bytes.size())).subspan(vessel::storage_header_bytes);
  const std::array<std::uint64_t, 2> tail{payload.size(), vessel::storage_checksum(payload)};
  std::memcpy(bytes.data() + 24, tail.data(), sizeof tail);
  return bytes;
}

// Whoever forges a sound header gets a wire in a strange place at worst: the sanitizers watch. Seeded, the same in every run.
TEST_F(SavedStateTest, ForgedNumbersAreRefusedOrStepped) {
  constexpr int forgeries = 600;
  constexpr std::array<double, 8> numbers{0.0,    -0.0, 1e308, -1e308,
                                          1e-308, 1e9,  -50.0, std::numeric_limits<double>::quiet_NaN()};
  vessel::SplitMix random(1);
  int refused = 0;
  int stepped = 0;
  for (int i = 0; i < forgeries; ++i) {
    std::string forged = bytes_;
    const std::size_t words = (bytes_.size() - vessel::storage_header_bytes - 9) / 8;
    const std::size_t at = vessel::storage_header_bytes + 9 + 8 * (random.next() % words);
    if (i % 2 == 0)
      std::memcpy(forged.data() + at, &numbers[random.next() % numbers.size()], 8);
    else
      forged[at + random.next() % 8] = static_cast<char>(random.next());
    try {
      const SavedState read = unpack_state(sealed(forged), scene_key, "state");
      wire_.restore(read.state);
      watch_.restore(read.events);
      static_cast<void>(tree_->branch_at(read.last.points.front().position_mm));
      step();
      ++stepped;
    } catch (const base::InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, forgeries / 50);
  EXPECT_GT(stepped, forgeries / 10);
  EXPECT_EQ(refused + stepped, forgeries);
}

}  // namespace
}  // namespace endowire::io

#include "endowire/io/prepared_scene.hpp"

#include <gtest/gtest.h>

#include <string>

#include "endowire/base/error.hpp"
#include "endowire/io/places.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

const std::string arch = R"(schema = 1
[vessel]
generate = "aortic_arch"
[[instrument]]
model = "hydrophilic_035_angled"
)";

PreparedScene prepared(const std::string& more) {
  static const test::TemporaryFolder cache;
  return prepare_scene(
      parse_scene(arch + more, "arch.toml", instrument_folders({}, ENDOWIRE_SOURCE_DIR), Script::optional),
      cache / "cache");
}

TEST(PreparedScene, HoldsAllThatASimulationNeeds) {
  const PreparedScene scene = prepared("[target]\nbranch = \"1.2\"\nbeyond_ostium_mm = 60.0\n");
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.centrelines->branches()[static_cast<std::size_t>(scene.target->branch)].name, "1.2");
  // The access is the generated vessel's own, which the text does not give.
  EXPECT_GT(scene.prepared.field->at(scene.scene.access.position_mm).distance_mm, 2.0);
  sim::Simulation one = simulation_of(scene);
  sim::Simulation other = simulation_of(scene);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(one.step({1.0, 0.0}).converged);
    EXPECT_TRUE(other.step({1.0, 0.0}).converged);
  }
  EXPECT_EQ(one.state_hash(), other.state_hash());
  EXPECT_GT(one.state().joints_mm.size(), 2U);
}

// What the vessel alone can tell is told as if the file had been wrong: with its name.
TEST(PreparedScene, MessagesBeginWithTheScene) {
  EXPECT_EQ(test::message_of<base::InputError>([] {
              static_cast<void>(prepared("[target]\nbranch = \"9\"\n"));
            }).rfind("arch.toml: target.branch is \"9\"; must be one of 1", 0),
            0U);
  const PreparedScene outside =
      prepared("[access]\nposition_mm = [0.0, 0.0, 5000.0]\ndirection = [0.0, 0.0, 1.0]\n");
  const std::string message =
      test::message_of<base::InputError>([&] { static_cast<void>(simulation_of(outside)); });
  EXPECT_EQ(message.rfind("arch.toml: access.position_mm is [0, 0, 5000]", 0), 0U) << message;
}

TEST(Places, InstrumentsAreLookedForBesideTheProgramBeforeTheSourceTree) {
  const auto folders = instrument_folders("/opt/bin", "/src");
  ASSERT_GE(folders.size(), 3U);
  const auto last = folders.end() - 3;
  EXPECT_EQ(last[0], "/opt/bin/instruments");
  EXPECT_EQ(last[1].lexically_normal(), "/opt/share/endowire/instruments");
  EXPECT_EQ(last[2], "/src/instruments");
}

}  // namespace
}  // namespace endowire::io

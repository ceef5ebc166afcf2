#include "endowire/io/recorded_scene.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "support/temporary_folder.hpp"
#include "support/wires.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

RecordingHeader header_for(const std::string& vessel_line, const std::string& vessel, std::uint64_t content) {
  RecordingHeader header;
  header.scene_name = "s.toml";
  header.scene_text =
      "schema = 1\n[vessel]\n" + vessel_line +
      "\n[access]\nopening = 1\n[[instrument]]\nmodel = \"gone\"\n[[motion]]\nduration_s = 1.0\n";
  header.vessel = vessel;
  header.vessel_hash = content;
  header.instrument = test::hydrophilic_035_angled();
  return header;
}

TEST(RecordedScene, FindsTheMeshByItsContent) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "run");
  test::write_text(folder / "run/v.stl", "another mesh of that name");
  test::write_text(folder / "moved.stl", "the mesh");
  const RecordingHeader header = header_for("file = \"v.stl\"", "v.stl", content_hash("the mesh"));
  const std::filesystem::path recording = folder / "run/recording.jsonl";
  EXPECT_EQ(recorded_scene(header, recording, folder / "moved.stl").vessel.file, folder / "moved.stl");
  EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(recorded_scene(header, recording)); }),
            recording.string() + ": vessel " + (folder / "run/v.stl").string() + " has content " +
                hash_text(content_hash("another mesh of that name")) + "; must be " +
                hash_text(header.vessel_hash) + ", as it was recorded");
  test::write_text(folder / "run/v.stl", "the mesh");
  EXPECT_EQ(recorded_scene(header, recording).vessel.file, folder / "run/v.stl");
}

TEST(RecordedScene, AGeneratedVesselIsCheckedOnceItIsMade) {
  const RecordingHeader header = header_for("generate = \"aortic_arch\"", "generate:aortic_arch", 7);
  EXPECT_TRUE(recorded_scene(header, "r.jsonl").vessel.file.empty());
  check_recorded_vessel(header, "r.jsonl", 7);
  EXPECT_EQ(message_of<base::InputError>([&] { check_recorded_vessel(header, "r.jsonl", 8); }),
            "r.jsonl: vessel generate:aortic_arch has content 0000000000000008; must be 0000000000000007, as "
            "it was "
            "recorded");
}

}  // namespace
}  // namespace endowire::io

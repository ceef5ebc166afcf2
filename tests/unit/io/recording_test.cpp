#include "endowire/io/recording.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

RecordingHeader example_header() {
  RecordingHeader header;
  header.version = "0.1.0";
  header.scene_name = "a \"quoted\" scene.toml";
  header.scene_text = "schema = 1\n# ünïcode and\ttabs\n";
  header.vessel = "v.stl";
  header.vessel_hash = 0xfedcba9876543210ULL;
  header.instrument.model = "wire";
  header.instrument.sections.resize(2);
  header.instrument.sections[1].friction = 1.0 / 3.0;
  return header;
}

std::string write_example(const std::filesystem::path& path) {
  RecordingWriter writer(path, example_header());
  for (std::uint64_t step = 1; step <= 5; ++step) {
    writer.command({step, 0.1 * static_cast<double>(step), {1.0 / 3.0, -1e-17 * static_cast<double>(step)}});
    if (step % 2 == 0) writer.state({step, 0x0123456789abcdefULL * step});
  }
  writer.end(5);
  return test::read_text(path);
}

TEST(Recording, GivesTheSameBitsBack) {
  const TemporaryFolder folder;
  write_example(folder / "r.jsonl");
  const Recording recording = read_recording(folder / "r.jsonl");
  EXPECT_TRUE(recording.header == example_header());
  EXPECT_TRUE(recording.complete);
  ASSERT_EQ(recording.commands.size(), 5U);
  for (std::uint64_t step = 1; step <= 5; ++step) {
    const RecordedCommand& command = recording.commands[step - 1];
    EXPECT_EQ(command.step, step);
    EXPECT_EQ(command.time_s, 0.1 * static_cast<double>(step));
    EXPECT_EQ(command.command.advance_mm, 1.0 / 3.0);
    EXPECT_EQ(command.command.torque_rad, -1e-17 * static_cast<double>(step));
  }
  ASSERT_EQ(recording.hashes.size(), 2U);
  EXPECT_EQ(recording.hashes[1].step, 4U);
  EXPECT_EQ(recording.hashes[1].state_hash, 0x0123456789abcdefULL * 4);
}

TEST(Recording, EachLineIsOnDiskAsSoonAsItIsWritten) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder / "r.jsonl", example_header());
  writer.command({1, 0.5, {1.0, 0.0}});
  const Recording recording = read_recording(folder / "r.jsonl");  // the writer still holds the file
  EXPECT_EQ(recording.commands.size(), 1U);
  EXPECT_FALSE(recording.complete);
}

TEST(Recording, CutAtAnyByteReadsUpToItsLastWholeLine) {
  const TemporaryFolder folder;
  const std::string whole = write_example(folder / "r.jsonl");
  const std::size_t header_end = whole.find('\n');
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    const std::string text = whole.substr(0, cut);
    if (cut <= header_end) {
      EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(parse_recording(text, "r")); }),
                "r: has no whole line; must begin with a header");
      continue;
    }
    std::size_t commands = 0;
    for (std::size_t at = text.find("\"kind\":\"command\""); at != std::string::npos;
         at = text.find("\"kind\":\"command\"", at + 1))
      if (text.find('\n', at) != std::string::npos) ++commands;
    const Recording recording = parse_recording(text, "r");
    ASSERT_EQ(recording.commands.size(), commands) << "cut at byte " << cut;
    ASSERT_EQ(recording.complete, cut == whole.size()) << "cut at byte " << cut;
  }
}

TEST(Recording, DamageIsNamedByItsLine) {
  const TemporaryFolder folder;
  const std::string whole = write_example(folder / "r.jsonl");
  const auto message = [](const std::string& text) {
    return message_of<base::InputError>([&] { static_cast<void>(parse_recording(text, "r")); });
  };
  const std::size_t second = whole.find('\n') + 1;
  EXPECT_EQ(message(whole.substr(second)), "r: line 1: the first line is no header");
  EXPECT_EQ(message(whole.substr(0, second) + whole.substr(0, second)), "r: line 2: a second header");
  EXPECT_EQ(message(whole.substr(0, second) + "{\"kind\":\"dance\"}\n"),
            "r: line 2: \"dance\" is no kind of line");
  EXPECT_EQ(message(whole.substr(0, second) + whole.substr(whole.find('\n', second) + 1)),
            "r: line 2: step is 2; must be 1");
  EXPECT_EQ(message(whole.substr(0, second) + "{\"kind\":\"state\",\"step\":1,\"state_hash\":\"xyz\"}\n"),
            "r: line 2: \"xyz\" is no hash");
  EXPECT_EQ(message(whole.substr(0, second) + "nonsense\n").rfind("r: line 2: ", 0), 0U);
  std::string newer = whole;
  newer.replace(newer.find("\"schema\":1"), 10, "\"schema\":2");
  EXPECT_EQ(message(newer), "r: line 1: schema is 2; must be 1");
}

TEST(Recording, APlaceThatCannotBeWrittenIsNamed) {
  EXPECT_EQ(message_of<base::InputError>([] { RecordingWriter("/nonexistent/r.jsonl", example_header()); }),
            "/nonexistent/r.jsonl: cannot be written");
}

}  // namespace
}  // namespace endowire::io

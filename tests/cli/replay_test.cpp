// A recording played again: the same states and files, whatever became of the recording in between.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "endowire/io/recording.hpp"
#include "endowire/io/vtp.hpp"
#include "program.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

/// A run in `run/`, recorded.
class Replay : public ::testing::Test {
 protected:
  Replay() {
    test::write_text(folder_ / "v.stl", test::tube_stl(4.0, 60.0));
    test::write_text(folder_ / "s.toml", test::tube_scene);
    const Outcome outcome = run_endowire(
        folder_, {"simulate", "s.toml", "--out", "run", "--cache", test::test_cache(), "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    recorded_ = test::read_text(folder_ / "run/recording.jsonl");
  }

  Outcome replay(const std::string& recording, const std::vector<std::string>& more = {"--quiet"}) const {
    std::vector<std::string> arguments{"replay", recording, "--out", "again", "--cache", test::test_cache()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_endowire(folder_, arguments);
  }

  /// What replaying a changed recording gives.
  Outcome replay_text(const std::string& text) const {
    test::write_text(folder_ / "r.jsonl", text);
    return replay("r.jsonl");
  }

  std::string replaced(const std::string& from, const std::string& to) const {
    std::string text = recorded_;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  json summary(const std::string& run) const {
    json summary = json::parse(test::read_text(folder_ / run / "summary.json"));
    summary.erase("machine");
    return summary;
  }

  TemporaryFolder folder_;
  std::string recorded_;
};

void expect_one_line(const Outcome& outcome, const std::string& text) {
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
}

TEST_F(Replay, GivesTheSameStatesAndFiles) {
  const Outcome outcome = replay("run/recording.jsonl", {});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("reproduced         2 of 2 state hashes"), std::string::npos) << outcome.out;
  EXPECT_EQ(summary("again"), summary("run"));
  std::vector<std::string> files{"recording.jsonl", "wire.svg"};
  if (io::vtp_available()) files.insert(files.end(), {"wire.vtp", "wire.pvd", "steps/wire_000013.vtp"});
  for (const std::string& name : files)
    EXPECT_EQ(test::read_text(folder_ / "again" / name), test::read_text(folder_ / "run" / name)) << name;
}

TEST_F(Replay, CutAtAnyByteGoesUpToItsLastWholeLineAndSaysSo) {
  const std::size_t header = recorded_.find('\n') + 1;
  std::vector<std::size_t> cuts;
  for (std::size_t cut = header; cut + 1 < recorded_.size(); cut += 71) cuts.push_back(cut);
  cuts.insert(cuts.end(), {header + 1, recorded_.size() - 2, recorded_.size() - 1});
  for (const std::size_t cut : cuts) {
    const std::string text = recorded_.substr(0, cut);
    const std::size_t steps = io::parse_recording(text, "r").commands.size();
    const Outcome outcome = replay_text(text);
    ASSERT_EQ(outcome.code, 0) << "cut at byte " << cut << ": " << outcome.err;
    expect_one_line(outcome, "r.jsonl: was cut off; replayed up to step " + std::to_string(steps));
    ASSERT_EQ(summary("again")["steps"], steps) << "cut at byte " << cut;
    ASSERT_EQ(summary("again")["converged_steps"], steps);
  }
  for (const std::size_t cut : {std::size_t{1}, header / 2, header - 1}) {
    const Outcome outcome = replay_text(recorded_.substr(0, cut));
    EXPECT_EQ(outcome.code, 2);
    expect_one_line(outcome, "r.jsonl: has no whole line; must begin with a header");
  }
}

// Kernels for wider registers do the same operations in the same order. Breaks with a fused or reordered sum in one of them; on a machine
// without AVX2 it compares a path with itself.
TEST_F(Replay, GivesTheSameStatesWithEveryInstructionSet) {
  const Outcome outcome = run_endowire(
      folder_, {"replay", "run/recording.jsonl", "--out", "again", "--cache", test::test_cache()},
      "ENDOWIRE_ISA=sse2");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("reproduced         2 of 2 state hashes"), std::string::npos) << outcome.out;
  EXPECT_EQ(
      json::parse(test::read_text(folder_ / "again/summary.json"))["machine"]["isa"].get<std::string>().find(
          "AVX"),
      std::string::npos);
}

TEST_F(Replay, OtherStatesAreExitFourAndNameTheStep) {
  const std::size_t at = recorded_.find("\"state_hash\":\"") + 14;
  std::string text = recorded_;
  text[at] = text[at] == '0' ? '1' : '0';
  Outcome outcome = replay_text(text);
  EXPECT_EQ(outcome.code, 4);
  expect_one_line(outcome, "r.jsonl: step 10: state ");
  // Another command: the states differ from then on, and the results are written all the same.
  text = recorded_;
  const std::size_t command = text.find("\"advance_mm\":", text.find("\"step\":10,") - 120);
  text.replace(command, 16, "\"advance_mm\":0.9");
  outcome = replay_text(text);
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  expect_one_line(outcome, "differs from the recorded");
  EXPECT_EQ(summary("again")["steps"], 20);
}

TEST_F(Replay, NeedsTheRecordedMeshWhereverItLies) {
  fs::remove(folder_ / "s.toml");  // the scene stands in the recording
  fs::rename(folder_ / "v.stl", folder_ / "run/v.stl");
  EXPECT_EQ(replay("run/recording.jsonl").code, 0);  // beside the recording
  EXPECT_EQ(summary("again"), summary("run"));
  fs::rename(folder_ / "run/v.stl", folder_ / "moved.stl");
  Outcome outcome = replay("run/recording.jsonl");
  EXPECT_EQ(outcome.code, 2);
  expect_one_line(outcome, "run/recording.jsonl: vessel v.stl (content ");
  EXPECT_EQ(replay("run/recording.jsonl", {"--vessel", "moved.stl", "--quiet"}).code, 0);
  EXPECT_EQ(summary("again"), summary("run"));
  test::write_text(folder_ / "v.stl", test::tube_stl(4.0, 61.0));
  outcome = replay("run/recording.jsonl");
  EXPECT_EQ(outcome.code, 2);
  expect_one_line(outcome, "vessel v.stl has content ");
}

TEST_F(Replay, NeverWritesOverTheRecordingItself) {
  const Outcome outcome =
      run_endowire(folder_, {"replay", "run/recording.jsonl", "--out", "run", "--cache", test::test_cache()});
  EXPECT_EQ(outcome.code, 2);
  expect_one_line(outcome, "--out: run holds the recording itself; must be another folder");
  EXPECT_EQ(test::read_text(folder_ / "run/recording.jsonl"), recorded_);
}

TEST_F(Replay, HostileRecordingsAreOneLineAndTouchNothing) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {std::string("\0\x80\xff garbage \n", 13), "r.jsonl: line 1: "},
      {std::string(100'000, '[') + "\n", "r.jsonl: line 1: "},
      {"{}\n", "r.jsonl: line 1: "},
      {replaced("\"schema\":1", "\"schema\":9"), "schema is 9; must be 1"},
      {replaced("schema = 1\\n", "schema = 1\\nrogue = 1\\n"),
       "r.jsonl: its scene: s.toml: rogue is unknown"},
      {replaced("\"vessel\":\"v.stl\"", "\"vessel\":\"/\\nabsent\""), "r.jsonl: vessel / absent"},
      {replaced("\"vessel\":\"v.stl\"", "\"vessel\":\"generate:v\""), "which is not that of its scene"},
      {replaced("\"length_mm\":", "\"length_mm\":-"), "length_mm"},
      {replaced("\"advance_mm\":1.0", "\"advance_mm\":1e300"), "advance_mm is 1e+300; must be between"},
      {replaced("\"advance_mm\":1.0", "\"advance_mm\":1e999"), "r.jsonl: line 2: "},
      {replaced("\"torque_rad\":", "\"torque_rad\":null,\"x\":"), "r.jsonl: line 2: "},
      {replaced("\"time_s\":", "\"time_s\":-"), "time_s is -0.1; must be >= 0"},
      {replaced("\"steps\":20", "\"steps\":21"), "step is 21; must be 20"},
      {recorded_ + "{\"kind\":\"end\",\"steps\":20}\n", "stands behind the end"},
  };
  for (const auto& [text, message] : cases) {
    const Outcome outcome = replay_text(text);
    EXPECT_EQ(outcome.code, 2) << message;
    expect_one_line(outcome, message);
    EXPECT_LT(outcome.err.size(), 400U) << message;
    EXPECT_FALSE(fs::exists(folder_ / "again")) << message;
  }
}

}  // namespace
}  // namespace endowire

// Whatever is wrong with the input: exit 2, one line on stderr that names it, nothing on stdout, and the
// results of an earlier run as they were.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "program.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = test::read_text(entry.path());
  return files;
}

void expect_bad_input(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(message), std::string::npos)
      << "expected: " << message << "\nbut said: " << outcome.err;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

struct Case {
  const char* name;
  std::string vessel;    // bytes of v.stl; "-" for none
  std::string from, to;  // change of the scene; none when empty
  const char* message;   // part of the line on stderr

  friend void PrintTo(const Case& bad, std::ostream* out) { *out << bad.name; }
};

std::string patched(std::string bytes, std::size_t at, const void* data, std::size_t size) {
  std::memcpy(bytes.data() + at, data, size);
  return bytes;
}

std::vector<Case> cases() {
  const std::string good = test::tube_stl(4.0, 60.0);
  const float nan = std::nanf("");
  const std::uint32_t four_billion = 0xffffffffU;
  const std::uint32_t none = 0;
  return {
      {"vessel_missing", "-", "", "", "s.toml: vessel.file is \"v.stl\"; must be an existing file"},
      {"vessel_empty", "", "", "", "v.stl: is empty"},
      {"vessel_truncated", good.substr(0, good.size() / 2), "", "", "v.stl: "},
      {"vessel_lies_about_its_count", patched(good, 80, &four_billion, 4), "", "", "v.stl: "},
      {"vessel_with_nan", patched(good, 84 + 50 * 7 + 12, &nan, 4), "", "", "v.stl: "},
      {"vessel_without_triangles", patched(good.substr(0, 84), 80, &none, 4), "", "", "v.stl: "},
      {"vessel_is_text", "hello\n", "", "", "v.stl: "},
      {"vessel_of_0_6_mm", test::tube_stl(0.04, 0.6), "", "", "v.stl: "},
      {"access_outside", good, "[0.0, 0.0, 5.0]", "[9.0, 0.0, 5.0]",
       "s.toml: access.position_mm is [9, 0, 5]"},
      {"access_far_away", good, "[0.0, 0.0, 5.0]", "[9000.0, 0.0, 5.0]",
       "s.toml: access.position_mm is [9000, 0, 5]"},
      {"wire_wider_than_lumen", test::tube_stl(0.4, 60.0), "", "", "s.toml: access.position_mm is [0, 0, 5]"},
      {"opening_that_is_not_there", good, "position_mm = [0.0, 0.0, 5.0]\ndirection = [0.0, 0.0, 1.0]",
       "opening = 3", "s.toml: access.opening is 3; must be between 1 and 2"},
      {"unknown_key", good, "[simulation]", "[simulation]\nspeed = 3",
       "s.toml: simulation.speed is unknown; known here: max_advance_mm, max_torque_deg, step_s"},
      {"unknown_unit", good, "file = \"v.stl\"", "file = \"v.stl\"\nunit = \"inch\"",
       "s.toml: vessel.unit is \"inch\""},
      {"negative_duration", good, "duration_s = 2.0", "duration_s = -1",
       "s.toml: motion[0].duration_s is -1; must be > 0"},
      {"negative_step", good, "max_advance_mm = 1.0", "max_advance_mm = -1.0",
       "s.toml: simulation.max_advance_mm is -1; must be between 0.001 and 10"},
      {"unknown_instrument", good, "hydrophilic_035_straight", "steel",
       "s.toml: instrument[0].model is \"steel\"; must be one of"},
      {"two_instruments", good, "[simulation]",
       "[[instrument]]\nmodel = \"hydrophilic_035_angled\"\n[simulation]",
       "s.toml: instrument is a list of 2; must be one"},
      {"not_toml", good, "schema = 1", "schema = = 1", "s.toml: line 1, column "},
  };
}

class BadInput : public ::testing::TestWithParam<Case> {};

TEST_P(BadInput, IsOneLineAndTouchesNothing) {
  const TemporaryFolder folder;
  const Case& bad = GetParam();
  if (bad.vessel != "-") test::write_text(folder / "v.stl", bad.vessel);
  test::write_text(folder / "s.toml",
                   bad.from.empty() ? test::tube_scene : replaced(test::tube_scene, bad.from, bad.to));
  std::filesystem::create_directories(folder / "out/steps");
  for (const char* name :
       {"summary.json", "recording.jsonl", "wire.pvd", "wire.vtp", "wire.svg", "steps/wire_000001.vtp"})
    test::write_text((folder / "out") / name, std::string("earlier ") + name);
  const auto before = contents(folder / "out");
  expect_bad_input(
      run_endowire(folder, {"simulate", "s.toml", "--out", "out", "--cache", test::test_cache()}),
      bad.message);
  EXPECT_EQ(contents(folder / "out"), before);
  // Nor is a folder made for a run that never starts.
  expect_bad_input(
      run_endowire(folder, {"simulate", "s.toml", "--out", "fresh", "--cache", test::test_cache()}),
      bad.message);
  EXPECT_FALSE(std::filesystem::exists(folder / "fresh"));
}

INSTANTIATE_TEST_SUITE_P(Simulate, BadInput, ::testing::ValuesIn(cases()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

class BadVessel : public ::testing::TestWithParam<Case> {};

TEST_P(BadVessel, IsRefusedByInspectToo) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", GetParam().vessel);
  expect_bad_input(run_endowire(folder, {"inspect", "v.stl"}), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Inspect, BadVessel, ::testing::ValuesIn([] {
                           std::vector<Case> files;
                           for (const Case& bad : cases())
                             if (std::string(bad.message) == "v.stl: " || bad.vessel.empty())
                               files.push_back(bad);
                           return files;
                         }()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(BadCommandLine, IsOneLineToo) {
  const TemporaryFolder folder;
  test::write_text(folder / "file", "precious");
  test::write_text(folder / "s.toml", test::tube_scene);
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  expect_bad_input(run_endowire(folder, {}), "endowire: A subcommand is required");
  expect_bad_input(run_endowire(folder, {"dance"}),
                   "endowire: \"dance\" is no subcommand; must be generate, inspect, instruments, prepare, "
                   "simulate or replay");
  expect_bad_input(run_endowire(folder, {"simulate"}), "SCENE is required");
  expect_bad_input(run_endowire(folder, {"simulate", "s.toml"}), "--out is required");
  expect_bad_input(run_endowire(folder, {"simulate", "s.toml", "--out", "out", "--speed"}), "--speed");
  expect_bad_input(run_endowire(folder, {"simulate", "none.toml", "--out", "out"}),
                   "none.toml: no such file");
  expect_bad_input(run_endowire(folder, {"simulate", "s.toml", "--out", "file"}),
                   "--out: file is a file; must be a folder");
  expect_bad_input(run_endowire(folder, {"inspect", "none.stl"}), "none.stl: no such file");
  expect_bad_input(
      run_endowire(folder, {"inspect", "."}),
      ".: is a folder without DICOM files; must be a file, or a folder that holds a DICOM series");
  expect_bad_input(run_endowire(folder, {"inspect", "v.stl", "--unit", "inch"}), "--unit is \"inch\"");
  expect_bad_input(run_endowire(folder, {"instruments", "steel"}),
                   "instruments: NAME is \"steel\"; must be one of");
  EXPECT_EQ(test::read_text(folder / "file"), "precious");
}

}  // namespace
}  // namespace endowire

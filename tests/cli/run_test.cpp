// What a user gets for good input.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "endowire/io/recording.hpp"
#include "endowire/io/version.hpp"
#include "endowire/io/vtp.hpp"
#include "program.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

json without_machine(const std::filesystem::path& path) {
  json summary = json::parse(test::read_text(path));
  summary.erase("machine");
  return summary;
}

std::vector<std::string> simulate(const std::string& out) {
  return {"simulate", "s.toml", "--out", out, "--cache", test::test_cache(), "--quiet"};
}

TEST(Simulate, WritesEverythingAndTheSameEachTime) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  test::write_text(folder / "s.toml", test::tube_scene);
  const Outcome first = run_endowire(folder, simulate("one"));
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.out, "") << "--quiet";
  EXPECT_EQ(first.err, "");
  const json summary = without_machine(folder / "one/summary.json");
  EXPECT_EQ(summary["steps"], 20);
  EXPECT_EQ(summary["converged_steps"], 20);
  EXPECT_NEAR(summary["instruments"][0]["inserted_length_mm"].get<double>(), 20.0, 0.1);
  EXPECT_NEAR(summary["instruments"][0]["tip_position_mm"][2].get<double>(), 25.0, 0.5);
  const io::Recording recording = io::read_recording(folder / "one/recording.jsonl");
  EXPECT_TRUE(recording.complete);
  EXPECT_EQ(recording.commands.size(), 20U);
  EXPECT_EQ(recording.hashes.back().step, 20U);
  EXPECT_EQ(recording.header.scene_text, test::tube_scene);
  EXPECT_NE(test::read_text(folder / "one/wire.svg").find("</svg>"), std::string::npos);
  if (io::vtp_available()) {
    EXPECT_TRUE(std::filesystem::exists(folder / "one/wire.vtp"));
    EXPECT_NE(test::read_text(folder / "one/wire.pvd").find("steps/wire_000020.vtp"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "one/steps/wire_000020.vtp"));
  }

  EXPECT_EQ(run_endowire(folder, simulate("two")).code, 0);
  EXPECT_EQ(without_machine(folder / "two/summary.json"), summary);
  for (const char* name : {"recording.jsonl", "wire.svg"})
    EXPECT_EQ(test::read_text((folder / "two") / name), test::read_text((folder / "one") / name)) << name;
}

TEST(Simulate, AShorterRunLeavesNoShapesOfALongerOne) {
  if (!io::vtp_available()) GTEST_SKIP() << "built without VTK";
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  std::string scene = test::tube_scene;
  test::write_text(folder / "s.toml", scene);
  EXPECT_EQ(run_endowire(folder, simulate("out")).code, 0);
  scene.replace(scene.find("advance_mm = 20.0"), 17, "advance_mm = 5.0");
  test::write_text(folder / "s.toml", scene);
  EXPECT_EQ(run_endowire(folder, simulate("out")).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/steps/wire_000005.vtp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/steps/wire_000006.vtp"));
}

TEST(Simulate, TheJudgeBesideTheProgramIsAsked) {
#ifndef ENDOWIRE_JUDGE
  GTEST_SKIP() << "check_crossings is not part of this build";
#else
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  test::write_text(folder / "s.toml", test::tube_scene);
  EXPECT_EQ(run_endowire(folder, simulate("out")).code, 0);
  const json summary = json::parse(test::read_text(folder / "out/summary.json"));
  EXPECT_EQ(summary["wall_crossings"], 0) << summary.value("wall_crossings_note", "");
#endif
}

/// One Newton iteration and no smaller steps cannot find a bent equilibrium: the run says where, and still
/// writes.
TEST(Simulate, NotConvergedIsExitThreeAndSaysWhere) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  std::string scene = test::tube_scene;
  scene.replace(scene.find("[simulation]"), 12, "[solver]\nmax_iterations = 1\nmax_splits = 0\n[simulation]");
  scene.replace(scene.find("direction = [0.0, 0.0, 1.0]"), 27, "direction = [0.6, 0.0, 1.0]");
  test::write_text(folder / "s.toml", scene);
  const Outcome outcome = run_endowire(folder, simulate("out"));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("s.toml: step ", 0), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find("did not converge"), std::string::npos) << outcome.err;
  const json summary = json::parse(test::read_text(folder / "out/summary.json"));
  EXPECT_LT(summary["converged_steps"], summary["steps"]);
  EXPECT_TRUE(summary["first_failure"].is_object());
}

TEST(Simulate, SaysWhetherTheTargetIsReached) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  const std::string scene = test::tube_scene;
  test::write_text(folder / "s.toml", scene + "[target]\nnear_mm = [0.0, 0.0, 24.0]\n");
  EXPECT_EQ(run_endowire(folder, simulate("out")).code, 0);
  json summary = json::parse(test::read_text(folder / "out/summary.json"));
  EXPECT_EQ(summary["instruments"][0]["tip_branch"], "1");
  EXPECT_EQ(summary["target"]["branch"], "1");
  // The root of a closed tube may be either end: the tip, at 25 mm, lies behind the goal or before it.
  const double to_go = summary["target"]["to_go_mm"];
  EXPECT_EQ(summary["target"]["reached"], to_go == 0.0);
  EXPECT_NEAR(to_go, to_go == 0.0 ? 0.0 : 1.0, 0.3);
  test::write_text(folder / "s.toml", scene + "[target]\nbranch = \"carotid\"\n");
  const Outcome outcome = run_endowire(folder, simulate("not_made"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "s.toml: target.branch is \"carotid\"; must be one of 1\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "not_made"));
}

TEST(Inspect, SaysWhatAMeshIs) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(0.4, 6.0));
  const Outcome text =
      run_endowire(folder, {"inspect", "v.stl", "--unit", "cm", "--cache", test::test_cache()});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("8.0 x 8.0 x 60.0 mm"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("branches               1"), std::string::npos) << text.out;
  const Outcome outcome =
      run_endowire(folder, {"inspect", "v.stl", "--unit", "cm", "--json", "--cache", test::test_cache()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json facts = json::parse(outcome.out);
  EXPECT_EQ(facts["triangles"], 32 * 12 * 2 + 64);
  EXPECT_EQ(facts["unit"], "cm");
  EXPECT_EQ(facts["openings"].size(), 0U);
  EXPECT_NEAR(facts["lumen_diameter_mm"]["p50"].get<double>(), 8.0, 0.3);
  ASSERT_EQ(facts["centrelines"]["branches"].size(), 1U);
  EXPECT_NEAR(facts["centrelines"]["branches"][0]["length_mm"].get<double>(), 60.0, 1.0);
}

TEST(Inspect, WritesCentrelines) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  const Outcome outcome =
      run_endowire(folder, {"inspect", "v.stl", "--centreline", "c.vtp", "--cache", test::test_cache()});
  const Outcome slicer =
      run_endowire(folder, {"inspect", "v.stl", "--centreline", "c.mrk.json", "--cache", test::test_cache()});
  EXPECT_EQ(slicer.code, 0) << slicer.err;
  EXPECT_EQ(json::parse(test::read_text(folder / "c.mrk.json"))["markups"].size(), 1U);
#ifdef ENDOWIRE_JUDGE
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(test::read_text(folder / "c.vtp").find("curvature_per_mm"), std::string::npos);
  const Outcome nowhere =
      run_endowire(folder, {"inspect", "v.stl", "--centreline", "no/c.vtp", "--cache", test::test_cache()});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_EQ(std::count(nowhere.err.begin(), nowhere.err.end(), '\n'), 1) << nowhere.err;
#else
  EXPECT_EQ(outcome.code, 2);  // a build without VTK says so
#endif
}

TEST(Help, IsOnStdoutAndExitsZero) {
  const TemporaryFolder folder;
  for (const char* flag : {"--help", "--version"}) {
    const Outcome outcome = run_endowire(folder, {flag});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_FALSE(outcome.out.empty());
  }
  EXPECT_EQ(run_endowire(folder, {"--version"}).out, std::string("endowire ") + ENDOWIRE_VERSION + "\n");
}

}  // namespace
}  // namespace endowire

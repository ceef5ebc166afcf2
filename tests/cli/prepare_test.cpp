// Any file to a surface, and on to a simulation, with what was decided said.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/volume_files.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

/// A tube of 10 mm along z, cut by the image's borders.
std::string image(bool labels) {
  test::Grid grid;
  grid.size = {24, 24, 60};
  io::Volume volume = test::volume_of(grid, [&](const Eigen::Vector3d& p) {
    const double inside = 5.0 - test::from_line_mm(p, {12.3, 11.8, 0}, {0, 0, 1});
    return labels ? (inside > 0.0 ? 2.0 : 0.0) : 40.0 + 300.0 * std::clamp(inside + 0.5, 0.0, 1.0);
  });
  return test::packed(test::nifti_file(volume));
}

TEST(Prepare, AMeshInMetresBecomesASurfaceInMillimetres) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(0.004, 0.06));
  const Outcome outcome = run_endowire(folder, {"prepare", "v.stl", "-o", "lumen.stl"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("m, inferred: the lumen is then 7.96 mm wide"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("8.0 x 8.0 x 60.0 mm"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("nothing: the mesh is sound"), std::string::npos) << outcome.out;
  const Outcome again =
      run_endowire(folder, {"inspect", "lumen.stl", "--json", "--cache", test::test_cache()});
  ASSERT_EQ(again.code, 0) << again.err;
  const json facts = json::parse(again.out);
  EXPECT_EQ(facts["unit"], "mm");
  EXPECT_EQ(facts["unit_inferred"], true);
  ASSERT_EQ(facts["ends"].size(), 2U);
  EXPECT_EQ(facts["ends"][0]["open"], false);
}

TEST(Prepare, RefusesWhatCannotBe) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  test::write_text(folder / "v.nii.gz", image(true));
  const auto said = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "prepare");
    const Outcome outcome = run_endowire(folder, arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_EQ(
      said({"v.stl", "-o", "x.stl", "--unit", "m"}).rfind("v.stl: in m the lumen is 7.96e+03 mm wide", 0),
      0U);
  EXPECT_NE(said({"v.stl", "-o", "x.obj"}).find("--out is \"x.obj\"; must be a path that ends in"),
            std::string::npos);
  EXPECT_NE(
      said({"v.stl", "-o", "x.stl", "--keep", "some"}).find("--keep is \"some\"; must be largest or all"),
      std::string::npos);
  EXPECT_NE(said({"v.stl", "-o", "x.stl", "--threshold", "bright"})
                .find("--threshold is \"bright\"; must be a number"),
            std::string::npos);
  EXPECT_NE(said({"v.stl", "-o", "x.stl", "--smooth", "1000"})
                .find("--smooth is \"1000\"; must be a whole number, 0 … 200"),
            std::string::npos);
  // In metres, as the user claims, the image would be 24 m wide: its voxels say so before the lumen does.
  EXPECT_NE(
      said({"v.nii.gz", "-o", "x.stl", "--unit", "m"}).find("spacing is 1000 x 1000 x 1000 mm; must be"),
      std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.stl"));
}

#ifdef ENDOWIRE_JUDGE  // a build with VTK

TEST(Prepare, TellsWhatItDecidedOfAnImage) {
  const TemporaryFolder folder;
  test::write_text(folder / "labels.nii.gz", image(true));
  test::write_text(folder / "grey.nii.gz", image(false));
  const Outcome labels = run_endowire(folder, {"prepare", "labels.nii.gz", "-o", "a.vtp"});
  ASSERT_EQ(labels.code, 0) << labels.err;
  EXPECT_NE(labels.out.find("label 2 of a label map"), std::string::npos) << labels.out;
  EXPECT_NE(labels.out.find("here LPS in mm"), std::string::npos) << labels.out;
  const Outcome grey = run_endowire(folder, {"prepare", "grey.nii.gz", "-o", "b.vtp"});
  ASSERT_EQ(grey.code, 0) << grey.err;
  EXPECT_NE(grey.out.find("where the image's only sharp surface is"), std::string::npos) << grey.out;
  for (const char* name : {"a.vtp", "b.vtp"}) {
    const Outcome facts = run_endowire(folder, {"inspect", name, "--json", "--cache", test::test_cache()});
    ASSERT_EQ(facts.code, 0) << facts.err;
    const json branches = json::parse(facts.out)["centrelines"]["branches"];
    ASSERT_EQ(branches.size(), 1U);
    EXPECT_NEAR(branches[0]["radius_mm"]["mean"].get<double>(), 5.0, 0.25) << name;
  }
}

TEST(Prepare, AnImageThatIsWrongAboutItsUnitIsToldAndCorrected) {
  const TemporaryFolder folder;
  // The same tube with voxels of a tenth: millimetres in the header, centimetres meant.
  test::Grid grid;
  grid.size = {24, 24, 90};
  grid.step_mm *= 0.1;
  const io::Volume volume = test::volume_of(grid, [&](const Eigen::Vector3d& p) {
    return test::from_line_mm(p, {1.23, 1.18, 0}, {0, 0, 1}) < 0.5 ? 2.0 : 0.0;
  });
  test::write_text(folder / "v.nii", test::nifti_file(volume));
  const Outcome as_it_says = run_endowire(folder, {"prepare", "v.nii", "-o", "a.vtp"});
  ASSERT_EQ(as_it_says.code, 0) << as_it_says.err;
  EXPECT_NE(as_it_says.out.find("mm, from the image; the lumen is then"), std::string::npos)
      << as_it_says.out;
  EXPECT_NE(as_it_says.out.find("which is likelier: if so, unit = \"cm\""), std::string::npos)
      << as_it_says.out;
  const Outcome corrected = run_endowire(folder, {"prepare", "v.nii", "-o", "b.vtp", "--unit", "cm"});
  ASSERT_EQ(corrected.code, 0) << corrected.err;
  EXPECT_NE(corrected.out.find("cm, as declared\n"), std::string::npos) << corrected.out;
  EXPECT_NE(corrected.out.find("x 90.0 mm"), std::string::npos) << corrected.out;
  EXPECT_NE(corrected.out.find("voxels of 1 x 1 x 1 mm"), std::string::npos) << corrected.out;
}

TEST(Prepare, AnImageIsSimulatedInWithoutPreparation) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.nii.gz", image(true));
  test::write_text(folder / "s.toml", R"(schema = 1
[vessel]
file = "v.nii.gz"
label = 2
[access]
opening = 1
[[instrument]]
model = "hydrophilic_035_straight"
[[motion]]
duration_s = 2.0
hands = [{ advance_mm = 51.5 }]
[target]
opening = 2
)");
  const Outcome outcome =
      run_endowire(folder, {"simulate", "s.toml", "--out", "out", "--cache", test::test_cache()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json summary = json::parse(test::read_text(folder / "out/summary.json"));
  EXPECT_EQ(summary["wall_crossings"], 0);
  EXPECT_EQ(summary["target"]["reached"], true);
  EXPECT_EQ(summary["vessel"]["image"]["label"], 2);
  // And again from the recording.
  const Outcome replay = run_endowire(
      folder, {"replay", "out/recording.jsonl", "--out", "again", "--cache", test::test_cache()});
  EXPECT_EQ(replay.code, 0) << replay.err;
}

#endif

// As the test of replays, for what is prepared: breaks with a fused or reordered sum in one of the kernels.
TEST(Inspect, PreparesTheSameBytesWithEveryInstructionSet) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  const auto prepared = [&](const std::string& cache, const std::string& environment) {
    const Outcome outcome = run_endowire(folder, {"inspect", "v.stl", "--cache", cache}, environment);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / cache))
      files[entry.path().filename()] = test::read_text(entry.path());
    return files;
  };
  const std::map<std::string, std::string> own = prepared("own", "");
  EXPECT_EQ(own.size(), 2U);
  EXPECT_TRUE(own == prepared("plain", "ENDOWIRE_ISA=sse2"));
}

TEST(Inspect, DrawsAContactSheet) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  const Outcome outcome =
      run_endowire(folder, {"inspect", "v.stl", "--picture", "v.png", "--cache", test::test_cache()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(test::read_text(folder / "v.png").substr(1, 3), "PNG");
}

}  // namespace
}  // namespace endowire

// Vessels made in code, as a user types it: on the command line, and named in a scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

TEST(Generate, NamesItsAnatomiesAndTheirParameters) {
  const TemporaryFolder folder;
  const Outcome list = run_endowire(folder, {"generate", "--list"});
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* name : {"aortic_arch", "iliofemoral", "renal", "coronary", "carotid_siphon"})
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
  const Outcome parameters = run_endowire(folder, {"generate", "aortic_arch", "--parameters"});
  EXPECT_EQ(parameters.code, 0) << parameters.err;
  EXPECT_NE(parameters.out.find("arch_type"), std::string::npos);
  EXPECT_NE(parameters.out.find("left_carotid_take_off_deg"), std::string::npos) << parameters.out;
  EXPECT_NE(parameters.out.find("Krejza2006"), std::string::npos) << "every number has a source";
}

TEST(Generate, WritesWhatInspectReadsAndTheSameForTheSameSeed) {
  const TemporaryFolder folder;
  const std::vector<std::string> renal{"generate",           "renal",      "--seed", "7", "--set",
                                       "sheath_depth_mm=30", "--open-ends"};
  const auto made = [&](std::vector<std::string> arguments, const std::string& out) {
    arguments.insert(arguments.end(), {"--out", out + ".stl", "--json", out + ".json"});
    const Outcome outcome = run_endowire(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string said = made(renal, "a");
  EXPECT_NE(said.find("access position_mm = ["), std::string::npos) << said;
  made(renal, "b");
  made({"generate", "renal", "--seed", "8"}, "c");
  EXPECT_EQ(test::read_text(folder / "a.stl"), test::read_text(folder / "b.stl"));
  EXPECT_EQ(test::read_text(folder / "a.json"), test::read_text(folder / "b.json"));
  EXPECT_NE(test::read_text(folder / "a.stl"), test::read_text(folder / "c.stl"));

  const Outcome seen = run_endowire(folder, {"inspect", "a.stl", "--json", "--cache", test::test_cache()});
  EXPECT_EQ(seen.code, 0) << seen.err;
  const json facts = json::parse(seen.out);
  const json truth = json::parse(test::read_text(folder / "a.json"));
  const auto ends = std::count_if(truth["landmarks"].begin(), truth["landmarks"].end(), [](const json& mark) {
    return mark["name"].get<std::string>().ends_with(" end");
  });
  EXPECT_EQ(facts["openings"].size(), static_cast<std::size_t>(ends));
}

TEST(Generate, RefusesInOneLineWhatItCannotMake) {
  const TemporaryFolder folder;
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "generate");
    const Outcome outcome = run_endowire(folder, arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "v.stl"));
    return outcome.err;
  };
  const std::vector<std::string> arch{"aortic_arch", "--out", "v.stl"};
  const auto with = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> arguments = arch;
    arguments.insert(arguments.end(), {option, value});
    return arguments;
  };
  EXPECT_EQ(refusal({}), "generate: NAME is missing; `generate --list` names them\n");
  EXPECT_EQ(refusal({"aortic_arch"}), "generate: --out is missing; must be the path of an STL file\n");
  EXPECT_EQ(refusal({"heart", "--out", "v.stl"}),
            "generate: NAME is \"heart\"; must be one of \"aortic_arch\", \"iliofemoral\", \"renal\", "
            "\"coronary\", "
            "\"carotid_siphon\"\n");
  EXPECT_EQ(refusal(with("--set", "arch_type")), "--set is \"arch_type\"; must be name=value\n");
  EXPECT_EQ(refusal(with("--set", "arch_type=two")), "--set arch_type is \"two\"; must be a number\n");
  EXPECT_EQ(refusal(with("--set", "arch_type=4")),
            "--set arch_type is 4; must be a whole number between 1 and 3\n");
  EXPECT_EQ(refusal(with("--stenosis", "left carotid:20")),
            "--stenosis is \"left carotid:20\"; must be branch:arc_mm:length_mm:percent\n");
  EXPECT_EQ(refusal(with("--stenosis", "aorta:100:20:high")),
            "--stenosis percent is \"high\"; must be a number\n");
}

TEST(Generate, ASceneOfAGeneratedVesselNeedsNoFileAndNoAccess) {
  const TemporaryFolder folder;
  test::write_text(folder / "s.toml",
                   "schema = 1\n[vessel]\ngenerate = \"carotid_siphon\"\nseed = 3\n"
                   "[[instrument]]\nmodel = \"hydrophilic_035_angled\"\n"
                   "[[motion]]\nduration_s = 1.0\n[[motion.hands]]\nadvance_mm = 5.0\n");
  const Outcome outcome =
      run_endowire(folder, {"simulate", "s.toml", "--out", "out", "--cache", test::test_cache(), "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json summary = json::parse(test::read_text(folder / "out/summary.json"));
  EXPECT_EQ(summary["converged_steps"], summary["steps"]);
  EXPECT_NEAR(summary["instruments"][0]["inserted_length_mm"].get<double>(), 5.0, 0.1);
}

}  // namespace
}  // namespace endowire

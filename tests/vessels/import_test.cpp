// The shared vessels as they were published: from file to a procedure into a branch, with nothing done by hand.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/temporary_folder.hpp"

namespace endowire {
namespace {

using nlohmann::json;

/// What is pushed in where, and where to.
struct Import {
  const char* name;
  const char* file;
  const char* unit;  ///< that is inferred
  int access;        ///< an end of the vessel
  double advance_mm;
  const char* branch;  ///< that the tip comes to lie in, away from bifurcations: there a hair decides
  bool walled = false;

  friend void PrintTo(const Import& import, std::ostream* out) { *out << import.name; }
};

class AsPublished : public testing::TestWithParam<Import> {};

TEST_P(AsPublished, GoesFromFileToABranchWithoutACrossing) {
  const Import& import = GetParam();
  const std::filesystem::path file = std::filesystem::path(ENDOWIRE_SHARED_DIR) / "vessels" / import.file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here: the shared vessels are missing";
  const test::TemporaryFolder folder;
  test::write_text(folder / "s.toml",
                   "schema = 1\n[vessel]\nfile = \"" + std::filesystem::canonical(file).string() +
                       "\"\n[access]\nopening = " + std::to_string(import.access) +
                       "\n[[instrument]]\nmodel = \"hydrophilic_035_angled\"\n[[motion]]\nduration_s = "
                       "20.0\nhands = [{ advance_mm = " +
                       std::to_string(import.advance_mm) + " }]\n");
  const std::string command = std::string(ENDOWIRE_PROGRAM) + " simulate '" + (folder / "s.toml").string() +
                              "' --out '" + (folder / "out").string() + "' --cache '" +
                              (std::filesystem::temp_directory_path() / "endowire-test-cache").string() +
                              "' --quiet";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const json summary = json::parse(test::read_text(folder / "out/summary.json"));
  const json& vessel = summary["vessel"];
  std::printf("%s: %s; %d of %d steps converged, tip in %s, %d crossings\n", import.name,
              vessel["unit_text"].get<std::string>().c_str(), summary["converged_steps"].get<int>(),
              summary["steps"].get<int>(), summary["instruments"][0]["tip_branch"].dump().c_str(),
              summary["wall_crossings"].get<int>());
  EXPECT_EQ(vessel["unit"], import.unit);
  EXPECT_EQ(vessel["wall_with_thickness"], import.walled);
  EXPECT_EQ(summary["converged_steps"], summary["steps"]);
  EXPECT_EQ(summary["wall_crossings"], 0);
  EXPECT_EQ(summary["instruments"][0]["tip_branch"], import.branch);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, AsPublished,
    testing::Values(
        Import{"phantom_of_walls_in_metres", "abdominal_aorta_phantom/AbdominalAorta.stl", "m", 5, 242.6,
               "1.4", true},
        Import{"phantom_up_the_other_leg", "abdominal_aorta_phantom/AbdominalAorta.stl", "m", 1, 242.6, "1:1",
               true},
        Import{"inner_surface_with_holes", "abdominal_aorta_phantom/inner_lumen_mm.stl", "mm", 5, 244.8,
               "1:1"},
        Import{"image_of_an_aorta", "aortoiliac/aorta.mha", "mm", 8, 258.7, "1.8:4"},
        Import{"aorta_facing_inward", "aortoiliac/aorta-surface.stl", "mm", 3, 92.1, "1:1"},
        Import{"aorta_open", "aortoiliac/aorta-surface-open-ends.stl", "mm", 2, 85.7, "1.1"},
        Import{"branching_obj", "branching_phantom/phantom.obj", "mm", 4, 375.5, "1.3"},
        Import{"carotid_with_self_intersections", "carotid_bifurcation/carotids.stl", "mm", 3, 87.5, "1:1"},
        Import{"neuro_obj", "femoral_to_neuro/original.obj", "mm", 1, 384.6, "1:6"},
        Import{"neuro_with_pin_holes", "femoral_to_neuro_fine/lumen_mm.stl", "mm", 5, 250.0, "1.3.1:2"}),
    [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace endowire

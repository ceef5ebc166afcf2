#include "endowire/io/centreline_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "endowire/base/error.hpp"
#include "endowire/io/slicer_markup.hpp"
#include "endowire/io/vtp.hpp"
#include "support/generated_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

VesselMesh tube() {
  VesselMesh mesh;
  mesh.repaired = vessel::repair(test::open_tube(3.0, 40.0, 24, 20), "tube");
  return mesh;
}

TEST(CentrelineFile, CacheIsFilledReadAndRepaired) {
  const TemporaryFolder folder;
  const VesselMesh mesh = tube();
  const auto computed = prepare_centrelines(mesh, folder.path());
  ASSERT_EQ(computed->branches().size(), 1U);
  const std::filesystem::path file = folder / centreline_cache_name(vessel::centreline_key(mesh.repaired));
  const std::string bytes = test::read_text(file);
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(prepare_centrelines(mesh, folder.path())->serialise(1), computed->serialise(1));
  test::write_text(file, bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(prepare_centrelines(mesh, folder.path())->serialise(1), computed->serialise(1));
  EXPECT_EQ(test::read_text(file), bytes);  // replaced
  EXPECT_EQ(prepare_centrelines(mesh, {})->branches().size(), 1U);
  EXPECT_EQ(prepare_centrelines(mesh, folder / "taken/by/nothing")->branches().size(), 1U);
}

TEST(CentrelineFile, VtpHoldsLinesDataAndNames) {
  const TemporaryFolder folder;
  const auto tree = prepare_centrelines(tube(), {});
  if (!vtp_available()) {
    EXPECT_NE(
        message_of<base::InputError>([&] { write_centrelines_vtp(folder / "c.vtp", *tree); }).find("no VTK"),
        std::string::npos);
    return;
  }
  write_centrelines_vtp(folder / "c.vtp", *tree);
  const std::string text = test::read_text(folder / "c.vtp");
  for (const char* name : {"radius_mm", "arc_mm", "from_root_mm", "curvature_per_mm", "branch", "parent",
                           "ostium_arc_mm", "branch_name"})
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  EXPECT_NE(text.find("NumberOfPoints=\"" + std::to_string(tree->points().size()) + "\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfLines=\"1\""), std::string::npos);
  EXPECT_NE(message_of<base::InputError>([&] { write_centrelines_vtp(folder / "no/c.vtp", *tree); }), "");
}

TEST(CentrelineFile, JsonListsBranchesAndEnds) {
  const nlohmann::ordered_json json = centrelines_json(*prepare_centrelines(tube(), {}));
  ASSERT_EQ(json.at("branches").size(), 1U);
  const auto& branch = json.at("branches").at(0);
  EXPECT_EQ(branch.at("name"), "1");
  EXPECT_TRUE(branch.at("parent").is_null());
  EXPECT_NEAR(branch.at("length_mm").get<double>(), 40.0, 0.01);
  EXPECT_NEAR(branch.at("radius_mm").at("mean").get<double>(), 2.97, 0.01);
  ASSERT_EQ(json.at("ends").size(), 2U);
  EXPECT_EQ(json.at("ends").at(0).at("root"), true);
  EXPECT_EQ(json.at("ends").at(0).at("kind").get<std::string>().rfind("opening ", 0), 0U);
}

TEST(SlicerMarkups, HoldACurveABranchWithItsRadii) {
  const auto tree = prepare_centrelines(tube(), {});
  const nlohmann::ordered_json json = slicer_markups(*tree);
  ASSERT_EQ(json.at("markups").size(), tree->branches().size());
  const auto& curve = json.at("markups").at(0);
  EXPECT_EQ(curve.at("type"), "Curve");
  EXPECT_EQ(curve.at("coordinateSystem"), "LPS");
  EXPECT_EQ(curve.at("name"), tree->branches()[0].name);
  const auto& radius = curve.at("measurements").at(0);
  EXPECT_EQ(radius.at("name"), "Radius");
  const auto points = tree->points_of(0);
  ASSERT_EQ(curve.at("controlPoints").size(), points.size());
  ASSERT_EQ(radius.at("controlPointValues").size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(curve["controlPoints"][i]["position"][k].get<double>(),
                points[i].position_mm[static_cast<int>(k)]);
    EXPECT_EQ(radius["controlPointValues"][i].get<double>(), points[i].radius_mm);
  }
}

}  // namespace
}  // namespace endowire::io

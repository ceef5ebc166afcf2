#include "endowire/io/run_output.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

sim::Snapshot two_points() {
  sim::Snapshot snapshot;
  snapshot.points.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    snapshot.points[i].position_mm = {1.0 / 3.0 + static_cast<double>(i), 2.0, 3.0};
    snapshot.points[i].arc_mm = static_cast<double>(i);
    snapshot.points[i].radius_mm = 0.4445;
  }
  snapshot.inserted_length_mm = 1.5;
  return snapshot;
}

TEST(RunOutput, ClearsItsOwnFilesOfAnEarlierRunAndNoOthers) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "steps");
  for (const char* name :
       {"summary.json", "wire.svg", "steps/wire_000009.vtp", "notes.txt", "steps/mine.vtp"})
    test::write_text(folder / name, "old");
  const RunOutput output(folder.path(), {}, {});
  EXPECT_FALSE(std::filesystem::exists(folder / "summary.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "wire.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder / "steps/wire_000009.vtp"));
  EXPECT_EQ(test::read_text(folder / "notes.txt"), "old");
  EXPECT_EQ(test::read_text(folder / "steps/mine.vtp"), "old");
  EXPECT_TRUE(std::filesystem::exists(folder / "recording.jsonl"));
}

TEST(RunOutput, AFileInTheFoldersPlaceIsNamedAndKept) {
  const TemporaryFolder folder;
  test::write_text(folder / "out", "precious");
  EXPECT_EQ(message_of<base::InputError>([&] { check_output_folder(folder / "out"); }),
            "--out: " + (folder / "out").string() + " is a file; must be a folder");
  EXPECT_EQ(message_of<base::InputError>([&] { RunOutput(folder / "out", {}, {}); }),
            (folder / "out").string() + ": cannot be made as a folder for the results");
  EXPECT_EQ(test::read_text(folder / "out"), "precious");
}

TEST(RunOutput, WritesTheSeriesOfShapes) {
  if (!vtp_available()) GTEST_SKIP() << "built without VTK";
  const TemporaryFolder folder;
  RunOutput output(folder / "new/out", {}, {});
  output.shape(1, 0.25, two_points());
  output.shape(2, 0.5, {});  // nothing to draw yet: no file, no entry
  output.finish(2, two_points());
  const std::string series = test::read_text(folder / "new/out/wire.pvd");
  EXPECT_NE(series.find("timestep=\"0.25\" group=\"\" part=\"0\" file=\"steps/wire_000001.vtp\""),
            std::string::npos);
  EXPECT_EQ(series.find("wire_000002"), std::string::npos);
  const std::string step = test::read_text(folder / "new/out/steps/wire_000001.vtp");
  for (const char* name :
       {"arc_mm", "radius_mm", "curvature_per_mm", "twist_rad", "wall_force_n_per_mm", "friction_n_per_mm",
        "wall_force_direction", "inserted_length_mm", "access_position_mm"})
    EXPECT_NE(step.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  // Positions in full double precision, raw: the bytes of 1/3 stand in the file.
  const double third = 1.0 / 3.0;
  EXPECT_NE(step.find(std::string(reinterpret_cast<const char*>(&third), sizeof third)), std::string::npos);
}

}  // namespace
}  // namespace endowire::io

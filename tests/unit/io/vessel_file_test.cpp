#include "endowire/io/vessel_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "endowire/base/error.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

vessel::TriangleMesh box(double size) {
  vessel::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_mm.emplace_back(size * (i & 1), size * (i >> 1 & 1), size * (i >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

std::string stl(double size = 20.0) {
  const std::vector<std::byte> bytes = vessel::write_binary_stl(box(size));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

vessel::FieldParameters coarse() {
  vessel::FieldParameters parameters;
  parameters.error_target_mm = 0.5;
  parameters.max_bytes = 2'000'000;
  return parameters;
}

TEST(VesselFile, ReadsAMeshInItsUnit) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", stl(2.0));
  const VesselMesh mesh = read_vessel_file(folder / "v.stl", vessel::LengthUnit::centimetre);
  EXPECT_EQ(mesh.repaired.report.triangles, 12U);
  EXPECT_NEAR(mesh.repaired.report.volume_mm3, 8000.0, 1e-6);
}

TEST(VesselFile, BadFilesAreRefusedByName) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& bytes,
                           vessel::LengthUnit unit = vessel::LengthUnit::millimetre) {
    test::write_text(folder / "v.stl", bytes);
    const std::string text =
        message_of<base::InputError>([&] { static_cast<void>(read_vessel_file(folder / "v.stl", unit)); });
    EXPECT_EQ(text.rfind((folder / "v.stl").string() + ": ", 0), 0U) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  };
  const std::string whole = stl();
  message("");
  message(whole.substr(0, whole.size() - 10));  // truncated
  message(whole + "more");                      // longer than its count says
  std::string lying = whole;
  std::memcpy(lying.data() + 80, "\xff\xff\xff\xff", 4);
  message(lying);
  std::string nan = whole;
  const float not_a_number = std::nanf("");
  std::memcpy(nan.data() + 84 + 12, &not_a_number, 4);
  message(nan);
  std::string none = whole.substr(0, 84);
  std::memcpy(none.data() + 80, "\0\0\0\0", 4);
  message(none);
  message("solid nothing\nendsolid nothing\n");
  message(stl(0.6));
  message(stl(20.0), vessel::LengthUnit::metre);
}

TEST(VesselFile, AnEmptyVesselFileIsCalledEmpty) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", "");
  EXPECT_EQ(message_of<base::InputError>([&] {
              static_cast<void>(read_vessel_file(folder / "v.stl", vessel::LengthUnit::millimetre));
            }),
            (folder / "v.stl").string() + ": is empty");
}

TEST(FieldCache, TheSecondTimeTheFieldComesFromDiskAndIsTheSame) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", stl());
  const VesselMesh mesh = read_vessel_file(folder / "v.stl", vessel::LengthUnit::millimetre);
  const PreparedField first = prepare_field(mesh, folder / "cache", coarse());
  const PreparedField second = prepare_field(mesh, folder / "cache", coarse());
  EXPECT_EQ(first.origin, FieldOrigin::prepared);
  EXPECT_EQ(second.origin, FieldOrigin::cached);
  EXPECT_EQ(first.field->serialise(), second.field->serialise());
  EXPECT_GT(first.field->at({10, 10, 10}).distance_mm, 1.0);
}

TEST(FieldCache, ADamagedFileIsPreparedAnewAndReplaced) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", stl());
  const VesselMesh mesh = read_vessel_file(folder / "v.stl", vessel::LengthUnit::millimetre);
  static_cast<void>(prepare_field(mesh, folder / "cache", coarse()));
  const std::filesystem::path file =
      (folder / "cache") / field_cache_name(vessel::MeshField::key(mesh.repaired, coarse()));
  const std::string whole = test::read_text(file);
  ASSERT_FALSE(whole.empty());
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x10);
  for (const std::string& damaged :
       {std::string(), std::string("x"), whole.substr(0, whole.size() / 2), whole + "x", flipped}) {
    test::write_text(file, damaged);
    EXPECT_EQ(prepare_field(mesh, folder / "cache", coarse()).origin, FieldOrigin::prepared);
    EXPECT_EQ(test::read_text(file), whole);
  }
}

TEST(FieldCache, OtherParametersAreAnotherField) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", stl());
  const VesselMesh mesh = read_vessel_file(folder / "v.stl", vessel::LengthUnit::millimetre);
  static_cast<void>(prepare_field(mesh, folder / "cache", coarse()));
  vessel::FieldParameters other = coarse();
  other.band_outside_mm += 0.5;
  EXPECT_EQ(prepare_field(mesh, folder / "cache", other).origin, FieldOrigin::prepared);
}

TEST(FieldCache, APlaceThatCannotBeWrittenCostsTimeOnly) {
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", stl());
  test::write_text(folder / "file", "in the way");
  const VesselMesh mesh = read_vessel_file(folder / "v.stl", vessel::LengthUnit::millimetre);
  EXPECT_EQ(prepare_field(mesh, folder / "file", coarse()).origin, FieldOrigin::prepared_not_cached);
  EXPECT_EQ(prepare_field(mesh, "", coarse()).origin, FieldOrigin::prepared_not_cached);
}

}  // namespace
}  // namespace endowire::io

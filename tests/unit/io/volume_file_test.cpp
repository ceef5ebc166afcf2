// Image volumes: each format gives back values and places; what is damaged is refused.
#include "endowire/io/volume_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/volume_files.hpp"

namespace endowire::io {
namespace {

using Eigen::Vector3d;
using test::message_of;
using test::TemporaryFolder;

/// Turned, left-handed, not cubic, with values that tell i, j and k apart.
Volume oblique() {
  test::Grid grid;
  grid.size = {5, 4, 3};
  grid.step_mm = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix() *
                 Vector3d(0.5, 0.75, -1.5).asDiagonal();
  grid.origin_mm = {-120.0, 30.5, 800.0};
  Volume volume = test::volume_of(grid, [](const Vector3d&) { return 0.0; });
  for (std::size_t i = 0; i < volume.values.size(); ++i)
    volume.values[i] = static_cast<float>(i * 7) - 200.0F;
  return volume;
}

void expect_same(const Volume& read, const Volume& expected) {
  EXPECT_EQ(read.size, expected.size);
  EXPECT_EQ(read.values, expected.values);
  EXPECT_TRUE(read.whole_numbers);
  EXPECT_LT((read.step_mm - expected.step_mm).norm(), 1e-5) << read.step_mm;
  EXPECT_LT((read.origin_mm - expected.origin_mm).norm(), 1e-3) << read.origin_mm;
  EXPECT_FALSE(read.frame.empty());
}

struct Format {
  const char* name;
  const char* file;
  std::string (*bytes)(const Volume&);
};

class VolumeFormat : public testing::TestWithParam<Format> {};

TEST_P(VolumeFormat, GivesBackValuesAndPlaces) {
  const TemporaryFolder folder;
  const Volume volume = oblique();
  test::write_text(folder / GetParam().file, GetParam().bytes(volume));
  EXPECT_TRUE(names_a_volume(folder / GetParam().file));
  expect_same(read_volume(folder / GetParam().file), volume);
}

TEST_P(VolumeFormat, CutOffAnywhereIsRefused) {
  const TemporaryFolder folder;
  const std::string whole = GetParam().bytes(oblique());
  for (std::size_t length = 1; length < whole.size(); length += 1 + length / 9) {
    test::write_text(folder / GetParam().file, whole.substr(0, length));
    const std::string said =
        message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / GetParam().file)); });
    EXPECT_EQ(said.rfind((folder / GetParam().file).string() + ": ", 0), 0U) << length << ": " << said;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, VolumeFormat,
    testing::Values(
        Format{"nifti", "v.nii", test::nifti_file},
        Format{"nifti_packed", "v.nii.gz", [](const Volume& v) { return test::packed(test::nifti_file(v)); }},
        Format{"meta_image", "v.mha", [](const Volume& v) { return test::meta_image_file(v, false); }},
        Format{"meta_image_packed", "v.mha", [](const Volume& v) { return test::meta_image_file(v, true); }},
        Format{"nrrd", "v.nrrd", [](const Volume& v) { return test::nrrd_file(v, false); }},
        Format{"nrrd_packed", "v.nrrd", [](const Volume& v) { return test::nrrd_file(v, true); }}),
    [](const auto& p) { return std::string(p.param.name); });

TEST(VolumeFile, VoxelsMayLieInAFileOfTheirOwn) {
  const TemporaryFolder folder;
  const Volume volume = oblique();
  test::write_text(folder / "v.raw", test::as_int16(volume));
  std::string text = test::meta_image_file(volume, false);
  test::write_text(folder / "v.mhd",
                   text.substr(0, text.find("ElementDataFile")) + "ElementDataFile = v.raw\n");
  expect_same(read_volume(folder / "v.mhd"), volume);
  text = test::nrrd_file(volume, false);
  test::write_text(folder / "v.nhdr", text.substr(0, text.find("note:=")) + "data file: v.raw\n");
  expect_same(read_volume(folder / "v.nhdr"), volume);
}

TEST(VolumeFile, ASeriesOfDicomFilesIsSortedByPlace) {
  const TemporaryFolder folder;
  Volume volume = oblique();
  volume.step_mm.col(2) = -volume.step_mm.col(2);  // right-handed, as slices are
  std::filesystem::create_directory(folder / "s");
  test::write_text(folder / "s/readme.txt", std::string(300, 'x'));
  for (std::int64_t k = 0; k < 3; ++k)
    test::write_text(folder / ("s/" + std::to_string(9 - k) + ".dcm"), test::dicom_file(volume, k));
  expect_same(read_volume(folder / "s"), volume);
  expect_same(read_volume(folder / "s/8.dcm"), volume);
}

TEST(VolumeFile, ASeriesWithAFlawIsRefusedWithItsSlice) {
  const TemporaryFolder folder;
  test::Grid grid;
  grid.size = {4, 4, 6};
  const Volume volume = test::volume_of(grid, [](const Vector3d& p) { return p.z(); });
  const auto said = [&](const char* name) {
    return message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / name)); });
  };
  const auto write = [&](const char* name, std::int64_t slice, const std::string& bytes) {
    std::filesystem::create_directory(folder / name);
    test::write_text((folder / name) / (std::to_string(slice) + ".dcm"), bytes);
  };
  for (std::int64_t k = 0; k < 6; ++k) {
    if (k != 3) write("missing", k, test::dicom_file(volume, k));
    write("two", k, test::dicom_file(volume, k, k < 4 ? "1.2.3" : "1.2.4"));
    write("twice", k, test::dicom_file(volume, k == 5 ? 2 : k));
    std::string other = test::dicom_file(volume, k);
    other.replace(other.find("1.2.840.10008.1.2.1"), 19, "1.2.840.10008.1.2.5");
    write("packed", k, other);
  }
  EXPECT_NE(said("missing").find("4.dcm: lies 2.000 mm from"), std::string::npos) << said("missing");
  EXPECT_NE(said("missing").find("one is missing"), std::string::npos) << said("missing");
  EXPECT_NE(said("two").find("holds 2 series, 1.2.3 (4 slices), 1.2.4 (2 slices)"), std::string::npos)
      << said("two");
  EXPECT_NE(said("twice").find("one is there twice"), std::string::npos) << said("twice");
  EXPECT_NE(said("packed").find("must be uncompressed and little endian"), std::string::npos)
      << said("packed");
  std::filesystem::create_directory(folder / "empty");
  EXPECT_NE(said("empty").find("is a folder without DICOM files"), std::string::npos) << said("empty");
}

TEST(VolumeFile, ClaimsThatTheBytesDoNotHoldAreRefusedBeforeTheyAreBelieved) {
  const TemporaryFolder folder;
  const Volume volume = oblique();
  const auto said = [&](const char* name, const std::string& bytes) {
    test::write_text(folder / name, bytes);
    return message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / name)); });
  };
  std::string nifti = test::nifti_file(volume);
  for (std::size_t k = 0; k < 3; ++k) test::put<std::int16_t>(nifti, 42 + 2 * k, 32767);
  EXPECT_NE(said("v.nii", nifti).find("size is 32767 x 32767 x 32767 voxels; must be"), std::string::npos);
  for (std::size_t k = 0; k < 3; ++k) test::put<std::int16_t>(nifti, 42 + 2 * k, 600);
  EXPECT_NE(said("v.nii", nifti).find("must be 432000000 for 600 x 600 x 600"), std::string::npos);
  EXPECT_NE(said("v.nii.gz", test::packed(nifti)).find("must hold 432000352"), std::string::npos);
  std::string meta = test::meta_image_file(volume, true);
  meta.replace(meta.find("DimSize = 5 4 3"), 15, "DimSize = 600 600 600");
  EXPECT_NE(said("v.mha", meta).find("must hold 432000000"), std::string::npos);
  meta.replace(meta.find("600 600 600"), 11, "1e9 1e9 1e9");
  EXPECT_NE(said("v.mha", meta).find("must be >= 2 each and <= 268435456 in all"), std::string::npos);
}

TEST(VolumeFile, WhatIsPackedBehindTheVoxelsIsNotUnpacked) {
  const TemporaryFolder folder;
  const Volume volume = oblique();
  const std::string bomb = test::packed(test::nifti_file(volume) + std::string(200'000'000, '\0'));
  ASSERT_LT(bomb.size(), 1'000'000U);
  test::write_text(folder / "v.nii.gz", bomb);
  expect_same(read_volume(folder / "v.nii.gz"), volume);
}

TEST(VolumeFile, ValuesAndPlacesThatAreNotFiniteAreRefused) {
  const TemporaryFolder folder;
  std::string nifti = test::nifti_file(oblique());
  test::put<float>(nifti, 280, std::nanf(""));
  test::write_text(folder / "v.nii", nifti);
  const auto said = [&] {
    return message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / "v.nii")); });
  };
  EXPECT_NE(said().find("its place in space is not finite"), std::string::npos) << said();
  nifti = test::nifti_file(oblique());
  test::put<float>(nifti, 284, 0.5F);  // the first two axes alike
  for (std::size_t row = 0; row < 3; ++row) std::memcpy(&nifti[284 + 16 * row], &nifti[280 + 16 * row], 4);
  test::write_text(folder / "v.nii", nifti);
  EXPECT_NE(said().find("its axes lie in one plane"), std::string::npos) << said();
}

}  // namespace
}  // namespace endowire::io

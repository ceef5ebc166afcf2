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

TEST(VolumeFile, AFileOfASeriesStandsForItsSeries) {
  const TemporaryFolder folder;
  Volume volume = oblique();
  volume.step_mm.col(2) = -volume.step_mm.col(2);
  Volume other = volume;
  for (float& value : other.values) value += 1.0F;
  std::filesystem::create_directory(folder / "s");
  for (std::int64_t k = 0; k < 3; ++k) {
    test::write_text(folder / ("s/a" + std::to_string(k) + ".dcm"), test::dicom_file(volume, k));
    test::write_text(folder / ("s/IM" + std::to_string(k)), test::dicom_file(other, k, "1.2.4"));
  }
  test::write_text(folder / "s/readme.txt", "not a slice");
  // A directory of the disc: a DICOM file without an image.
  const std::string slice = test::dicom_file(volume, 0);
  test::write_text(folder / "s/DICOMDIR", slice.substr(0, slice.find("1.2.840.10008.1.2.1") + 20));
  const std::string said =
      message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / "s")); });
  EXPECT_NE(
      said.find(
          "holds 2 series, 1.2.3 (3 slices), 1.2.4 (3 slices); must be one: name a file of the one meant"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("s/IM0"), std::string::npos) << said;
  EXPECT_TRUE(names_a_volume(folder / "s/IM1")) << "no ending";
  expect_same(read_volume(folder / "s/IM1"), other);
  const Volume read = read_volume(folder / "s/a2.dcm");
  expect_same(read, volume);
  EXPECT_EQ(
      read.frame,
      "DICOM, 3 slices, LPS in the files, 3 slices of other series left out, 2 other files passed over");
}

TEST(VolumeFile, EverySliceHasItsOwnScaleOfValues) {
  const TemporaryFolder folder;
  Volume volume = oblique();
  volume.step_mm.col(2) = -volume.step_mm.col(2);
  std::filesystem::create_directory(folder / "s");
  for (std::int64_t k = 0; k < 3; ++k) {
    std::string file = test::dicom_file(volume, k);
    if (k == 1) file.replace(file.find("-1000"), 5, "-900 ");
    test::write_text(folder / ("s/" + std::to_string(k)), file);
  }
  const Volume read = read_volume(folder / "s");
  for (std::size_t i = 0; i < read.values.size(); ++i)
    EXPECT_EQ(read.values[i], volume.values[i] + (i / 20 == 1 ? 100.0F : 0.0F)) << i;
}

TEST(VolumeFile, ASliceAsideIsRefused) {
  const TemporaryFolder folder;
  test::Grid grid;
  grid.size = {4, 4, 5};
  const Volume volume = test::volume_of(grid, [](const Vector3d& p) { return p.z(); });
  std::filesystem::create_directory(folder / "s");
  for (std::int64_t k = 0; k < 5; ++k) {
    Volume shifted = volume;
    if (k == 3) shifted.origin_mm.x() += 2.0;
    test::write_text(folder / ("s/" + std::to_string(k) + ".dcm"), test::dicom_file(shifted, k));
  }
  const std::string said =
      message_of<base::InputError>([&] { static_cast<void>(read_volume(folder / "s")); });
  EXPECT_NE(said.find("3.dcm: lies 2.000 mm beside the line of the series"), std::string::npos) << said;
}

TEST(VolumeFile, LengthsInOtherUnitsBecomeMillimetres) {
  const TemporaryFolder folder;
  struct Case {
    const char* name;
    double mm;
  };
  const Volume volume = oblique();
  for (const Case& c : {Case{"cm", 10.0}, Case{"um", 1e-3}, Case{"mm", 1.0}}) {
    Volume scaled = volume;
    scaled.step_mm /= c.mm;
    scaled.origin_mm /= c.mm;
    std::string meta = test::meta_image_file(scaled, false);
    meta.insert(meta.find("DimSize"), std::string("DistanceUnits = ") + c.name + "\n");
    test::write_text(folder / "v.mha", meta);
    expect_same(read_volume(folder / "v.mha"), volume);
    EXPECT_EQ(read_volume(folder / "v.mha").unit_mm, c.mm);
    std::string nrrd = test::nrrd_file(scaled, false);
    const std::string quoted = std::string(" \"") + c.name + "\"";
    nrrd.insert(nrrd.find("kinds:"), "space units:" + quoted + quoted + quoted + "\n");
    test::write_text(folder / "v.nrrd", nrrd);
    expect_same(read_volume(folder / "v.nrrd"), volume);
    // The user knows better.
    expect_same(read_volume(folder / "v.nrrd", c.mm), volume);
    EXPECT_NEAR(read_volume(folder / "v.mha", 2.0 * c.mm).origin_mm.z(), 1600.0, 1e-3);
  }
  std::string nrrd = test::nrrd_file(volume, false);
  nrrd.insert(nrrd.find("kinds:"), "space units: \"mm\" \"cm\" \"mm\"\n");
  test::write_text(folder / "v.nrrd", nrrd);
  EXPECT_NE(message_of<base::InputError>([&] {
              static_cast<void>(read_volume(folder / "v.nrrd"));
            }).find("space units is \"\"mm\" \"cm\" \"mm\"\"; must be the same unit of length"),
            std::string::npos);
}

TEST(VolumeFile, RealNumbersThatAreWholeMakeLabelMaps) {
  const TemporaryFolder folder;
  Volume volume = oblique();
  std::string file = test::nifti_file(volume).substr(0, 352);
  const auto write = [&](std::int16_t code, auto zero) {
    std::string bytes = file;
    test::put<std::int16_t>(bytes, 70, code);
    for (const float value : volume.values) {
      const auto number = static_cast<decltype(zero)>(value);
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    test::write_text(folder / "v.nii", bytes);
    return read_volume(folder / "v.nii").whole_numbers;
  };
  EXPECT_TRUE(write(16, 0.0F));
  EXPECT_TRUE(write(64, 0.0));
  volume.values[7] += 0.5F;
  EXPECT_FALSE(write(16, 0.0F));
  EXPECT_FALSE(write(64, 0.0));
}

/// The other way of NIfTI to say where a volume lies: a quaternion, and a sign of the third axis.
TEST(VolumeFile, TheQformOfALeftHandedVolumeIsNotMirrored) {
  const TemporaryFolder folder;
  const Volume volume = oblique();
  const Vector3d ras(-1.0, -1.0, 1.0);
  Eigen::Matrix3d axes = ras.asDiagonal() * volume.step_mm;
  for (Eigen::Index k = 0; k < 3; ++k) axes.col(k).normalize();
  ASSERT_LT(axes.determinant(), 0.0);
  axes.col(2) = -axes.col(2);
  const Eigen::Quaterniond turn(axes);
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  std::string file = test::nifti_file(volume);
  test::put<std::int16_t>(file, 252, 1);
  test::put<std::int16_t>(file, 254, 0);
  test::put<float>(file, 76, -1.0F);
  test::put(file, 256, static_cast<float>(sign * turn.x()));
  test::put(file, 260, static_cast<float>(sign * turn.y()));
  test::put(file, 264, static_cast<float>(sign * turn.z()));
  for (std::size_t k = 0; k < 3; ++k)
    test::put(file, 268 + 4 * k,
              static_cast<float>(ras[static_cast<Eigen::Index>(k)] *
                                 volume.origin_mm[static_cast<Eigen::Index>(k)]));
  test::write_text(folder / "v.nii", file);
  expect_same(read_volume(folder / "v.nii"), volume);
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

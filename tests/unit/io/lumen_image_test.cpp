// Which part of an image is the lumen: found where it is clear, refused with suggestions where it is not.
#include "endowire/io/lumen_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "endowire/base/error.hpp"
#include "endowire/io/lumen_threshold.hpp"
#include "endowire/vessel/random.hpp"
#include "support/temporary_folder.hpp"
#include "support/volume_files.hpp"

namespace endowire::io {
namespace {

using Eigen::Vector3d;
using test::message_of;

/// A bright tube along z, blurred over a millimetre, in noise.
Volume vessel_in_tissue(double lumen, double tissue, double noise, double radius_mm = 6.0) {
  vessel::SplitMix random(3);
  return test::volume_of({}, [&, lumen](const Vector3d& p) {
    const double inside = radius_mm - test::from_line_mm(p, {20, 18, 0}, {0, 0, 1});
    const double part = std::clamp(inside + 0.5, 0.0, 1.0);
    return tissue + part * (lumen - tissue) + noise * (random.uniform() + random.uniform() - 1.0);
  });
}

TEST(LumenThreshold, LiesHalfWayBetweenLumenAndTissue) {
  for (const double noise : {0.0, 20.0, 60.0}) {
    const ThresholdChoice choice = find_lumen_threshold(vessel_in_tissue(400.0, 50.0, noise));
    ASSERT_TRUE(choice.clear) << choice.doubt;
    EXPECT_NEAR(choice.candidates[0].value, 225.0, 60.0) << noise;
  }
}

std::string refusal(const Volume& volume, const VolumeOptions& options = {}) {
  return message_of<base::InputError>([&] { static_cast<void>(lumen_of(volume, options, "v.nii")); });
}

TEST(LumenThreshold, AirAndBoneBesideAVesselAreAmbiguousAndThresholdsAreSuggested) {
  Volume volume = vessel_in_tissue(300.0, 40.0, 15.0, 4.0);
  std::size_t n = 0;
  for (std::int64_t k = 0; k < 32; ++k)
    for (std::int64_t j = 0; j < 36; ++j)
      for (std::int64_t i = 0; i < 40; ++i, ++n) {
        if (j < 6) volume.values[n] = -1000.0F;
        if (j > 30 && i < 12) volume.values[n] = 1200.0F;
      }
  const std::string said = refusal(volume);
  EXPECT_NE(said.find("v.nii: the threshold of the lumen is ambiguous"), std::string::npos) << said;
  EXPECT_NE(said.find("must be given with --threshold, for example -"), std::string::npos) << said;
  VolumeOptions options;
  options.threshold = 170.0;
  options.threshold_high = 700.0;
  const LumenImage image = lumen_of(volume, options, "v.nii");
  EXPECT_NEAR(static_cast<double>(image.report.voxels_kept), 3.14 * 16.0 * 32.0, 160.0);
  EXPECT_FALSE(image.report.threshold_found);
}

TEST(LumenThreshold, NoiseAndEmptinessHaveNone) {
  vessel::SplitMix random(5);
  EXPECT_NE(refusal(test::volume_of({}, [&](const Vector3d&) { return 100.0 * random.uniform(); }))
                .find("ambiguous"),
            std::string::npos);
  EXPECT_NE(refusal(test::volume_of({}, [](const Vector3d&) { return 7.5; })).find("all values are the same"),
            std::string::npos);
}

/// Label 3 is a tube, label 5 a ball beside it.
Volume labels() {
  Volume volume = test::volume_of({}, [](const Vector3d& p) {
    if (test::from_line_mm(p, {12, 18, 0}, {0, 0, 1}) < 5.0) return 3.0;
    return (p - Vector3d(30, 18, 16)).norm() < 6.0 ? 5.0 : 0.0;
  });
  volume.whole_numbers = true;
  return volume;
}

TEST(LumenImage, SeveralLabelsAreAmbiguousUntilOneIsNamed) {
  const std::string said = refusal(labels());
  EXPECT_NE(said.find("v.nii: holds 2 labels, and which is the lumen is ambiguous; must be one of 3 ("),
            std::string::npos)
      << said;
  VolumeOptions options;
  options.label = 5;
  const LumenImage image = lumen_of(labels(), options, "v.nii");
  EXPECT_TRUE(image.report.label_map);
  EXPECT_EQ(image.size, (std::array<std::int64_t, 3>{13, 13, 13}));  // 11 voxels and a layer
  options.label = 4;
  EXPECT_NE(refusal(labels(), options).find("--label is 4; must be one of 3"), std::string::npos);
}

TEST(LumenImage, ALabelThatIsNamedMakesALabelMapOfWholeNumbers) {
  // No background of zero, values that change from voxel to voxel: taken for grey levels, but the user says otherwise.
  std::size_t n = 0;
  Volume volume = labels();
  for (float& value : volume.values)
    if (value == 0.0F) value = static_cast<float>(1000 + n++ % 3);
  VolumeOptions options;
  options.label = 3;
  const LumenImage image = lumen_of(volume, options, "v.nii");
  EXPECT_TRUE(image.report.label_map);
  EXPECT_EQ(image.report.label, 3);
  options.label = 4;
  EXPECT_NE(refusal(volume, options).find("--label is 4; must be one of 3"), std::string::npos);
  volume.values[0] = 0.5F;
  volume.whole_numbers = false;
  EXPECT_NE(refusal(volume, options).find("--label is 4, and this is a grey-level image"), std::string::npos);
}

TEST(LumenImage, TheLargestPieceIsKeptOrAll) {
  Volume volume = labels();
  for (float& value : volume.values) value = value > 0.0F ? 1.0F : 0.0F;
  const LumenImage largest = lumen_of(volume, {}, "v.nii");
  EXPECT_EQ(largest.report.pieces, 2U);
  EXPECT_EQ(largest.report.pieces_kept, 1U);
  EXPECT_GT(largest.report.largest_dropped, 800U);
  VolumeOptions all;
  all.keep_all = true;
  EXPECT_EQ(lumen_of(volume, all, "v.nii").report.pieces_kept, 2U);
}

TEST(LumenImage, HolesWithinTheLumenAreFilled) {
  Volume volume = labels();
  for (float& value : volume.values) value = value == 3.0F ? 1.0F : 0.0F;
  volume.values[(16 * 36 + 18) * 40 + 12] = 0.0F;
  const LumenImage image = lumen_of(volume, {}, "v.nii");
  EXPECT_EQ(image.report.cavity_voxels, 1U);
}

TEST(LumenImage, TooLittleIsNoLumen) {
  VolumeOptions options;
  options.threshold = 1e6;
  EXPECT_NE(
      refusal(vessel_in_tissue(400.0, 50.0, 5.0), options).find("0 voxels of lumen are joined above 1e+06"),
      std::string::npos);
}

}  // namespace
}  // namespace endowire::io

#include "endowire/vessel/anatomy/lesion.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "endowire/vessel/generate.hpp"
#include "support/anatomy_checks.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::vessel {
namespace {

using Kind = anatomy::LesionRequest::Kind;

GenerateRequest with(const std::vector<anatomy::LesionRequest>& lesions, const char* name = "aortic_arch") {
  GenerateRequest request;
  request.name = name;
  request.lesions = lesions;
  return request;
}

double diameter_at(const test::MeasuredVessel& v, const std::string& branch, double arc_mm) {
  const anatomy::Branch& b = v.branch(branch);
  return 2.0 * v.inscribed_mm(b.axis.at(b.ostium_arc_mm + arc_mm).position_mm);
}

TEST(Lesion, AStenosisNarrowsTheVesselWhereAndByWhatIsStated) {
  const GeneratedVessel made = generate(with({{Kind::stenosis, "left carotid artery", 80.0, 24.0, 70.0}}));
  const test::MeasuredVessel measured(made);
  test::expect_sound_mesh(made, true);
  EXPECT_NEAR(diameter_at(measured, "left carotid artery", 80.0), 0.3 * 6.3, 0.08 * 6.3);
  EXPECT_NEAR(diameter_at(measured, "left carotid artery", 66.0), 6.3, 0.05 * 6.3);
  EXPECT_NEAR(diameter_at(measured, "left carotid artery", 94.0), 6.3, 0.05 * 6.3);
}

TEST(Lesion, AnAneurysmOfTheAortaWidensBothSidesOfItsBifurcation) {
  const GeneratedVessel healthy = generate(with({}));
  const double bifurcation = test::MeasuredVessel(healthy).arc("aortic bifurcation");
  const GeneratedVessel made =
      generate(with({{Kind::aneurysm, "aorta to right iliac artery", bifurcation - 45.0, 90.0, 120.0}}));
  const test::MeasuredVessel measured(made);
  test::expect_sound_mesh(made, true);
  EXPECT_NEAR(diameter_at(measured, "aorta to right iliac artery", bifurcation - 45.0), 2.2 * 17.0,
              0.05 * 37.0);
  const anatomy::Branch& left = measured.branch("left iliac artery");
  const anatomy::Branch& right = measured.branch("aorta to right iliac artery");
  for (const double s : {0.0, 5.0, 10.0})  // both axes are one there, and so are their calibres
    EXPECT_NEAR(left.axis.at(s).radius_mm, right.axis.at(left.parent_arc_mm + s).radius_mm, 0.02);
}

TEST(Lesion, SeveralInSmallVessels) {
  const GeneratedVessel made =
      generate(with({{Kind::stenosis, "circumflex artery", 20.0, 10.0, 60.0},
                     {Kind::stenosis, "left main to anterior descending artery", 40.0, 12.0, 50.0},
                     {Kind::aneurysm, "right coronary to posterior descending artery", 40.0, 15.0, 60.0}},
                    "coronary"));
  test::expect_sound_mesh(made, true);
}

std::string refused(const anatomy::LesionRequest& lesion, const char* name = "aortic_arch") {
  GenerateRequest request = with({lesion}, name);
  request.stenosis_field = "s.toml: vessel.stenosis";
  request.aneurysm_field = "s.toml: vessel.aneurysm";
  return test::message_of<base::InputError>([&] { static_cast<void>(generate(request)); });
}

TEST(Lesion, BadOnesAreRefusedByFieldValueAndRange) {
  const std::string carotid = "left carotid artery";
  EXPECT_EQ(
      refused({Kind::stenosis, "carotid", 80.0, 20.0, 50.0}),
      "s.toml: vessel.stenosis[0].branch is \"carotid\"; must be one of \"aorta to right iliac artery\", "
      "\"brachiocephalic to right carotid artery\", \"right subclavian artery\", \"left carotid artery\", "
      "\"left subclavian artery\", \"left iliac artery\", \"right internal iliac artery\", "
      "\"left internal iliac artery\"");
  EXPECT_EQ(refused({Kind::stenosis, carotid, 80.0, 20.0, 99.0}),
            "s.toml: vessel.stenosis[0].percent is 99; must be between 10 and 95");
  EXPECT_EQ(refused({Kind::aneurysm, carotid, 80.0, 20.0, 10.0}),
            "s.toml: vessel.aneurysm[0].percent is 10; must be between 20 and 300");
  EXPECT_EQ(refused({Kind::stenosis, carotid, 80.0, 2.0, 50.0}),
            "s.toml: vessel.stenosis[0].length_mm is 2; must be between 4 and 150");
  EXPECT_EQ(refused({Kind::stenosis, carotid, 300.0, 20.0, 50.0}),
            "s.toml: vessel.stenosis[0].arc_mm is 300; must be between 10 and 165");
  EXPECT_EQ(refused({Kind::stenosis, carotid, std::nan(""), 20.0, 50.0}),
            "s.toml: vessel.stenosis[0].arc_mm is nan; must be between 10 and 165");
}

/// As wide as the arch is round the wall would fold, and where a neighbour runs close by the two would be one.
TEST(Lesion, AneurysmsWithoutRoomAreRefused) {
  const std::string siphon = "internal carotid to middle cerebral artery";
  const std::string folded = refused({Kind::aneurysm, siphon, 140.0, 30.0, 300.0}, "carotid_siphon");
  EXPECT_EQ(folded.rfind("s.toml: vessel.aneurysm: they make " + siphon, 0), 0U) << folded;
  const std::string crowded = refused({Kind::aneurysm, "aorta to right iliac artery", 100.0, 140.0, 280.0});
  EXPECT_EQ(crowded.rfind("s.toml: vessel.aneurysm: they leave ", 0), 0U) << crowded;
}

TEST(Lesion, ShouldersSteeperThanHalfARightAngleAreRefused) {
  const std::string carotid = "left carotid artery";  // 6.3 mm wide there
  const double shortest_mm = 2.0 * 0.9 * 3.15 * 96.0 / (25.0 * std::sqrt(5.0));
  const std::string steep = refused({Kind::stenosis, carotid, 80.0, 0.98 * shortest_mm, 90.0});
  EXPECT_EQ(steep.rfind("s.toml: vessel.stenosis[0].length_mm is ", 0), 0U) << steep;
  const GeneratedVessel steepest =
      generate(with({{Kind::stenosis, carotid, 80.0, 1.02 * shortest_mm, 90.0}}));
  double slope = 0.0;
  for (const auto& station : test::MeasuredVessel(steepest).branch(carotid).axis.stations())
    slope = std::max(slope, std::abs(station.radius_slope));
  EXPECT_GT(slope, 0.9);
  EXPECT_LT(slope, 1.0);
  test::expect_sound_mesh(steepest, true);
}

}  // namespace
}  // namespace endowire::vessel

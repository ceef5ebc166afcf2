#include "endowire/vessel/scale.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (auto& v : mesh.vertices_mm) v *= factor;
  return mesh;
}

struct Vessel {
  const char* name;
  double diameter_mm, length_mm;
};

class UnitOf : public testing::TestWithParam<Vessel> {};

TEST_P(UnitOf, IsFoundFromWidthAndLength) {
  const TriangleMesh tube =
      test::open_tube(0.5 * GetParam().diameter_mm, GetParam().length_mm, 24, 40);  // facing outward
  TriangleMesh inward = tube;
  test::turn_over(inward);
  for (const TriangleMesh& mesh : {tube, inward}) {
    EXPECT_EQ(choose_unit(mesh, {}, "v").unit, LengthUnit::millimetre);
    EXPECT_EQ(choose_unit(scaled(mesh, 1e-3), {}, "v").unit, LengthUnit::metre);
    const UnitChoice choice = choose_unit(mesh, {}, "v");
    EXPECT_TRUE(choice.inferred);
    EXPECT_NEAR(choice.lumen_mm, GetParam().diameter_mm, 0.02 * GetParam().diameter_mm);
    EXPECT_NE(choice.text().find("mm, inferred: the lumen is then"), std::string::npos) << choice.text();
  }
}

INSTANTIATE_TEST_SUITE_P(Vessels, UnitOf,
                         testing::Values(Vessel{"coronary", 2.5, 90.0},
                                         Vessel{"circle_of_Willis", 1.2, 120.0},
                                         Vessel{"carotid", 7.0, 120.0}, Vessel{"aorta", 25.0, 400.0},
                                         Vessel{"whole_way", 14.0, 650.0}, Vessel{"short_aorta", 16.0, 80.0}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST(Unit, AnAortaInCentimetresIsRecognised) {
  for (const double diameter_cm : {0.8, 1.4, 2.2})
    EXPECT_EQ(choose_unit(test::open_tube(0.5 * diameter_cm, 28.0, 24, 40), {}, "v").unit,
              LengthUnit::centimetre);
}

TEST(Unit, AnotherThatIsNearlyAsPlausibleIsNamed) {
  const UnitChoice choice = choose_unit(test::open_tube(1.0, 45.0, 24, 40), {}, "v");
  EXPECT_EQ(choice.unit, LengthUnit::millimetre);
  EXPECT_EQ(choice.second, LengthUnit::centimetre);
  EXPECT_NE(choice.text().find("cm would be possible too"), std::string::npos) << choice.text();
}

std::string refusal(const TriangleMesh& mesh, std::optional<LengthUnit> declared) {
  try {
    static_cast<void>(choose_unit(mesh, declared, "v.stl"));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Unit, AnImpossibleOneIsRefusedWithTheLikelyFactor) {
  const TriangleMesh aorta = test::open_tube(10.0, 300.0, 24, 40);
  EXPECT_EQ(choose_unit(aorta, LengthUnit::millimetre, "v").text(), "mm, as declared");
  const std::string metres = refusal(scaled(aorta, 1e-3), LengthUnit::millimetre);
  EXPECT_NE(metres.find("v.stl: in mm the lumen is 0.0198 mm wide"), std::string::npos) << metres;
  EXPECT_NE(metres.find("1e+03 times as large it would be: was it saved in metres? then unit = \"m\""),
            std::string::npos)
      << metres;
  const std::string declared = refusal(aorta, LengthUnit::metre);
  EXPECT_NE(
      declared.find("0.001 times as large it would be: was it saved in millimetres? then unit = \"mm\""),
      std::string::npos)
      << declared;
  const std::string micrometres = refusal(scaled(aorta, 1e3), {});
  EXPECT_NE(micrometres.find("saved in micrometres? then scale it to mm first"), std::string::npos)
      << micrometres;
}

TEST(Unit, ADeclaredOneThatIsPossibleIsTakenAndALikelierOneNamed) {
  const TriangleMesh aorta = test::open_tube(10.0, 300.0, 24, 40);
  const UnitChoice choice = choose_unit(scaled(aorta, 0.1), LengthUnit::millimetre, "v");
  EXPECT_EQ(choice.unit, LengthUnit::millimetre);
  EXPECT_FALSE(choice.likelier.has_value()) << "2 mm wide and 30 mm long is a vessel";
  const UnitChoice odd = choose_unit(scaled(aorta, 0.03), LengthUnit::millimetre, "v");
  EXPECT_EQ(odd.unit, LengthUnit::millimetre);
  EXPECT_EQ(odd.likelier, LengthUnit::centimetre);
  EXPECT_NE(
      odd.text().find("mm, as declared; the lumen is then 0.595 mm wide, in cm it would be 5.95 mm, which is "
                      "likelier: if so, unit = \"cm\""),
      std::string::npos)
      << odd.text();
}

TEST(Unit, ASheetIsNoLumen) {
  TriangleMesh sheet;
  sheet.vertices_mm = {{0, 0, 0}, {50, 0, 0}, {0, 50, 0}, {50, 50, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
  const std::string text = refusal(sheet, {});
  EXPECT_NE(text.find("no wall lies across from any other, from (0.0, 0.0, 0.0) mm to (50.0, 50.0, 0.0) mm"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace endowire::vessel

// Files that say of what an instrument is built and how its tip is bent.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/io/instrument_file.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;

const std::string built = R"(schema = 1
model = "wire"
shapeable_mm = { value = 20.0, source = "estimate: the coil" }
[sources]
book = "A book"
[grip]
force_n = { value = 2.0, source = "estimate: fingers" }
torque_n_mm = { value = 2.0, source = "book: table 1" }
[material.steel]
modulus_mpa = { value = 193000.0, source = "book" }
density_g_per_mm3 = { value = 0.0079, source = "book" }
strain_limit = { value = 0.03, source = "book" }
attenuation = { value = 1.0, source = "book" }
[material.jacket]
modulus_mpa = { value = 50.0, source = "book" }
poisson_ratio = { value = 0.45, source = "book" }
density_g_per_mm3 = { value = 0.0012, source = "book" }
attenuation = { value = 0.1, source = "book" }
friction = { value = 0.06, source = "book" }
[[section]]
length_mm = { value = 100.0, source = "book" }
radius_mm = { value = 0.4, source = "book" }
core = "steel"
coat = "jacket"
core_diameter_mm = { tip = 0.2, hand = 0.5, source = "book" }
[[section]]
length_mm = { value = 400.0, source = "book" }
radius_mm = { value = 0.4, source = "book" }
core = "steel"
coat = "jacket"
flexural_rigidity_n_mm2 = { value = 300.0, source = "book" }
[[shape]]
straight_mm = { value = 5.0, source = "book" }
[[shape]]
radius_mm = { value = 10.0, source = "book" }
angle_deg = { value = 90.0, source = "book" }
plane_deg = { value = 30.0, source = "book" }
)";

TEST(BuiltInstrument, WhatFollowsFromCoreAndCoatIsWrittenDown) {
  const InstrumentFile file = parse_instrument(built, "w.toml");
  const rod::Instrument& wire = file.instrument;
  EXPECT_EQ(wire.shapeable_mm, 20.0);
  const rod::Section& tip = wire.sections.front();
  const double core = std::numbers::pi / 64.0 * 193e3 * std::pow(0.2, 4);
  const double coat = std::numbers::pi / 64.0 * 50.0 * (std::pow(0.8, 4) - std::pow(0.2, 4));
  EXPECT_NEAR(tip.flexural_rigidity_n_mm2.at_tip_side, core + coat, 1e-9);
  EXPECT_EQ(tip.flexural_rigidity_n_mm2.power, 4);
  EXPECT_EQ(tip.friction, 0.06);
  EXPECT_NEAR(wire.sections.back().flexural_rigidity_n_mm2.at_hand_side, 300.0, 1e-9);
  int following = 0;
  for (const SourcedValue& value : file.values) following += value.source.starts_with("follows from") ? 1 : 0;
  EXPECT_EQ(following, 14);  // seven of each section
}

TEST(BuiltInstrument, ShapesLieAlongTheWireFromTheTip) {
  const rod::Instrument wire = parse_instrument(built, "w.toml").instrument;
  ASSERT_EQ(wire.sections.size(), 4U);
  EXPECT_EQ(wire.sections[0].rest_curvature_per_mm, 0.0);
  EXPECT_NEAR(wire.sections[0].length_mm, 5.0, 1e-12);
  EXPECT_NEAR(wire.sections[1].rest_curvature_per_mm, 0.1, 1e-15);
  EXPECT_NEAR(wire.sections[1].rest_plane_rad, std::numbers::pi / 6.0, 1e-15);
  EXPECT_NEAR(wire.sections[1].length_mm, 5.0 * std::numbers::pi, 1e-12);
  EXPECT_EQ(wire.sections[2].rest_curvature_per_mm, 0.0);
  EXPECT_NEAR(wire.length_mm(), 500.0, 1e-12);
}

TEST(BuiltInstrument, AShapeBesideARestCurvatureIsRefused) {
  std::string text = built;
  text.insert(text.find("[[shape]]"), "rest_curvature_per_mm = { value = 0.01, source = \"book\" }\n");
  EXPECT_EQ(
      message_of<base::InputError>([&] { static_cast<void>(parse_instrument(text, "w.toml")); }),
      "w.toml: section[1].rest_curvature_per_mm is given beside [[shape]]; must be left out, or else the "
      "shape");
}

struct Spoilt {
  const char* from;
  const char* to;
  const char* message;
};

class BadBuilt : public ::testing::TestWithParam<Spoilt> {};

TEST_P(BadBuilt, IsRefusedInOneLineThatNamesFieldValueAndRange) {
  std::string text = built;
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(parse_instrument(text, "w.toml")); }),
            GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Construction, BadBuilt,
    ::testing::Values(
        Spoilt{"core = \"steel\"", "core = \"stele\"",
               "w.toml: section[0].core is \"stele\"; must be one of jacket, steel"},
        Spoilt{"tip = 0.2", "tip = 0.9",
               "w.toml: section[0].core_diameter_mm is 0.9; must be > 0 and <= 0.8, between the bore and the "
               "surface"},
        Spoilt{
            "value = 300.0", "value = 5000.0",
            "w.toml: section[1].flexural_rigidity_n_mm2 is 5000; must be > 1.005 and <= 3880: a core between "
            "bore and surface"},
        Spoilt{
            "flexural_rigidity_n_mm2 = { value = 300.0, source = \"book\" }\n", "",
            "w.toml: section[1].core_diameter_mm is missing; must be given, or else flexural_rigidity_n_mm2"},
        Spoilt{"radius_mm = { value = 0.4,", "radius_mm = { tip = 0.3, hand = 0.4,",
               "w.toml: section[0].radius_mm is a taper; must be one value in a section with a core"},
        Spoilt{"friction = { value = 0.06, source = \"book\" }\n", "",
               "w.toml: section[0].friction is missing; must be { value = …, source = \"…\" } with a value "
               "between 0 and 2"},
        Spoilt{"core = \"steel\"\n", "",
               "w.toml: section[0].core_diameter_mm is given; must be left out in a section without a core"},
        Spoilt{"value = 193000.0", "value = 1.93e9",
               "w.toml: material.steel.modulus_mpa.value is 1930000000; must be between 0 and 1000000"},
        Spoilt{"modulus_mpa = { value = 50.0, source = \"book\" }\n", "",
               "w.toml: material.jacket.modulus_mpa is missing; must be { value = …, source = \"…\" } with a "
               "value between 0 and 1000000"},
        Spoilt{"value = 20.0", "value = 501.0",
               "w.toml: shapeable_mm is 501; must be 0 … the length of the instrument"}));

INSTANTIATE_TEST_SUITE_P(
    Shape, BadBuilt,
    ::testing::Values(
        Spoilt{"straight_mm = { value = 5.0", "straight_mm = { value = 490.0",
               "w.toml: shape is 505.708 mm long; must be at most 500 mm, the length of the instrument"},
        Spoilt{"straight_mm = { value = 5.0", "radius_mm = { value = 5.0",
               "w.toml: shape[0].angle_deg is missing; must be { value = …, source = \"…\" } with a value "
               "between "
               "-1080 and 1080"},
        Spoilt{"angle_deg = { value = 90.0", "angle_deg = { value = 0.0",
               "w.toml: shape[1].angle_deg.value is 0; must be another angle, or straight_mm in place of an "
               "arc"},
        Spoilt{"plane_deg = { value = 30.0", "pitch_mm = { value = 3.0",
               "w.toml: shape[1].angle_deg is given beside pitch_mm; must be left out: a helix has turns"},
        Spoilt{"straight_mm = {",
               "points_mm = { value = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], source = \"book\" }\n"
               "straight_mm = {",
               "w.toml: shape[0].radius_mm is not the only one; must be given, or else straight_mm, or else "
               "points_mm"},
        Spoilt{"straight_mm = { value = 5.0", "points_mm = { value = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]",
               "w.toml: shape[0].points_mm.value is a list of 2; must be a list of at least three points [x, "
               "y, z] "
               "within 5000 mm of the origin"},
        Spoilt{"straight_mm = { value = 5.0",
               "points_mm = { value = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0]]",
               "w.toml: shape[0].points_mm.value[2] is no point; must be [x, y, z]"},
        Spoilt{
            "straight_mm = { value = 5.0",
            "points_mm = { value = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]]",
            "w.toml: shape[0].points_mm.value[1] is a turn of 174 degrees; must be a turn of less than 150 "
            "degrees"},
        Spoilt{"straight_mm = { value = 5.0",
               "points_mm = { value = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.01, 0.0]]",
               "w.toml: shape[0].points_mm.value[2] is 0.01 mm from the one before; must be >= 0.1 mm from "
               "it"}));

}  // namespace
}  // namespace endowire::io

#include "endowire/io/instrument_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/io/instrument_json.hpp"
#include "nlohmann/json.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;

const std::filesystem::path library = ENDOWIRE_SOURCE_DIR "/instruments";

const std::string good = R"(schema = 1
model = "wire"
[sources]
book = "A book"
[grip]
force_n = { value = 2.0, source = "estimate: fingers" }
torque_n_mm = { value = 2.0, source = "book: table 1" }
[[section]]
length_mm = { value = 100.0, source = "book" }
radius_mm = { value = 0.4, source = "book" }
flexural_rigidity_n_mm2 = { tip = 6.0, hand = 400.0, source = "book" }
torsional_rigidity_n_mm2 = { value = 5.0, source = "book" }
axial_rigidity_n = { value = 5000.0, source = "book" }
linear_density_g_per_mm = { value = 0.002, source = "book" }
friction = { value = 0.05, source = "book" }
rest_plane_deg = { value = 90.0, source = "book" }
)";

TEST(InstrumentFile, ReadsTapersSourcesAndAngles) {
  const InstrumentFile file = parse_instrument(good, "w.toml");
  ASSERT_EQ(file.instrument.sections.size(), 1U);
  const rod::Section& section = file.instrument.sections[0];
  EXPECT_EQ(section.flexural_rigidity_n_mm2.at_tip_side, 6.0);
  EXPECT_EQ(section.flexural_rigidity_n_mm2.at_hand_side, 400.0);
  EXPECT_EQ(section.torsional_rigidity_n_mm2.at_hand_side, 5.0);
  EXPECT_DOUBLE_EQ(section.rest_plane_rad, std::numbers::pi / 2);
  EXPECT_TRUE(std::isinf(section.kink_curvature_per_mm.at_tip_side));
  ASSERT_EQ(file.values.size(), 10U);
  EXPECT_EQ(file.values[4].field, "section[0].flexural_rigidity_n_mm2");
  EXPECT_EQ(file.values[4].value, "6 … 400");
  EXPECT_EQ(file.values[4].source, "book");
}

TEST(InstrumentFile, JsonGivesTheSameBitsBack) {
  rod::Instrument instrument = parse_instrument(good, "w.toml").instrument;
  instrument.sections[0].friction = 0.1 + 0.2;  // no short decimal
  const rod::Instrument back = instrument_from_json(nlohmann::json::parse(to_json(instrument).dump()));
  EXPECT_EQ(to_json(back), to_json(instrument));
  EXPECT_EQ(back.sections[0].friction, 0.1 + 0.2);
  EXPECT_TRUE(std::isinf(back.sections[0].kink_curvature_per_mm.at_hand_side));
}

// What is not linear, not round and not flat goes through a recording too.
TEST(InstrumentFile, JsonKeepsPowersRatiosHelicesAndShapeableTips) {
  rod::Instrument instrument = parse_instrument(good, "w.toml").instrument;
  rod::Section& section = instrument.sections[0];
  section.flexural_rigidity_n_mm2 = {6.1, 400.3, 4, 1.7};
  section.linear_density_g_per_mm = {1e-3, 3e-3, 2, 1e-4};
  section.kink_curvature_per_mm = {0.7, 0.3, -1};
  section.flexural_ratio = 0.3;
  section.rest_torsion_per_mm = 0.01;
  instrument.shapeable_mm = 30.0;
  const rod::Instrument back = instrument_from_json(nlohmann::json::parse(to_json(instrument).dump()));
  EXPECT_EQ(back.sections[0].flexural_rigidity_n_mm2, section.flexural_rigidity_n_mm2);
  EXPECT_EQ(back.sections[0].linear_density_g_per_mm, section.linear_density_g_per_mm);
  EXPECT_EQ(back.sections[0].kink_curvature_per_mm, section.kink_curvature_per_mm);
  EXPECT_EQ(back.sections[0].flexural_ratio, 0.3);
  EXPECT_EQ(back.sections[0].rest_torsion_per_mm, 0.01);
  EXPECT_EQ(back.shapeable_mm, 30.0);
}

// Recordings of earlier versions hold numbers where there are tapers now, and none of the later fields.
TEST(InstrumentFile, JsonOfEarlierRecordingsIsRead) {
  nlohmann::json value = to_json(parse_instrument(good, "w.toml").instrument);
  value.erase("shapeable_mm");
  nlohmann::json& section = value["sections"][0];
  section.erase("flexural_ratio");
  section.erase("rest_torsion_per_mm");
  section["linear_density_g_per_mm"] = 0.002;
  section["kink_curvature_per_mm"] = nullptr;
  section["radiopacity"] = 1.0;
  const rod::Instrument back = instrument_from_json(value);
  EXPECT_EQ(back.sections[0].linear_density_g_per_mm, rod::Taper(0.002));
  EXPECT_TRUE(std::isinf(back.sections[0].kink_curvature_per_mm.at_tip_side));
  EXPECT_EQ(back.shapeable_mm, 0.0);
}

struct BadInstrument {
  const char* from;
  const char* to;
  const char* message;
};

class BadInstruments : public ::testing::TestWithParam<BadInstrument> {};

TEST_P(BadInstruments, AreRefusedInOneLineThatNamesFieldValueAndRange) {
  std::string text = good;
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(parse_instrument(text, "w.toml")); }),
            GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadInstruments,
    ::testing::Values(
        BadInstrument{"schema = 1", "schema = \"1\"", "w.toml: schema is a text; must be 1"},
        BadInstrument{"model = \"wire\"", "model = \"\"", "w.toml: model is empty; must be a name"},
        BadInstrument{"value = 100.0", "value = -100.0",
                      "w.toml: section[0].length_mm.value is -100; must be > 0 and <= 10000"},
        BadInstrument{"value = 0.4,", "value = nan,",
                      "w.toml: section[0].radius_mm.value is nan; must be > 0 and <= 10"},
        BadInstrument{"value = 0.4,", "tip = 0.4,",
                      "w.toml: section[0].radius_mm.hand is missing; must be > 0 and <= 10"},
        BadInstrument{"tip = 6.0", "value = 3.0, tip = 6.0",
                      "w.toml: section[0].flexural_rigidity_n_mm2.value is given beside tip and hand; must "
                      "be alone, or left out"},
        BadInstrument{"value = 0.05", "value = 3",
                      "w.toml: section[0].friction.value is 3; must be between 0 and 2"},
        BadInstrument{
            "friction = {", "fricton = {",
            "w.toml: section[0].fricton is unknown; known here: length_mm, radius_mm, "
            "flexural_rigidity_n_mm2, "
            "torsional_rigidity_n_mm2, axial_rigidity_n, linear_density_g_per_mm, friction, "
            "rest_curvature_per_mm, "
            "rest_plane_deg, kink_curvature_per_mm, radiopacity, flexural_ratio, core, core_diameter_mm, "
            "bore_mm, coat"},
        BadInstrument{"friction = { value = 0.05, source = \"book\" }\n", "",
                      "w.toml: section[0].friction is missing; must be { value = …, source = \"…\" } with a "
                      "value between 0 and 2"},
        BadInstrument{"friction = { value = 0.05, source = \"book\" }", "friction = 0.05",
                      "w.toml: section[0].friction is a number; must be a table"},
        BadInstrument{"{ value = 0.05, source = \"book\" }", "{ value = 0.05 }",
                      "w.toml: section[0].friction.source is missing; must be a key of [sources] or "
                      "\"estimate: reasoning\""},
        BadInstrument{"{ value = 0.05, source = \"book\" }", "{ value = 0.05, source = \"hearsay\" }",
                      "w.toml: section[0].friction.source is \"hearsay\"; must be a key of [sources] or "
                      "\"estimate: reasoning\""},
        BadInstrument{"{ value = 0.05, source = \"book\" }", "{ value = 0.05, source = \"estimate: \" }",
                      "w.toml: section[0].friction.source is \"estimate: \"; must be a key of [sources] or "
                      "\"estimate: reasoning\""},
        BadInstrument{"book = \"A book\"", "book = 3", "w.toml: sources.book is no text; must be a citation"},
        BadInstrument{
            "[grip]\nforce_n = { value = 2.0, source = \"estimate: fingers\" }\n", "[grip]\n",
            "w.toml: grip.force_n is missing; must be { value = …, source = \"…\" } with a value > 0"}));

TEST(InstrumentFile, WithoutSectionsIsRefused) {
  const std::string text = good.substr(0, good.find("[[section]]"));
  EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(parse_instrument(text, "w.toml")); }),
            "w.toml: section is missing; must be at least one [[section]], from the tip to the hand");
}

TEST(InstrumentLibrary, EveryFileIsReadableAndCarriesItsName) {
  const std::vector<std::string> names = list_instruments({library});
  ASSERT_GE(names.size(), 30U);
  for (const std::string& name : names) {
    const InstrumentFile file = read_instrument_file(find_instrument(name, {library}));
    EXPECT_EQ(file.instrument.model, name);
    EXPECT_FALSE(file.description.empty()) << name;
  }
}

/// The angled wire is what its file says it is: 180 cm, 0.035 inch, a tip turned by 45 to 60 degrees,
/// stiffness that never jumps between sections, EI/GJ = 1.3.
TEST(InstrumentLibrary, HydrophilicAngledHangsTogether) {
  const rod::Instrument wire = read_instrument_file(library / "hydrophilic_035_angled.toml").instrument;
  EXPECT_NEAR(wire.length_mm(), 1800.0, 1e-9);
  double turn_rad = 0.0;
  for (std::size_t i = 0; i < wire.sections.size(); ++i) {
    const rod::Section& section = wire.sections[i];
    turn_rad += section.length_mm * section.rest_curvature_per_mm;
    EXPECT_NEAR(2.0 * section.radius_mm.at_tip_side, 0.889, 1e-9);
    EXPECT_NEAR(section.flexural_rigidity_n_mm2.at_tip_side / section.torsional_rigidity_n_mm2.at_tip_side,
                1.3, 1e-3);
    EXPECT_NEAR(section.flexural_rigidity_n_mm2.at_hand_side / section.torsional_rigidity_n_mm2.at_hand_side,
                1.3, 1e-3);
    if (i > 0) {
      EXPECT_EQ(wire.sections[i - 1].flexural_rigidity_n_mm2.at_hand_side,
                section.flexural_rigidity_n_mm2.at_tip_side);
    }
  }
  const double turn_deg = turn_rad * 180.0 / std::numbers::pi;
  EXPECT_GE(turn_deg, 45.0);
  EXPECT_LE(turn_deg, 60.0);
}

}  // namespace
}  // namespace endowire::io

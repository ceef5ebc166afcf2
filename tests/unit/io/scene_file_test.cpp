#include "endowire/io/scene_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/io/instrument_file.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

const std::vector<std::filesystem::path> library{ENDOWIRE_SOURCE_DIR "/instruments"};

const std::string good = R"(schema = 1
[vessel]
generate = "aortic_arch"
[access]
position_mm = [1.0, 2.0, 3.0]
direction = [0.0, 0.0, 2.0]
[[instrument]]
model = "hydrophilic_035_straight"
[simulation]
max_advance_mm = 2.0
max_torque_deg = 5.0
[[motion]]
duration_s = 10.0
hands = [{ instrument = 1, advance_mm = 100.0, torque_deg = 0.0 }]
[[motion]]
duration_s = 4.0
hands = [{ advance_mm = -10.0, torque_deg = 90.0 }]
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// A hand that steers from outside needs no script; `endowire simulate` does.
TEST(SceneFile, MotionsMayBeLeftOutWhereTheHandIsElsewhere) {
  const std::string without = good.substr(0, good.find("[[motion]]"));
  EXPECT_NE(message_of<base::InputError>([&] {
              static_cast<void>(parse_scene(without, "s.toml", library));
            }).find("motion"),
            std::string::npos);
  const SceneFile scene = parse_scene(without, "s.toml", library, Script::optional);
  EXPECT_TRUE(scene.motions.empty());
  EXPECT_TRUE(commands_of(scene).empty());
  EXPECT_EQ(parse_scene(good, "s.toml", library, Script::optional).motions.size(), 2U);
}

TEST(SceneFile, ReadsEveryPart) {
  const SceneFile scene = parse_scene(good, "s.toml", library);
  ASSERT_TRUE(scene.vessel.generate);
  EXPECT_EQ(scene.vessel.generate->name, "aortic_arch");
  EXPECT_FALSE(scene.vessel.generate->seed);
  EXPECT_TRUE(scene.access_given);
  EXPECT_EQ(scene.access.position_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.access.direction, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(scene.instrument.model, "hydrophilic_035_straight");
  EXPECT_EQ(scene.simulation.max_advance_mm, 2.0);
  ASSERT_EQ(scene.motions.size(), 2U);
  EXPECT_EQ(scene.motions[1].hands[0].torque_deg, 90.0);
}

TEST(SceneFile, AGeneratedVesselIsDescribedAndBringsItsOwnAccess) {
  std::string text = replaced("generate = \"aortic_arch\"", R"(generate = "aortic_arch"
seed = 7
open_ends = true
[vessel.parameters]
arch_type = 2
bovine = true
[[vessel.stenosis]]
branch = "left carotid artery"
arc_mm = 80
length_mm = 20
percent = 60
[[vessel.aneurysm]]
branch = "aorta to right iliac artery"
arc_mm = 380
length_mm = 70
percent = 80)");
  const std::size_t access = text.find("[access]");
  text.erase(access, text.find("[[instrument]]") - access);
  const SceneFile scene = parse_scene(text, "s.toml", library);
  EXPECT_FALSE(scene.access_given);
  ASSERT_TRUE(scene.vessel.generate);
  const vessel::GenerateRequest& request = *scene.vessel.generate;
  EXPECT_EQ(request.seed, 7U);
  EXPECT_TRUE(request.open_ends);
  EXPECT_EQ(request.settings.at("arch_type"), 2.0);
  EXPECT_EQ(request.settings.at("bovine"), 1.0);
  ASSERT_EQ(request.lesions.size(), 2U);
  EXPECT_EQ(request.lesions[0].percent, 60.0);
  EXPECT_EQ(request.lesions[1].kind, vessel::anatomy::LesionRequest::Kind::aneurysm);
  EXPECT_EQ(request.settings_prefix, "s.toml: vessel.parameters.");
  EXPECT_EQ(request.aneurysm_field, "s.toml: vessel.aneurysm");
}

TEST(SceneFile, MotionsBecomeEqualStepsThatAddUp) {
  const std::vector<TimedCommand> commands = commands_of(parse_scene(good, "s.toml", library));
  ASSERT_EQ(commands.size(), 50U + 18U);  // 100 mm / 2 mm; 90 degrees / 5 degrees, more than 10 mm / 2 mm
  double advance = 0.0;
  double torque = 0.0;
  for (const TimedCommand& timed : commands) {
    advance += timed.command.advance_mm;
    torque += timed.command.torque_rad;
  }
  EXPECT_NEAR(advance, 90.0, 1e-9);
  EXPECT_NEAR(torque, std::numbers::pi / 2, 1e-12);
  EXPECT_DOUBLE_EQ(commands[49].time_s, 10.0);
  EXPECT_DOUBLE_EQ(commands.back().time_s, 14.0);
}

TEST(SceneFile, AFixedRateSetsTheStepsInsteadOfTheirLength) {
  const SceneFile scene = parse_scene(replaced("max_advance_mm = 2.0", "step_s = 0.5"), "s.toml", library);
  EXPECT_EQ(commands_of(scene).size(), 20U + 8U);
}

TEST(SceneFile, LengthThatTheStepDividesExactlyTakesNoExtraStep) {
  const std::string text = replaced("max_advance_mm = 2.0", "max_advance_mm = 0.1");
  EXPECT_EQ(commands_of(parse_scene(text, "s.toml", library)).size(), 1000U + 100U);
}

TEST(SceneFile, OverridesReachEverySection) {
  const std::string text = replaced("[simulation]", "friction = 0.3\ngrip_force_n = 5.0\n[simulation]");
  const rod::Instrument instrument = parse_scene(text, "s.toml", library).instrument;
  EXPECT_EQ(instrument.grip_force_n, 5.0);
  for (const rod::Section& section : instrument.sections) EXPECT_EQ(section.friction, 0.3);
}

/// The good scene with a wire that can be shaped, and lines for its table.
std::string shapeable(const std::string& lines) {
  std::string text = replaced("[simulation]", lines + "\n[simulation]");
  return text.replace(text.find("hydrophilic_035_straight"), 24, "coronary_014_floppy");
}

TEST(SceneFile, TheTipIsBentAsTheSceneSays) {
  for (const char* const lines : {"tip_angle_deg = 45.0\ntip_length_mm = 3.0",
                                  "tip_angle_deg = 45.0\ntip_radius_mm = 3.819718634205488"}) {
    const rod::Instrument wire = parse_scene(shapeable(lines), "s.toml", library).instrument;
    EXPECT_NEAR(wire.sections[0].length_mm, 3.0, 1e-12);
    EXPECT_NEAR(wire.sections[0].rest_curvature_per_mm, std::numbers::pi / 4.0 / 3.0, 1e-12);
    EXPECT_EQ(wire.sections[1].rest_curvature_per_mm, 0.0);
    EXPECT_NEAR(wire.length_mm(), 1900.0, 1e-9);
  }
}

TEST(SceneFile, ATipIsNotBentFurtherThanItGoes) {
  EXPECT_EQ(
      test::message_of<base::InputError>([&] {
        static_cast<void>(
            parse_scene(shapeable("tip_angle_deg = 45.0\ntip_length_mm = 25.0"), "s.toml", library));
      }),
      "s.toml: instrument[0].tip_length_mm is 25; must be <= 20, what can be shaped of coronary_014_floppy");
  const std::string sharp = test::message_of<base::InputError>([&] {
    static_cast<void>(parse_scene(shapeable("tip_angle_deg = 90.0\ntip_length_mm = 0.9"), "s.toml", library));
  });
  EXPECT_EQ(sharp,
            "s.toml: instrument[0]: section[0].kink_curvature_per_mm is 1.6; must be > 1.2 times "
            "rest_curvature_per_mm");
}

TEST(SceneFile, AnUnknownInstrumentIsAnsweredWithTheLibrary) {
  std::string known;
  for (const std::string& name : list_instruments(library)) known += (known.empty() ? "" : ", ") + name;
  for (const char* const model : {"no_such_wire", "../instruments/hydrophilic_035_straight"}) {
    std::string text = replaced("hydrophilic_035_straight", model);
    EXPECT_EQ(
        test::message_of<base::InputError>([&] { static_cast<void>(parse_scene(text, "s.toml", library)); }),
        "s.toml: instrument[0].model is \"" + std::string(model) + "\"; must be one of " + known +
            ", or the path of a .toml file");
  }
}

TEST(SceneFile, VesselAndInstrumentPathsAreRelativeToTheScene) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "vessels");
  test::write_text(folder / "vessels/v.stl", "x");
  std::filesystem::copy_file(library[0] / "hydrophilic_035_angled.toml", folder / "own.toml");
  std::string text = replaced("generate = \"aortic_arch\"", "file = \"vessels/v.stl\"\nunit = \"cm\"");
  text.replace(text.find("hydrophilic_035_straight"), 24, "own.toml");
  test::write_text(folder / "s.toml", text);
  const SceneFile scene = read_scene_file(folder / "s.toml", {});
  EXPECT_EQ(scene.vessel.file, folder / "vessels/v.stl");
  EXPECT_EQ(scene.vessel.unit, vessel::LengthUnit::centimetre);
  EXPECT_EQ(scene.instrument.model, "hydrophilic_035_angled");
}

TEST(SceneFile, WithoutATitleTheFilesNameIsOne) {
  EXPECT_EQ(parse_scene(good, "folder/s.toml", library).title, "s");
  EXPECT_EQ(parse_scene("title = \"To the left carotid\"\n" + good, "s.toml", library).title,
            "To the left carotid");
}

TEST(SceneFile, ATargetNamesABranchOrAPoint) {
  EXPECT_FALSE(parse_scene(good, "s.toml", library).target);
  SceneFile scene = parse_scene(good +
                                    "[target]\nname = \"left carotid\"\nbranch = \"1.3\"\nbeyond_ostium_mm = "
                                    "60.0\nwithin_radii = 1.0\n",
                                "s.toml", library);
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.target->name, "left carotid");
  EXPECT_EQ(scene.target->branch, "1.3");
  EXPECT_EQ(scene.target->beyond_ostium_mm, 60.0);
  EXPECT_EQ(scene.target->within_radii, 1.0);
  scene = parse_scene(good + "[target]\nnear_mm = [1, 2, 3]\n", "s.toml", library);
  ASSERT_TRUE(scene.target);
  EXPECT_TRUE(scene.target->branch.empty());
  EXPECT_EQ(scene.target->near_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(scene.target->beyond_ostium_mm);
}

TEST(SceneFile, ThePerforationThresholdSaysWhereItComesFrom) {
  EXPECT_EQ(parse_scene(good, "s.toml", library).perforation_source.rfind("estimate: ", 0), 0U);
  const std::string own = good + "[wall]\nperforation_force_n = 0.8\n";
  EXPECT_EQ(parse_scene(own, "s.toml", library).perforation_source, "the scene");
  EXPECT_EQ(
      parse_scene(own + "perforation_source = \"a bench test\"\n", "s.toml", library).perforation_source,
      "a bench test");
}

// A recording is read where neither its vessel nor its instrument can be found.
TEST(SceneFile, PartsOfARecordingStandInForFiles) {
  std::string text = replaced("generate = \"aortic_arch\"", "file = \"gone.stl\"");
  text.replace(text.find("hydrophilic_035_straight"), 24, "gone");
  RecordedParts parts{"moved.stl", parse_scene(good, "s.toml", library).instrument};
  const SceneFile scene = parse_scene(text, "s.toml", parts);
  EXPECT_EQ(scene.vessel.file, "moved.stl");
  EXPECT_EQ(scene.instrument.model, "hydrophilic_035_straight");
  EXPECT_EQ(commands_of(scene).size(), 68U);
  parts.instrument.sections[0].length_mm = -1.0;
  EXPECT_THROW(static_cast<void>(parse_scene(text, "s.toml", parts)), base::InputError);
}

struct BadScene {
  const char* from;
  const char* to;
  const char* message;
};

class BadScenes : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedInOneLineThatNamesFieldValueAndRange) {
  const std::string text = replaced(GetParam().from, GetParam().to);
  const std::string message =
      message_of<base::InputError>([&] { static_cast<void>(parse_scene(text, "s.toml", library)); });
  EXPECT_EQ(message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadScenes,
    ::testing::Values(
        BadScene{"schema = 1", "schema = 1\ntarget = { within_radii = 1.0 }",
                 "s.toml: target is given no branch, near_mm or opening; must be given one of branch, "
                 "near_mm and opening"},
        BadScene{
            "schema = 1", "schema = 1\ntarget = { branch = \"1\", near_mm = [1, 2, 3] }",
            "s.toml: target is given more than one place; must be given one of branch, near_mm and opening"},
        BadScene{
            "schema = 1", "schema = 1\ntarget = { branch = \"\" }",
            "s.toml: target.branch is empty; must be the name of a branch, as endowire inspect lists it"},
        BadScene{"schema = 1", "schema = 1\ntarget = { branch = \"1\", beyond_ostium_mm = -2.0 }",
                 "s.toml: target.beyond_ostium_mm is -2; must be between 0 and 10000"},
        BadScene{"schema = 1", "schema = 2", "s.toml: schema is 2; must be 1"},
        BadScene{"schema = 1\n", "", "s.toml: schema is missing; must be 1"},
        BadScene{"schema = 1", "schema = 1.0", "s.toml: schema is 1; must be 1"},
        BadScene{"[vessel]", "[vessels]",
                 "s.toml: vessels is unknown; known here: schema, title, vessel, access, environment, wall, "
                 "rods, solver, instrument, simulation, motion, target"},
        BadScene{"generate = ", "genrate = ",
                 "s.toml: vessel.genrate is unknown; known here: file, unit, threshold, threshold_high, "
                 "label, smooth, keep, generate, seed, open_ends, "
                 "parameters, stenosis, aneurysm"},
        BadScene{"\"aortic_arch\"", "\"tube\"",
                 "s.toml: vessel.generate is \"tube\"; must be one of \"aortic_arch\", \"iliofemoral\", "
                 "\"renal\", \"coronary\", \"carotid_siphon\""},
        BadScene{"\"aortic_arch\"", "7",
                 "s.toml: vessel.generate is a number; must be one of \"aortic_arch\", \"iliofemoral\", "
                 "\"renal\", \"coronary\", \"carotid_siphon\""},
        BadScene{"\"aortic_arch\"", "\"aortic_arch\"\nunit = \"inch\"",
                 "s.toml: vessel.unit is \"inch\"; must be \"mm\", \"cm\" or \"m\""},
        BadScene{"generate = \"aortic_arch\"", "",
                 "s.toml: vessel is given neither file nor generate; must be given one of the two"},
        BadScene{"generate = \"aortic_arch\"", "generate = \"aortic_arch\"\nfile = \"v.stl\"",
                 "s.toml: vessel is given both file and generate; must be given one of the two"},
        BadScene{"generate = \"aortic_arch\"", "file = \"none.stl\"",
                 "s.toml: vessel.file is \"none.stl\"; must be an existing file (none.stl is none)"},
        BadScene{"generate = \"aortic_arch\"", "generate = \"aortic_arch\"\nseed = -1",
                 "s.toml: vessel.seed is -1; must be an integer between 0 and 9223372036854775807"},
        BadScene{"generate = \"aortic_arch\"", "generate = \"aortic_arch\"\nopen_ends = 1",
                 "s.toml: vessel.open_ends is a number; must be true or false"},
        BadScene{"generate = \"aortic_arch\"",
                 "generate = \"aortic_arch\"\nparameters = { arch_type = \"II\" }",
                 "s.toml: vessel.parameters.arch_type is a text; must be a number"},
        BadScene{"generate = \"aortic_arch\"", "generate = \"aortic_arch\"\nparameters = 3",
                 "s.toml: vessel.parameters is a number; must be a table"},
        BadScene{
            "generate = \"aortic_arch\"",
            "generate = \"aortic_arch\"\nstenosis = [{ branch = \"left carotid artery\", length_mm = 20 }]",
            "s.toml: vessel.stenosis[0].arc_mm is missing; must be a finite number"},
        BadScene{"generate = \"aortic_arch\"", "file = \"v.stl\"\nseed = 3",
                 "s.toml: vessel.seed is given with a file; must be left out: it belongs to generate"},
        BadScene{"position_mm = [1.0, 2.0, 3.0]", "position_mm = [1.0, 2.0]",
                 "s.toml: access.position_mm is a list of 2; must be a list of three finite numbers"},
        BadScene{"position_mm = [1.0, 2.0, 3.0]", "position_mm = [1.0, nan, 3.0]",
                 "s.toml: access.position_mm[1] is nan; must be a finite number"},
        BadScene{"position_mm = [1.0, 2.0, 3.0]", "position_mm = [1.0, \"a\", 3.0]",
                 "s.toml: access.position_mm[1] is a text; must be a finite number"},
        BadScene{"position_mm = [1.0, 2.0, 3.0]\n", "",
                 "s.toml: access.position_mm is missing; must be a list of three finite numbers"},
        BadScene{"direction = [0.0, 0.0, 2.0]", "direction = [0, 0, 0]",
                 "s.toml: access.direction is [0, 0, 0]; must be a vector of some length, into the vessel"},
        BadScene{"direction = [0.0, 0.0, 2.0]", "direction = [0.0, 0.0, 2.0]\nopening = 1",
                 "s.toml: access is given both an opening and a position; must be given one of the two"},
        BadScene{"position_mm = [1.0, 2.0, 3.0]\ndirection = [0.0, 0.0, 2.0]", "opening = 0",
                 "s.toml: access.opening is 0; must be an integer between 1 and 10000"},
        BadScene{
            "hydrophilic_035_straight", "none.toml",
            "s.toml: instrument[0].model is \"none.toml\"; must be an existing file (none.toml is none)"},
        BadScene{"[simulation]", "[[instrument]]\nmodel = \"hydrophilic_035_angled\"\n[simulation]",
                 "s.toml: instrument is a list of 2; must be one: this version simulates one instrument"},
        BadScene{"[simulation]", "friction = -0.1\n[simulation]",
                 "s.toml: instrument[0].friction is -0.1; must be between 0 and 2"},
        BadScene{"[simulation]", "tip_angle_deg = 30\ntip_length_mm = 5\n[simulation]",
                 "s.toml: instrument[0].tip_angle_deg is 30; must be left out: the tip of "
                 "hydrophilic_035_straight "
                 "cannot be shaped"},
        BadScene{
            "[simulation]", "tip_length_mm = 5\n[simulation]",
            "s.toml: instrument[0].tip_length_mm is given without tip_angle_deg; must be left out, or given "
            "beside it"},
        BadScene{"[simulation]", "tip_angle_deg = 30\n[simulation]",
                 "s.toml: instrument[0].tip_length_mm is missing; must be given, or else tip_radius_mm"},
        BadScene{"[simulation]", "tip_angle_deg = 300\ntip_length_mm = 5\n[simulation]",
                 "s.toml: instrument[0].tip_angle_deg is 300; must be between -270 and 270"},
        BadScene{"[simulation]", "grip_force_n = 0\n[simulation]",
                 "s.toml: instrument[0].grip_force_n is 0; must be > 0"},
        BadScene{"max_advance_mm = 2.0", "max_advance_mm = 11",
                 "s.toml: simulation.max_advance_mm is 11; must be between 0.001 and 10"},
        BadScene{"max_advance_mm = 2.0", "step_s = -1",
                 "s.toml: simulation.step_s is -1; must be between 0.0001 and 3600"},
        BadScene{"max_torque_deg = 5.0", "max_torque_deg = inf",
                 "s.toml: simulation.max_torque_deg is inf; must be between 0.01 and 90"},
        BadScene{"[simulation]", "[wall]\nmodulus_mpa = 0.01\n[simulation]",
                 "s.toml: wall.modulus_mpa is 0.01; must be between 0.1 and 1000"},
        BadScene{"[simulation]", "[wall]\nmax_deflection_mm = 0.5\n[simulation]",
                 "s.toml: wall.max_deflection_mm is 0.5; must be between 0.01 and 0.18"},
        BadScene{"[simulation]", "[rods]\nadaptive = false\nrod_length_mm = 0.1\n[simulation]",
                 "s.toml: rods.rod_length_mm is 0.1; must be between 0.2 and 20"},
        BadScene{
            "[simulation]", "[rods]\nrod_length_mm = 2\n[simulation]",
            "s.toml: rods.rod_length_mm is given for rods that adapt; must be given with adaptive = false"},
        BadScene{
            "[simulation]", "[rods]\nadaptive = false\nshape_tolerance_mm = 0.1\n[simulation]",
            "s.toml: rods.shape_tolerance_mm is given for uniform rods; must be given with adaptive = true"},
        BadScene{"[simulation]", "[rods]\nlongest_mm = 4\nshortest_mm = 5\n[simulation]",
                 "s.toml: rods.shortest_mm is 5; must be between 0.2 and 4"},
        BadScene{"[simulation]", "[rods]\nmax_turn_deg = 100\n[simulation]",
                 "s.toml: rods.max_turn_deg is 100; must be between 1 and 90"},
        BadScene{"[simulation]", "[solver]\nmax_iterations = 2.5\n[simulation]",
                 "s.toml: solver.max_iterations is 2.5; must be an integer between 1 and 10000"},
        BadScene{"[simulation]", "[environment]\nblood_density_g_per_mm3 = 1.06\n[simulation]",
                 "s.toml: environment.blood_density_g_per_mm3 is 1.06; must be between 0 and 0.002"},
        BadScene{"duration_s = 4.0", "duration_s = -1",
                 "s.toml: motion[1].duration_s is -1; must be > 0 and <= 1000000"},
        BadScene{"duration_s = 4.0", "duration_s = true",
                 "s.toml: motion[1].duration_s is a boolean; must be a number, > 0 and <= 1000000"},
        BadScene{"instrument = 1,", "instrument = 2,",
                 "s.toml: motion[0].hands[0].instrument is 2; must be 1"},
        BadScene{"advance_mm = 100.0", "advance_mm = nan",
                 "s.toml: motion[0].hands[0].advance_mm is nan; must be between -10000 and 10000"},
        BadScene{"advance_mm = 100.0", "advance_mm = 1900",
                 "s.toml: motion[0].hands[0].advance_mm is 1900; must be <= 1800, what is left of the 1800 "
                 "mm of the wire"},
        BadScene{"advance_mm = 100.0", "adance_mm = 100.0",
                 "s.toml: motion[0].hands[0].adance_mm is unknown; known here: instrument, advance_mm, "
                 "torque_deg"},
        BadScene{"hands = [{ advance_mm = -10.0, torque_deg = 90.0 }]", "hands = [{}, {}]",
                 "s.toml: motion[1].hands is a list of 2; must be at most one: there is one instrument"},
        BadScene{"hands = [{ advance_mm = -10.0, torque_deg = 90.0 }]", "hands = [3]",
                 "s.toml: motion[1].hands[0] is a number; must be a table"}));

TEST(SceneFile, SyntaxErrorsNameLineAndColumn) {
  const std::string message = message_of<base::InputError>(
      [] { static_cast<void>(parse_scene("schema = 1\n[vessel\n", "s.toml", library)); });
  EXPECT_EQ(message.rfind("s.toml: line 2, column ", 0), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(SceneFile, AScriptOfTooManyStepsIsRefusedBeforeMemoryIs) {
  std::string text = replaced("duration_s = 10.0", "duration_s = 1000000.0");
  text.replace(text.find("max_advance_mm = 2.0"), 20, "step_s = 0.001");
  EXPECT_EQ(
      message_of<base::InputError>([&] { static_cast<void>(parse_scene(text, "s.toml", library)); }),
      "s.toml: motion[0].duration_s is 1000000, which brings the script to 1000000000 steps; must be short "
      "enough for 1000000 steps in all");
}

TEST(SceneFile, MissingEmptyAndFolderAreNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name) {
    return message_of<base::InputError>([&] { static_cast<void>(read_scene_file(folder / name, library)); });
  };
  EXPECT_EQ(message("none.toml"), (folder / "none.toml").string() + ": no such file");
  test::write_text(folder / "empty.toml", "");
  EXPECT_EQ(message("empty.toml"), (folder / "empty.toml").string() + ": is empty");
  std::filesystem::create_directory(folder / "f.toml");
  EXPECT_EQ(message("f.toml"), (folder / "f.toml").string() + ": is a folder; must be a file");
}

class ShippedScenes : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedScenes, AreReadable) {
  const std::filesystem::path path = std::filesystem::path(ENDOWIRE_SOURCE_DIR "/scenes") / GetParam();
  if (std::string(GetParam()) == "femoral_entry.toml" &&
      !std::filesystem::exists(ENDOWIRE_SHARED_DIR "/vessels/femoral_to_neuro/lumen_mm.stl"))
    GTEST_SKIP() << "needs ../shared/vessels/femoral_to_neuro";
  const SceneFile scene = read_scene_file(path, library);
  double advance = 0.0;
  for (const TimedCommand& timed : commands_of(scene)) advance += timed.command.advance_mm;
  EXPECT_NEAR(advance, 450.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenes, ::testing::Values("femoral_entry.toml", "generated_entry.toml"));

}  // namespace
}  // namespace endowire::io

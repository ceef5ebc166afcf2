#include "endowire/rod/instrument.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

struct Bad {
  std::string name;
  std::function<void(Instrument&)> spoil;
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const Bad& b) {
  return out << b.name;
}

class BadInstrument : public testing::TestWithParam<Bad> {};

// Each row breaks when its field is no longer checked, or named otherwise than the field is called.
TEST_P(BadInstrument, IsRefusedWithOneExactLine) {
  Instrument wire = test::curved_tip_wire();
  ASSERT_NO_THROW(wire.validate("wire.toml"));
  GetParam().spoil(wire);
  EXPECT_EQ(test::message_of<base::InputError>([&] { wire.validate("wire.toml"); }), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadInstrument,
    testing::Values(
        Bad{"no_section", [](Instrument& w) { w.sections.clear(); },
            "wire.toml: section has no entry; must have at least one"},
        Bad{"length", [](Instrument& w) { w.sections[1].length_mm = -3.0; },
            "wire.toml: section[1].length_mm is -3; must be 0.1 … 5000"},
        Bad{"length_nan", [](Instrument& w) { w.sections[0].length_mm = std::nan(""); },
            "wire.toml: section[0].length_mm is nan; must be 0.1 … 5000"},
        Bad{"bending_tip", [](Instrument& w) { w.sections[0].flexural_rigidity_n_mm2.at_tip_side = 0.0; },
            "wire.toml: section[0].flexural_rigidity_n_mm2.at_tip_side is 0; must be 0.001 … 100000"},
        Bad{"bending_hand", [](Instrument& w) { w.sections[0].flexural_rigidity_n_mm2.at_hand_side = 1e6; },
            "wire.toml: section[0].flexural_rigidity_n_mm2.at_hand_side is 1e+06; must be 0.001 … 100000"},
        Bad{"torsion", [](Instrument& w) { w.sections[1].torsional_rigidity_n_mm2.at_hand_side = -1.0; },
            "wire.toml: section[1].torsional_rigidity_n_mm2.at_hand_side is -1; must be 0.001 … 100000"},
        Bad{"axial", [](Instrument& w) { w.sections[0].axial_rigidity_n.at_tip_side = 0.5; },
            "wire.toml: section[0].axial_rigidity_n.at_tip_side is 0.5; must be 1 … 10000000"},
        Bad{"radius", [](Instrument& w) { w.sections[0].radius_mm.at_tip_side = -2.0; },
            "wire.toml: section[0].radius_mm.at_tip_side is -2; must be 0.05 … 5"},
        Bad{"density", [](Instrument& w) { w.sections[0].linear_density_g_per_mm = -0.1; },
            "wire.toml: section[0].linear_density_g_per_mm.at_tip_side is -0.1; must be 0 … 1"},
        Bad{"friction", [](Instrument& w) { w.sections[1].friction = 2.5; },
            "wire.toml: section[1].friction is 2.5; must be 0 … 2"},
        Bad{"rest_curvature", [](Instrument& w) { w.sections[0].rest_curvature_per_mm = 3.0; },
            "wire.toml: section[0].rest_curvature_per_mm is 3; must be -2 … 2"},
        Bad{"rest_plane", [](Instrument& w) { w.sections[0].rest_plane_rad = 11.0; },
            "wire.toml: section[0].rest_plane_rad is 11; must be -10 … 10"},
        Bad{"ratio", [](Instrument& w) { w.sections[0].flexural_ratio = 0.0; },
            "wire.toml: section[0].flexural_ratio is 0; must be 0.01 … 100"},
        Bad{"torsion_of_rest", [](Instrument& w) { w.sections[0].rest_torsion_per_mm = 2.5; },
            "wire.toml: section[0].rest_torsion_per_mm is 2.5; must be -2 … 2"},
        Bad{"power", [](Instrument& w) { w.sections[0].axial_rigidity_n.power = 3; },
            "wire.toml: section[0].axial_rigidity_n.power is 3; must be 1, 2, 4 or -1"},
        Bad{"power_of_an_integral", [](Instrument& w) { w.sections[0].axial_rigidity_n.power = -1; },
            "wire.toml: section[0].axial_rigidity_n.power is -1; must be 1, 2 or 4"},
        Bad{"power_of_radius", [](Instrument& w) { w.sections[0].radius_mm.power = 2; },
            "wire.toml: section[0].radius_mm.power is 2; must be 1"},
        Bad{"base",
            [](Instrument& w) {
              w.sections[0].flexural_rigidity_n_mm2 = {4.0, 6.0, 4, 5.0};
            },
            "wire.toml: section[0].flexural_rigidity_n_mm2.base is 5; must be below or above the values at "
            "both ends"},
        Bad{"shapeable", [](Instrument& w) { w.shapeable_mm = 501.0; },
            "wire.toml: shapeable_mm is 501; must be 0 … the length of the instrument"},
        Bad{"kink_zero", [](Instrument& w) { w.sections[1].kink_curvature_per_mm = 0.0; },
            "wire.toml: section[1].kink_curvature_per_mm is 0; must be > 0"},
        Bad{"kink_nan", [](Instrument& w) { w.sections[1].kink_curvature_per_mm = std::nan(""); },
            "wire.toml: section[1].kink_curvature_per_mm.at_tip_side is nan; must be > 0"},
        Bad{"kink_below_rest", [](Instrument& w) { w.sections[0].kink_curvature_per_mm = 0.055; },
            "wire.toml: section[0].kink_curvature_per_mm is 0.055; must be > 1.2 times "
            "rest_curvature_per_mm"},
        Bad{"radiopacity", [](Instrument& w) { w.sections[0].radiopacity = -1.0; },
            "wire.toml: section[0].radiopacity.at_tip_side is -1; must be 0 … 1000"},
        Bad{"too_short",
            [](Instrument& w) {
              w.sections[0].length_mm = 4.0;
              w.sections[1].length_mm = 5.0;
            },
            "wire.toml: length is 9; must be 10 … 5000 mm over all sections"},
        Bad{"too_long",
            [](Instrument& w) {
              w.sections[0].length_mm = 2501.0;
              w.sections[1].length_mm = 2500.0;
            },
            "wire.toml: length is 5001; must be 10 … 5000 mm over all sections"},
        Bad{"grip_force", [](Instrument& w) { w.grip_force_n = 0.0; },
            "wire.toml: grip_force_n is 0; must be 0.001 … 1000"},
        Bad{"grip_torque", [](Instrument& w) { w.grip_torque_n_mm = -1.0; },
            "wire.toml: grip_torque_n_mm is -1; must be 0.001 … 10000"}),
    [](const auto& instance) { return instance.param.name; });

TEST(Instrument, LengthIsTheSumOfItsSections) {
  EXPECT_DOUBLE_EQ(test::curved_tip_wire().length_mm(), 500.0);
  EXPECT_DOUBLE_EQ(test::hydrophilic_035_angled().length_mm(), 1800.0);
}

}  // namespace
}  // namespace endowire::rod

#include "endowire/rod/construction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/rod/material_line.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::rod {
namespace {

constexpr double kPi = std::numbers::pi;

/// Nitinol in a jacket of polyurethane, 0.035 inch wide.
Construction jacketed() {
  Construction c;
  c.core_diameter_mm = {0.2, 0.64};
  c.outer_diameter_mm = 0.889;
  c.core = {48e3, 0.3, 6.45e-3, 0.08, 0.8};
  c.coat = {50.0, 0.45, 2.0e-3, 1.0, 0.4};
  return c;
}

Section built(const Construction& c) {
  Section section;
  section.length_mm = 200.0;
  apply(c, "", section);
  return section;
}

// Every quantity at every place is that of the composite section there, computed from its diameters.
TEST(Construction, EverythingFollowsFromTheDiametersAllAlong) {
  for (const double bore : {0.0, 0.15}) {
    Construction c = jacketed();
    c.bore_mm = bore;
    Instrument wire;
    wire.sections = {built(c)};
    const MaterialLine line(wire);
    for (double f = 0.0; f <= 1.0; f += 0.125) {
      const double d = 0.2 + 0.44 * f;
      const double core4 = std::pow(d, 4) - std::pow(bore, 4);
      const double coat4 = std::pow(0.889, 4) - std::pow(d, 4);
      const double core2 = d * d - bore * bore;
      const double coat2 = 0.889 * 0.889 - d * d;
      const double arc = 200.0 * f;
      EXPECT_NEAR(line.flexural_rigidity_n_mm2(arc), kPi / 64.0 * (48e3 * core4 + 50.0 * coat4), 1e-10);
      EXPECT_NEAR(line.torsional_rigidity_n_mm2(arc), kPi / 32.0 * (48e3 / 2.6 * core4 + 50.0 / 2.9 * coat4),
                  1e-10);
      EXPECT_NEAR(line.linear_density_g_per_mm(arc),
                  kPi / 4.0 * (6.45e-3 * core2 + 2.0e-3 * coat2 + 1e-3 * bore * bore), 1e-15);
      EXPECT_NEAR(line.radiopacity(arc), (0.8 * core2 + 0.4 * coat2) / (0.889 * 0.889), 1e-14);
      EXPECT_NEAR(line.kink_per_mm(arc), 0.16 / d, 1e-14);
      EXPECT_DOUBLE_EQ(line.radius_mm(arc), 0.4445);
    }
    EXPECT_NEAR(wire.sections[0].axial_rigidity_n.at_hand_side,
                kPi / 4.0 * (48e3 * (0.64 * 0.64 - bore * bore) + 50.0 * (0.889 * 0.889 - 0.64 * 0.64)),
                1e-9);
  }
}

// The middle of a core that grows from d to 3d bends as 2d does, five times softer than halfway between its ends.
TEST(Construction, ATaperedCoreFollowsTheFourthPowerOfItsDiameter) {
  Construction c = jacketed();
  c.coat = {};
  c.core_diameter_mm = {0.2, 0.6};
  Instrument wire;
  wire.sections = {built(c)};
  const double middle = MaterialLine(wire).flexural_rigidity_n_mm2(100.0);
  const double tip = kPi / 64.0 * 48e3 * std::pow(0.2, 4);
  EXPECT_NEAR(middle / tip, 16.0, 1e-12);
  EXPECT_GT(0.5 * (1.0 + 81.0), 2.5 * middle / tip);
}

/// Gauss's rule of two points on cells that double in length away from the thin end: the integrand, written from the diameters, varies little in each.
double over_wall(double thin_end, double thick_end, const std::function<double(double)>& f) {
  double sum = 0.0;
  double from = 0.0;
  constexpr int kDoublings = 24;
  constexpr int kCells = 400;
  for (int doubling = kDoublings; doubling >= 0; --doubling) {
    const double to = std::pow(0.5, doubling);
    for (int i = 0; i < kCells; ++i) {
      const double middle = from + (to - from) * (i + 0.5) / kCells;
      for (const double side : {-1.0, 1.0}) {
        const double part = middle + side * 0.5 * (to - from) / kCells / std::sqrt(3.0);
        sum += 0.5 * (to - from) / kCells * f(thin_end + (thick_end - thin_end) * part);
      }
    }
    from = to;
  }
  return sum;
}

// A tube whose wall thins away, at either end, bare or in a coat. Breaks when the stiffness, which nearly vanishes there, is sampled as if it
// did not: then EI of the stretch is 6 % off, and more.
TEST(Construction, ATubeWithAThinningWallBendsAsTheIntegralOfItsComplianceSays) {
  constexpr double kBore_mm = 0.4;
  for (const double coat_mpa : {0.0, 30.0}) {
    for (const double wall_mm : {0.02, 0.002, 2e-4, 4e-5}) {
      for (const bool thin_at_tip : {true, false}) {
        SCOPED_TRACE(testing::Message() << "wall " << wall_mm << " coat " << coat_mpa << " " << thin_at_tip);
        Construction c = jacketed();
        c.coat.modulus_mpa = coat_mpa;
        c.bore_mm = kBore_mm;
        const double thin = kBore_mm + wall_mm;
        constexpr double kThick_mm = 0.8;
        c.core_diameter_mm = thin_at_tip ? Taper(thin, kThick_mm) : Taper(kThick_mm, thin);
        Instrument wire;
        wire.sections = {built(c)};
        const MaterialLine line(wire);
        const auto rigidity = [&](double core_mpa, double shell_mpa, int power, double d) {
          return core_mpa * (std::pow(d, power) - std::pow(kBore_mm, power)) +
                 shell_mpa * (std::pow(c.outer_diameter_mm, power) - std::pow(d, power));
        };
        const auto in_series = [&](double core_mpa, double shell_mpa, int power) {
          return 1.0 / over_wall(thin, kThick_mm,
                                 [&](double d) { return 1.0 / rigidity(core_mpa, shell_mpa, power, d); });
        };
        EXPECT_NEAR(line.flexural_rigidity_n_mm2(0.0, 200.0) / (kPi / 64.0 * in_series(48e3, coat_mpa, 4)),
                    1.0, 1e-7);
        EXPECT_NEAR(line.torsional_rigidity_n_mm2(0.0, 200.0) /
                        (kPi / 32.0 * in_series(48e3 / 2.6, coat_mpa / 2.9, 4)),
                    1.0, 1e-7);
        EXPECT_NEAR(line.axial_rigidity_n(0.0, 200.0) / (kPi / 4.0 * in_series(48e3, coat_mpa, 2)), 1.0,
                    1e-7);
        const double mass = over_wall(thin, kThick_mm, [&](double d) {
          return rigidity(6.45e-3, 2.0e-3, 2, d) + 1e-3 * kBore_mm * kBore_mm;
        });
        EXPECT_NEAR(line.mass_g(0.0, 200.0) / (200.0 * kPi / 4.0 * mass), 1.0, 1e-9);
      }
    }
  }
}

TEST(Construction, DiameterAndRigidityAreInversesOfEachOther) {
  Construction c = jacketed();
  c.bore_mm = 0.1;
  for (const double rigidity : {6.0, 27.0, 400.0}) {
    c.core_diameter_mm = core_diameter_mm(c, rigidity);
    EXPECT_NEAR(flexural_rigidity_n_mm2(c), rigidity, 1e-11 * rigidity);
  }
}

// A coat of platinum is heavier than the core: mass falls as the core grows.
TEST(Construction, ACoatMayOutweighItsCore) {
  Construction c = jacketed();
  c.coat = {0.0, 0.3, 15e-3, 1.0, 8.0};
  const Section section = built(c);
  EXPECT_GT(section.linear_density_g_per_mm.at_tip_side, section.linear_density_g_per_mm.at_hand_side);
  Instrument wire;
  wire.sections = {section};
  EXPECT_NEAR(MaterialLine(wire).linear_density_g_per_mm(100.0),
              kPi / 4.0 * (6.45e-3 * 0.42 * 0.42 + 15e-3 * (0.889 * 0.889 - 0.42 * 0.42)), 1e-15);
}

TEST(Construction, ACoreOutsideItsSectionIsRefused) {
  Construction c = jacketed();
  c.core_diameter_mm = {0.2, 0.9};
  EXPECT_EQ(test::message_of<base::InputError>([&] { static_cast<void>(built(c)); }),
            "core_diameter_mm is 0.9; must be > 0 and <= 0.889, between the bore and the surface");
  c.core_diameter_mm = {0.2, 0.6};
  c.bore_mm = 0.2;
  EXPECT_THROW(static_cast<void>(built(c)), base::InputError);
}

}  // namespace
}  // namespace endowire::rod

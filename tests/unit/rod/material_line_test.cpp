#include "endowire/rod/material_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>
#include <utility>

#include "endowire/base/error.hpp"
#include "endowire/rod/rest_shape.hpp"
#include "support/wires.hpp"

namespace endowire::rod {
namespace {

/// Three sections, all tapered, all different, the middle one nearly uniform (the branch of the logarithm).
Instrument three_sections() {
  Instrument w;
  w.model = "three";
  for (int k = 0; k < 3; ++k) {
    const double f = 1.0 + k;
    Section s;
    s.length_mm = 7.0 + 3.0 * k;
    s.flexural_rigidity_n_mm2 = {4.0 * f, 4.0 * f * (k == 1 ? 1.0 + 1e-8 : 3.0)};
    s.torsional_rigidity_n_mm2 = {3.0 * f, 1.0 * f};
    s.axial_rigidity_n = {1000.0 * f, 1500.0 * f};
    s.radius_mm = {0.3, 0.3 + 0.05 * k};
    s.linear_density_g_per_mm = 1e-3 * f;
    s.friction = 0.1 * k;
    s.rest_curvature_per_mm = 0.02 * (k - 1);
    s.rest_plane_rad = 0.7 * k;
    s.kink_curvature_per_mm = 0.9 - 0.2 * k;
    w.sections.push_back(s);
  }
  return w;
}

/// The same lengths, as a core in a coat tapers: powers, with and without a base, the last section not round and on a helix.
Instrument three_cores() {
  Instrument w = three_sections();
  w.sections[0].flexural_rigidity_n_mm2 = {2.0, 160.0, 4};
  w.sections[0].torsional_rigidity_n_mm2 = {2.0, 100.0, 4, 0.5};
  w.sections[0].axial_rigidity_n = {300.0, 2400.0, 2};
  w.sections[1].flexural_rigidity_n_mm2 = {8.0, 2.0, 4, 1.5};
  w.sections[1].axial_rigidity_n = {2000.0, 1000.0, 2, 700.0};
  w.sections[1].linear_density_g_per_mm = {4e-3, 2e-3, 2, 5e-3};
  w.sections[1].kink_curvature_per_mm = {0.9, 0.3, -1};
  w.sections[2].flexural_ratio = 0.2;
  w.sections[2].linear_density_g_per_mm = {1e-3, 3e-3, 4, 5e-4};
  w.sections[2].rest_torsion_per_mm = 0.3;
  return w;
}

/// Section and fraction at an arc, written again from the definition; behind the end the last values hold.
struct Place {
  const Section* section;
  double fraction;
};

Place place_at(const Instrument& w, double arc) {
  double start = 0.0;
  for (const Section& s : w.sections) {
    if (arc < start + s.length_mm || &s == &w.sections.back())
      return {&s, std::min(1.0, std::max(0.0, (arc - start) / s.length_mm))};
    start += s.length_mm;
  }
  return {nullptr, 0.0};
}

/// Rest curvature from the definition: κ0 of the section, and within 1 mm of a border linearly on to that of the other.
Eigen::Vector2d rest_at(const Instrument& w, double arc) {
  const auto of_section = [&](std::size_t k, double behind) {
    const Section& section = w.sections[k];
    const double plane = section.rest_plane_rad + section.rest_torsion_per_mm * behind;
    return Eigen::Vector2d(section.rest_curvature_per_mm * std::cos(plane),
                           section.rest_curvature_per_mm * std::sin(plane));
  };
  std::size_t k = 0;
  double start = 0.0;
  while (k + 1 < w.sections.size() && arc >= start + w.sections[k].length_mm)
    start += w.sections[k++].length_mm;
  const double length = w.sections[k].length_mm;
  const double behind = std::min(arc - start, length);
  Eigen::Vector2d rest = of_section(k, behind);
  // Half of the jump at a border is missing there, and less of it up to 1 mm away.
  if (k > 0 && behind < 1.0)
    rest -= 0.5 * (1.0 - behind) * (of_section(k, 0.0) - of_section(k - 1, w.sections[k - 1].length_mm));
  if (k + 1 < w.sections.size() && length - behind < 1.0)
    rest += 0.5 * (1.0 - (length - behind)) * (of_section(k + 1, 0.0) - of_section(k, length));
  return rest;
}

/// From the definition: base ± a power of something linear.
double value(const Taper& t, double f) {
  if (t.power == 1) return t.at_tip_side + f * (t.at_hand_side - t.at_tip_side);
  const double sign = t.at_tip_side < t.base ? -1.0 : 1.0;
  const double tip = std::pow(sign * (t.at_tip_side - t.base), 1.0 / t.power);
  const double hand = std::pow(sign * (t.at_hand_side - t.base), 1.0 / t.power);
  return t.base + sign * std::pow(tip + f * (hand - tip), t.power);
}

/// Compliance from the definition: that of the section, and within 1 mm of a border linearly on to that of the other.
double compliance_at(const Instrument& w, double arc,
                     const std::function<double(const Section&, double)>& rigidity) {
  std::size_t k = 0;
  double start = 0.0;
  while (k + 1 < w.sections.size() && arc >= start + w.sections[k].length_mm)
    start += w.sections[k++].length_mm;
  const auto of_section = [&](std::size_t section, double fraction) {
    return 1.0 / rigidity(w.sections[section], fraction);
  };
  const double length = w.sections[k].length_mm;
  const double behind = std::min(arc - start, length);
  double compliance = of_section(k, behind / length);
  if (k > 0 && behind < 1.0)
    compliance -= 0.5 * (1.0 - behind) * (of_section(k, 0.0) - of_section(k - 1, 1.0));
  if (k + 1 < w.sections.size() && length - behind < 1.0)
    compliance += 0.5 * (1.0 - (length - behind)) * (of_section(k + 1, 0.0) - of_section(k, 1.0));
  return compliance;
}

/// Midpoint rule between the borders of the sections.
double quadrature(double from, double to, const std::function<double(double)>& f) {
  constexpr int n = 100000;
  double sum = 0.0;
  double begin = from;
  for (const double border : {7.0, 17.0, 30.0, to}) {
    const double end = std::min(border, to);
    if (end <= begin) continue;
    for (int i = 0; i < n; ++i) sum += f(begin + (end - begin) * (i + 0.5) / n) * (end - begin) / n;
    begin = end;
  }
  return sum;
}

using Arcs = std::pair<double, double>;
class Stretch : public testing::TestWithParam<std::tuple<Arcs, bool>> {};

// Breaks when a border is missed, counted twice, or a taper is averaged instead of its compliance.
TEST_P(Stretch, IntegralsAgreeWithQuadrature) {
  const auto [from, to] = std::get<0>(GetParam());
  const Instrument w = std::get<1>(GetParam()) ? three_cores() : three_sections();
  const MaterialLine line(w);
  const auto over = [&, a = from, b = to](const std::function<double(const Section&, double)>& f) {
    return quadrature(a, b, [&](double arc) {
      const Place p = place_at(w, arc);
      return f(*p.section, p.fraction);
    });
  };
  const double length = to - from;
  const auto series_of = [&, a = from,
                          b = to](const std::function<double(const Section&, double)>& rigidity) {
    return length / quadrature(a, b, [&](double arc) { return compliance_at(w, arc, rigidity); });
  };
  const auto series = [&](Taper Section::*taper) {
    return series_of([&](const Section& s, double f) { return value(s.*taper, f); });
  };
  const double tolerance = 1e-8;
  EXPECT_NEAR(line.flexural_rigidity_n_mm2(from, to) / series(&Section::flexural_rigidity_n_mm2), 1.0,
              tolerance);
  const double soft = series_of(
      [&](const Section& s, double f) { return s.flexural_ratio * value(s.flexural_rigidity_n_mm2, f); });
  EXPECT_NEAR(line.flexural_rigidities_n_mm2(from, to)[0] / line.flexural_rigidity_n_mm2(from, to), 1.0,
              1e-15);
  EXPECT_NEAR(line.flexural_rigidities_n_mm2(from, to)[1] / soft, 1.0, tolerance);
  EXPECT_NEAR(line.torsional_rigidity_n_mm2(from, to) / series(&Section::torsional_rigidity_n_mm2), 1.0,
              tolerance);
  EXPECT_NEAR(line.axial_rigidity_n(from, to) / series(&Section::axial_rigidity_n), 1.0, tolerance);
  EXPECT_NEAR(line.mass_g(from, to),
              over([](const Section& s, double f) { return value(s.linear_density_g_per_mm, f); }),
              tolerance * length * 1e-3);
  EXPECT_NEAR(line.volume_mm3(from, to), over([](const Section& s, double f) {
                const double r = value(s.radius_mm, f);
                return std::numbers::pi * r * r;
              }),
              tolerance * length);
  const Eigen::Vector2d bend = line.rest_bend_rad(from, to);
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(bend[c], quadrature(from, to, [&](double arc) { return rest_at(w, arc)[c]; }),
                tolerance * length);
  }
}

// Within a section, to a border, over one, over all, beyond the end, wholly beyond the end.
INSTANTIATE_TEST_SUITE_P(All, Stretch,
                         testing::Combine(testing::Values(Arcs{1.0, 4.0}, Arcs{2.0, 7.0}, Arcs{7.0, 9.0},
                                                          Arcs{6.5, 7.5}, Arcs{0.0, 30.0}, Arcs{8.0, 16.0},
                                                          Arcs{28.0, 36.0}, Arcs{33.0, 40.0}, Arcs{6.2, 6.9},
                                                          Arcs{7.1, 17.3}),
                                          testing::Bool()));

// At a border the section behind it holds; behind the wire its last values. Breaks with ≤ in place of <.
TEST(MaterialLine, PointValuesAtBordersAndBeyond) {
  const MaterialLine line(three_sections());
  EXPECT_DOUBLE_EQ(line.length_mm(), 30.0);
  EXPECT_DOUBLE_EQ(line.radius_mm(0.0), 0.3);
  EXPECT_NEAR(line.radius_mm(12.0), 0.325, 1e-15);
  EXPECT_DOUBLE_EQ(line.radius_mm(17.0), 0.3);
  EXPECT_DOUBLE_EQ(line.radius_mm(35.0), 0.4);
  EXPECT_DOUBLE_EQ(line.friction(6.999), 0.0);
  EXPECT_DOUBLE_EQ(line.friction(7.0), 0.1);
  EXPECT_DOUBLE_EQ(line.friction(99.0), 0.2);
  EXPECT_LT((line.rest_curvature_per_mm(3.0) - Eigen::Vector2d(-0.02, 0.0)).norm(), 1e-15);
  EXPECT_LT((line.rest_curvature_per_mm(20.0) - 0.02 * Eigen::Vector2d(std::cos(1.4), std::sin(1.4))).norm(),
            1e-15);
}

// Breaks when a ramp moves the turn of the unloaded wire instead of spreading it.
TEST(MaterialLine, RampsKeepTheTurnOfTheUnloadedWire) {
  const Instrument w = three_sections();
  const MaterialLine line(w);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Section& s : w.sections) {
    sum += s.length_mm * s.rest_curvature_per_mm *
           Eigen::Vector2d(std::cos(s.rest_plane_rad), std::sin(s.rest_plane_rad));
  }
  EXPECT_LT((line.rest_bend_rad(0.0, 30.0) - sum).norm(), 1e-15);
}

// Breaks when the curvature jumps at a border or at the end of a ramp, or when its slope is not that of the curvature.
TEST(MaterialLine, RestCurvatureIsContinuousAndItsSlopeIsItsDerivative) {
  const MaterialLine line(three_cores());
  constexpr double kStep_mm = 1e-6;
  double met = 0.0;
  for (double arc = 0.0505; arc < 30.0; arc += 0.01) {
    const Eigen::Vector2d change =
        line.rest_curvature_per_mm(arc + kStep_mm) - line.rest_curvature_per_mm(arc);
    const Eigen::Vector2d slope = line.rest_curvature_slope_per_mm2(arc);
    EXPECT_LT((change - kStep_mm * slope).norm(), 1e-13) << arc;
    met = std::max(met, slope.norm());
  }
  EXPECT_GT(met, 0.02 / kRamp_mm - 1e-12);
  for (const double end : {6.0, 7.0, 8.0, 16.0, 17.0, 18.0}) {
    EXPECT_LT((line.rest_curvature_per_mm(end + 1e-9) - line.rest_curvature_per_mm(end - 1e-9)).norm(), 1e-9);
  }
}

// A ramp never passes the middle of a section, and behind the last curved one the wire is straight to the bit.
TEST(MaterialLine, RampsOfShortSectionsAreShorter) {
  Instrument w = three_sections();
  w.sections[0].length_mm = 0.6;
  w.sections[1].length_mm = 40.0;
  w.sections[2].rest_curvature_per_mm = 0.0;
  w.sections[1].rest_curvature_per_mm = 0.0;
  const MaterialLine line(w);
  EXPECT_NEAR(line.rest_curvature_per_mm(0.29).x(), -0.02, 1e-15);
  EXPECT_NEAR(line.rest_curvature_per_mm(0.6).x(), -0.01, 1e-15);
  EXPECT_NEAR(line.rest_bend_rad(0.0, 5.0).x(), -0.012, 1e-15);
  EXPECT_NE(line.rest_bend_rad(0.89, 5.0).x(), 0.0);
  EXPECT_EQ(line.rest_bend_rad(0.9, 70.0).norm(), 0.0);
  EXPECT_EQ(line.rest_curvature_per_mm(0.9).norm(), 0.0);
}

/// Sections shorter than a ramp between long ones, and two short ones side by side; everything jumps everywhere.
Instrument short_sections() {
  Instrument w = three_cores();
  w.sections[1].length_mm = 0.6;
  w.sections.push_back(w.sections[0]);
  w.sections[3].length_mm = 0.1;
  w.sections.push_back(w.sections[2]);
  w.sections[4].length_mm = 1.3;
  w.sections[4].flexural_rigidity_n_mm2 = {40.0, 90.0};
  w.sections.push_back(w.sections[1]);
  w.sections[5].length_mm = 20.0;
  return w;
}

// From the middle of a section to that of the next, turn and compliance are what the two halves say, however short they are. Breaks when a ramp
// reaches past a middle, or lies to one side of its border.
TEST(MaterialLine, RampsOfShortSectionsKeepTurnAndComplianceOfBothSections) {
  const Instrument w = short_sections();
  const MaterialLine line(w);
  double border = 0.0;
  for (std::size_t k = 0; k + 1 < w.sections.size(); ++k) {
    const Section& before = w.sections[k];
    const Section& behind = w.sections[k + 1];
    border += before.length_mm;
    const double from = border - 0.5 * before.length_mm;
    const double to = border + 0.5 * behind.length_mm;
    // Half a section, written again from the data.
    const auto over_half = [](const Section& s, bool hand_half, auto integrand) {
      constexpr int n = 20000;
      auto sum = integrand(s, 0.5);
      sum *= 0.0;
      for (int i = 0; i < n; ++i)
        sum += integrand(s, (hand_half ? 0.5 : 0.0) + 0.5 * (i + 0.5) / n) * (0.5 * s.length_mm / n);
      return sum;
    };
    const auto over_both = [&](auto integrand) {
      auto sum = over_half(before, true, integrand);
      sum += over_half(behind, false, integrand);
      return sum;
    };
    SCOPED_TRACE(k);
    constexpr double kTolerance = 1e-8;
    const auto compliance = [&](Taper Section::*taper) {
      return over_both([&](const Section& s, double f) { return 1.0 / value(s.*taper, f); });
    };
    EXPECT_NEAR(
        (to - from) / line.flexural_rigidity_n_mm2(from, to) / compliance(&Section::flexural_rigidity_n_mm2),
        1.0, kTolerance);
    EXPECT_NEAR((to - from) / line.torsional_rigidity_n_mm2(from, to) /
                    compliance(&Section::torsional_rigidity_n_mm2),
                1.0, kTolerance);
    EXPECT_NEAR((to - from) / line.axial_rigidity_n(from, to) / compliance(&Section::axial_rigidity_n), 1.0,
                kTolerance);
    const Eigen::Vector2d turn = over_both([](const Section& s, double f) {
      const double plane = s.rest_plane_rad + s.rest_torsion_per_mm * f * s.length_mm;
      return Eigen::Vector2d(s.rest_curvature_per_mm * Eigen::Vector2d(std::cos(plane), std::sin(plane)));
    });
    EXPECT_LT((line.rest_bend_rad(from, to) - turn).norm(), kTolerance * (to - from));
    // And what points say adds up to the same.
    constexpr int n = 40000;
    double bending = 0.0;
    Eigen::Vector2d bend = Eigen::Vector2d::Zero();
    for (int i = 0; i < n; ++i) {
      const double arc = from + (to - from) * (i + 0.5) / n;
      bending += (to - from) / n / line.flexural_rigidity_n_mm2(arc);
      bend += (to - from) / n * line.rest_curvature_per_mm(arc);
    }
    EXPECT_NEAR(bending * line.flexural_rigidity_n_mm2(from, to) / (to - from), 1.0, 1e-6);
    EXPECT_LT((bend - turn).norm(), 1e-6 * (to - from));
  }
}

/// A taper on a helix of one turn, whole and cut in seven; twist alone changes behind the cuts.
Instrument cut(bool in_parts) {
  Instrument w = three_cores();
  w.sections.resize(1);
  w.sections[0].length_mm = 70.0;
  w.sections[0].axial_rigidity_n = {300.0, 2400.0, 2, 100.0};
  lay_rest_shape({RestPiece{70.0, 0.05, 0.0, 2.0 * std::numbers::pi / 70.0}}, 0.0, "shape", w);
  if (!in_parts) return w;
  std::vector<RestPiece> pieces;
  for (int i = 0; i < 7; ++i)
    pieces.push_back(
        {10.0, 0.05, 2.0 * std::numbers::pi * (i / 7.0 + (i % 2)), 2.0 * std::numbers::pi / 70.0});
  lay_rest_shape(pieces, 0.0, "shape", w);
  return w;
}

// Where a section is cut and goes on as it was, there is no ramp: not a bit differs from what its taper says. Breaks when the rounding of two
// ends that were computed apart counts as a step.
TEST(MaterialLine, WhereNothingChangesThereIsNoRamp) {
  const MaterialLine whole(cut(false));
  const Instrument w = cut(true);
  ASSERT_EQ(w.sections.size(), 7U);
  const MaterialLine line(w);
  for (int i = 0; i < 7000; ++i) {
    const double arc = 0.005 + 0.01 * i;
    const auto k = static_cast<std::size_t>(arc / 10.0);
    const double fraction = (arc - 10.0 * static_cast<double>(k)) / 10.0;
    ASSERT_EQ(line.flexural_rigidity_n_mm2(arc), Profile(w.sections[k].flexural_rigidity_n_mm2).at(fraction))
        << arc;
    const Eigen::Vector2d own = line.rest_curvature_per_mm(arc);
    const Eigen::Vector2d turning = 2.0 * std::numbers::pi / 70.0 * Eigen::Vector2d(-own.y(), own.x());
    ASSERT_EQ(line.rest_curvature_slope_per_mm2(arc), turning) << arc;
    EXPECT_LT((own - whole.rest_curvature_per_mm(arc)).norm(), 1e-15);
    EXPECT_NEAR(line.flexural_rigidity_n_mm2(arc) / whole.flexural_rigidity_n_mm2(arc), 1.0, 1e-14);
    EXPECT_NEAR(line.axial_rigidity_n(arc - 0.5, arc + 0.5) / whole.axial_rigidity_n(arc - 0.5, arc + 0.5),
                1.0, 1e-9);
  }
}

// A step in twist leaves bending as it is, to the bit.
TEST(MaterialLine, ARampOfOneRigidityLeavesTheOthers) {
  Instrument w = test::uniform_wire(7.0, 6.0, 50.0);
  w.sections.push_back(w.sections[0]);
  w.sections[1].torsional_rigidity_n_mm2 = 60.0;
  const MaterialLine line(w);
  for (double arc = 48.5; arc < 51.5; arc += 0.01) EXPECT_EQ(line.flexural_rigidity_n_mm2(arc), 7.0) << arc;
  EXPECT_NEAR(1.0 / line.torsional_rigidity_n_mm2(50.0), 0.5 * (1.0 / 6.0 + 1.0 / 60.0), 1e-15);
}

// What a point says is what the integrals are of. Breaks when one of the two leaves out a ramp.
TEST(MaterialLine, RigidityAtAPointIsThatOfAShortStretch) {
  const MaterialLine line(three_cores());
  constexpr double kShort_mm = 1e-4;
  for (double arc = 0.013; arc < 29.9; arc += 0.37) {
    const Eigen::Vector2d stretch = line.flexural_rigidities_n_mm2(arc - kShort_mm, arc + kShort_mm);
    EXPECT_LT((line.flexural_rigidities_n_mm2(arc) - stretch).norm(), 1e-6 * stretch.norm()) << arc;
    EXPECT_NEAR(line.flexural_rigidity_n_mm2(arc) / stretch[0], 1.0, 1e-6) << arc;
    EXPECT_NEAR(
        line.torsional_rigidity_n_mm2(arc) / line.torsional_rigidity_n_mm2(arc - kShort_mm, arc + kShort_mm),
        1.0, 1e-6)
        << arc;
  }
}

// A section that stiffens a thousandfold within a millimetre of a stiff border: compliance stays above 0 all along.
TEST(MaterialLine, RampsNeverMakeAComplianceNegative) {
  Instrument w = three_sections();
  w.sections[0].length_mm = 2.0;
  w.sections[0].flexural_rigidity_n_mm2 = {1000.0, 1.0};
  w.sections[1].flexural_rigidity_n_mm2 = {1000.0, 1.0};
  w.sections[1].length_mm = 2.0;
  const MaterialLine line(w);
  for (double arc = 0.0; arc < 10.0; arc += 0.01) {
    EXPECT_GT(line.flexural_rigidity_n_mm2(arc), 0.0) << arc;
    EXPECT_GT(line.flexural_rigidity_n_mm2(arc, arc + 0.01), 0.0) << arc;
  }
}

// Breaks when only one end of the stretch is looked at.
TEST(MaterialLine, TheSmallestKinkCurvatureOfAStretchCounts) {
  const MaterialLine line(three_sections());
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 6.0), 0.9);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 8.0), 0.7);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 29.0), 0.5);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(31.0, 35.0), 0.5);
  const MaterialLine cores(three_cores());  // 1/κ_m grows from 1/0.9 to 1/0.3
  EXPECT_NEAR(cores.kink_per_mm(9.0, 12.0), 1.0 / (0.5 / 0.9 + 0.5 / 0.3), 1e-14);
}

// Rigidities of two halves are springs in series: exact, whatever the taper.
TEST(MaterialLine, HalvesAreSpringsInSeries) {
  const MaterialLine line(three_cores());
  for (double from = 0.0; from < 30.0; from += 0.9) {
    const double whole = 2.0 / line.flexural_rigidity_n_mm2(from, from + 2.0);
    const double halves = 1.0 / line.flexural_rigidity_n_mm2(from, from + 1.0) +
                          1.0 / line.flexural_rigidity_n_mm2(from + 1.0, from + 2.0);
    EXPECT_NEAR(whole / halves, 1.0, 1e-8) << from;
  }
}

TEST(MaterialLine, RefusesWhatValidateRefuses) {
  Instrument w = three_sections();
  w.sections[1].friction = -1.0;
  EXPECT_THROW(MaterialLine{w}, base::InputError);
}

}  // namespace
}  // namespace endowire::rod

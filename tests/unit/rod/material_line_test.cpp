#include "endowire/rod/material_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "endowire/base/error.hpp"
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

double value(const Taper& t, double f) {
  return t.at_tip_side + f * (t.at_hand_side - t.at_tip_side);
}

/// Midpoint rule fine enough that section borders do not show.
double quadrature(double from, double to, const std::function<double(double)>& f) {
  constexpr int n = 400000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f(from + (to - from) * (i + 0.5) / n);
  return sum * (to - from) / n;
}

class Stretch : public testing::TestWithParam<std::pair<double, double>> {};

// Breaks when a border is missed, counted twice, or a taper is averaged instead of its compliance.
TEST_P(Stretch, IntegralsAgreeWithQuadrature) {
  const auto [from, to] = GetParam();
  const Instrument w = three_sections();
  const MaterialLine line(w);
  const auto over = [&, a = from, b = to](const std::function<double(const Section&, double)>& f) {
    return quadrature(a, b, [&](double arc) {
      const Place p = place_at(w, arc);
      return f(*p.section, p.fraction);
    });
  };
  const double length = to - from;
  const auto series = [&](Taper Section::*taper) {
    return length / over([&](const Section& s, double f) { return 1.0 / value(s.*taper, f); });
  };
  const double tolerance = 2e-6;
  EXPECT_NEAR(line.flexural_rigidity_n_mm2(from, to) / series(&Section::flexural_rigidity_n_mm2), 1.0,
              tolerance);
  EXPECT_NEAR(line.torsional_rigidity_n_mm2(from, to) / series(&Section::torsional_rigidity_n_mm2), 1.0,
              tolerance);
  EXPECT_NEAR(line.axial_rigidity_n(from, to) / series(&Section::axial_rigidity_n), 1.0, tolerance);
  EXPECT_NEAR(line.mass_g(from, to), over([](const Section& s, double) { return s.linear_density_g_per_mm; }),
              tolerance * length * 1e-3);
  EXPECT_NEAR(line.volume_mm3(from, to), over([](const Section& s, double f) {
                const double r = value(s.radius_mm, f);
                return std::numbers::pi * r * r;
              }),
              tolerance * length);
  const Eigen::Vector2d bend = line.rest_bend_rad(from, to);
  EXPECT_NEAR(bend.x(), over([](const Section& s, double) {
                return s.rest_curvature_per_mm * std::cos(s.rest_plane_rad);
              }),
              tolerance * length);
  EXPECT_NEAR(bend.y(), over([](const Section& s, double) {
                return s.rest_curvature_per_mm * std::sin(s.rest_plane_rad);
              }),
              tolerance * length);
}

// Within a section, to a border, over one, over all, beyond the end, wholly beyond the end.
INSTANTIATE_TEST_SUITE_P(All, Stretch,
                         testing::Values(std::pair{1.0, 4.0}, std::pair{2.0, 7.0}, std::pair{7.0, 9.0},
                                         std::pair{6.5, 7.5}, std::pair{0.0, 30.0}, std::pair{8.0, 16.0},
                                         std::pair{28.0, 36.0}, std::pair{33.0, 40.0}));

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

// Breaks when only one end of the stretch is looked at.
TEST(MaterialLine, TheSmallestKinkCurvatureOfAStretchCounts) {
  const MaterialLine line(three_sections());
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 6.0), 0.9);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 8.0), 0.7);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(1.0, 29.0), 0.5);
  EXPECT_DOUBLE_EQ(line.kink_per_mm(31.0, 35.0), 0.5);
}

// Rigidities of two halves are springs in series: exact, whatever the taper.
TEST(MaterialLine, HalvesAreSpringsInSeries) {
  const MaterialLine line(three_sections());
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

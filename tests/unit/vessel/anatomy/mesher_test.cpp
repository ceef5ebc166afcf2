// From a shape to an even mesh: contour, cut, remesh.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/vessel/anatomy/cell_pattern.hpp"
#include "endowire/vessel/anatomy/contour.hpp"
#include "endowire/vessel/anatomy/cut.hpp"
#include "endowire/vessel/anatomy/plan.hpp"
#include "endowire/vessel/anatomy/portable.hpp"
#include "endowire/vessel/anatomy/remesh.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"
#include "endowire/vessel/random.hpp"
#include "support/mesh_facts.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

Tube tube(const Vector3d& from, const Vector3d& to, double radius_mm, const Fillet& fillet = {}) {
  Axis axis =
      Axis::spline({from, unit(to - from), Vector3d::Zero()}, {}, {to, unit(to - from), Vector3d::Zero()});
  axis.set_radius(RadiusProfile({{0.0, radius_mm}}));
  return {axis, fillet, 0.0, 0.0};
}

LumenShape branching() {
  return {{tube({0, 0, 0}, {1, 2, 60}, 8.0), tube({0.4, 0.8, 25}, {40, 5, 50}, 3.0, Fillet(1.0, 0.55))}, 6.0};
}

TEST(Contour, IsClosedManifoldAndOutward) {
  const LumenShape shape = branching();
  for (const double spacing : {2.4, 1.7, 1.0}) {
    const TriangleMesh mesh = contour(shape, spacing);
    const test::MeshFacts facts = test::facts_of(mesh);
    EXPECT_EQ(facts.bad_edges, 0U) << spacing;
    EXPECT_EQ(facts.pinched, 0U);
    EXPECT_EQ(facts.borders, 0U);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_GT(signed_volume_mm3(mesh), 0.0);
  }
}

TEST(CellPattern, ASheetPassesAFaceTwiceOnlyWhereJoiningItAcrossMakesTwoSheets) {
  int pinchable = 0;
  for (int inside = 0; inside < 256; ++inside) {
    const CellPattern usual = cell_pattern(inside, 0);
    for (int face = 0; face < 6; ++face) {
      if (!usual.pinchable[static_cast<std::size_t>(face)]) continue;
      ++pinchable;
      const CellPattern joined = cell_pattern(inside, 1 << face);
      EXPECT_EQ(joined.sheets, 2) << inside << " " << face;
      for (const bool still : joined.pinchable) EXPECT_FALSE(still) << inside << " " << face;
    }
  }
  EXPECT_EQ(pinchable, 36);
}

/// Tubes at random cross each other, pass by closely and end anywhere: sheets of the surface meet in every way that
/// a grid can see them.
TEST(Contour, IsManifoldWhateverTheShape) {
  SplitMix random(8);
  for (int i = 0; i < 30; ++i) {
    std::vector<Tube> tubes;
    for (int k = 0; k < 5; ++k) {
      const auto point = [&] {
        return Vector3d(random.uniform(0, 30), random.uniform(0, 30), random.uniform(0, 30));
      };
      tubes.push_back(
          tube(point(), point(), random.uniform(2.0, 5.0), Fillet(random.uniform(0.3, 1.5), 0.5)));
    }
    const TriangleMesh mesh = contour(LumenShape(tubes, 6.0), 1.6);
    const test::MeshFacts facts = test::facts_of(mesh);
    EXPECT_EQ(facts.bad_edges, 0U) << i;
    EXPECT_EQ(facts.pinched, 0U) << i;
    EXPECT_EQ(facts.borders, 0U) << i;
  }
}

double largest_sagitta_over_allowed(const TriangleMesh& mesh, const LumenShape& shape,
                                    const EdgeSizes& sizes) {
  double worst = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    for (const Vector3d& p : {middle, Vector3d(0.5 * (mesh.corner(t, 0) + mesh.corner(t, 1))),
                              Vector3d(0.5 * (mesh.corner(t, 1) + mesh.corner(t, 2)))}) {
      const WallSample sample = shape.at(p);
      const double r = sample.curvature_radius_mm;
      const double allowed =
          std::max(sizes.least_over_radius * r, std::min(sizes.sagitta_mm, sizes.most_over_radius * r));
      worst = std::max(worst, std::abs(sample.distance_mm) / allowed);
    }
  }
  return worst;
}

TEST(Remesh, MakesEvenTrianglesOnTheSurface) {
  const LumenShape shape = branching();
  const EdgeSizes sizes;
  const TriangleMesh mesh = remesh(contour(shape, 1.7), shape, {}, sizes);
  const test::MeshFacts facts = test::facts_of(mesh);
  EXPECT_EQ(facts.bad_edges + facts.pinched + facts.borders, 0U);
  EXPECT_EQ(facts.euler, 2);
  EXPECT_GT(facts.least_angle_deg, 20.0);
  EXPECT_GT(facts.first_percent_angle_deg, 35.0);
  for (const Vector3d& v : mesh.vertices_mm) EXPECT_LT(std::abs(shape.at(v).distance_mm), 1e-6);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    EXPECT_GT(mesh.area_normal(t).normalized().dot(shape.at(middle).gradient), 0.7);
  }
  EXPECT_LT(largest_sagitta_over_allowed(mesh, shape, sizes), 16.0 / 9.0 + 0.25);
}

TEST(Remesh, ATubeHasTheVolumeOfItsCylinder) {
  const LumenShape shape({tube({0, 0, 0}, {0, 0, 80}, 4.0)}, 6.0);
  const TriangleMesh mesh = remesh(contour(shape, 1.5), shape, {}, {});
  const double exact = std::numbers::pi * 16.0 * 80.0 + 4.0 / 3.0 * std::numbers::pi * 64.0;
  EXPECT_NEAR(signed_volume_mm3(mesh) / exact, 1.0, 0.02);
  EXPECT_LT(signed_volume_mm3(mesh), exact);  // vertices lie on it, so that facets lie inside
}

TEST(Remesh, FinerSizesGiveMoreTrianglesAndLessError) {
  const LumenShape shape = branching();
  EdgeSizes fine;
  fine.sagitta_mm = 0.02;
  fine.least_over_radius = 0.004;
  const TriangleMesh usual = remesh(contour(shape, 1.7), shape, {}, {});
  const TriangleMesh finer = remesh(contour(shape, 1.7), shape, {}, fine);
  EXPECT_GT(finer.triangles.size(), 2 * usual.triangles.size());
  const auto mean_error_mm = [&](const TriangleMesh& mesh) {
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      sum +=
          std::abs(shape.at((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0).distance_mm);
    return sum / static_cast<double>(mesh.triangles.size());
  };
  EXPECT_LT(mean_error_mm(finer), 0.6 * mean_error_mm(usual));
  EXPECT_GT(test::facts_of(finer).least_angle_deg, 20.0);
}

TEST(Cut, OpensAVesselAlongACircle) {
  Tube open = tube({0, 0, 0}, {0, 0, 40}, 4.0);
  open.before_mm = open.beyond_mm = 3.0;
  const LumenShape shape({open}, 6.0);
  const std::vector<Rim> rims{{{0, 0, 0}, {0, 0, -1}, 4.0}, {{0, 0, 40}, {0, 0, 1}, 4.0}};
  const TriangleMesh cut = cut_at(contour(shape, 1.7), rims, 3.0);
  EXPECT_EQ(test::facts_of(cut).borders, 2U);
  const TriangleMesh mesh = remesh(cut, shape, rims, {});
  const test::MeshFacts facts = test::facts_of(mesh);
  EXPECT_EQ(facts.bad_edges + facts.pinched, 0U);
  EXPECT_EQ(facts.borders, 2U);
  EXPECT_EQ(facts.euler, 0);
  EXPECT_GT(facts.least_angle_deg, 20.0);
  double low = 1e9;
  double high = -1e9;
  int on_rim = 0;
  for (const Vector3d& v : mesh.vertices_mm) {
    low = std::min(low, v.z());
    high = std::max(high, v.z());
    EXPECT_NEAR(std::hypot(v.x(), v.y()), 4.0, 1e-6);
    on_rim += std::abs(v.z()) < 1e-9 || std::abs(v.z() - 40.0) < 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(low, 0.0, 1e-9);
  EXPECT_NEAR(high, 40.0, 1e-9);
  EXPECT_GT(on_rim, 30);
}

/// A loop whose limbs pass each other at `apart_mm` from axis to axis.
Plan loop(double apart_mm) {
  Plan plan;
  std::vector<Vector3d> through{{0, 0, 0}};
  for (const double share : {0.25, 0.5, 0.75, 1.0})
    through.emplace_back(15.0 * sine(2.0 * std::numbers::pi * share),
                         15.0 - 15.0 * cosine(2.0 * std::numbers::pi * share), apart_mm * share);
  add_trunk(plan, "loop", {{-30, 0, 0}, Vector3d::UnitX(), Vector3d::Zero()}, through,
            {{30, 0, apart_mm}, Vector3d::UnitX(), Vector3d::Zero()});
  set_calibre(plan, 0, {{0.0, 3.0}});
  return plan;
}

TEST(Plan, AVesselThatTouchesItselfHasNoMesh) {
  EXPECT_FALSE(mesh_of(loop(4.0), false).has_value());
  EXPECT_FALSE(mesh_of(loop(4.0), true).has_value());
  const std::optional<TriangleMesh> apart = mesh_of(loop(9.0), false);
  ASSERT_TRUE(apart.has_value());
  EXPECT_EQ(test::facts_of(*apart).euler, 2);
}

}  // namespace
}  // namespace endowire::vessel::anatomy

// Centrelines of generated vessels whose axes are known.
#include "endowire/vessel/centreline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "endowire/vessel/random.hpp"
#include "support/centreline_checks.hpp"
#include "support/swept_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using test::count_ends;
using test::expect_tree_in_lumen;

CentrelineTree tree_of(const TriangleMesh& mesh, const CentrelineParameters& parameters = {}) {
  const RepairedMesh repaired = repair(mesh, "mesh");
  CentrelineTree tree = extract_centrelines(repaired, parameters);
  expect_tree_in_lumen(tree, repaired);
  return tree;
}

std::vector<Vector3d> straight_curve(double length_mm, int pieces) {
  std::vector<Vector3d> curve;
  for (int i = 0; i <= pieces; ++i) curve.emplace_back(0.0, 0.0, length_mm * i / pieces);
  return curve;
}

/// Largest distance of a tree's points from an axis, in their radii, over points more than one radius from a cap.
template <typename Distance>
double worst_offset(const CentrelineTree& tree, Distance distance) {
  double worst = 0.0;
  for (const CentrelinePoint& p : tree.points())
    worst = std::max(worst, distance(p.position_mm) / p.radius_mm);
  return worst;
}

TEST(Centreline, OpenTubeIsItsAxis) {
  const double radius = 3.0;
  const int around = 24;
  const CentrelineTree tree = tree_of(test::open_tube(radius, 60.0, around, 30));
  ASSERT_EQ(tree.branches().size(), 1U);
  const CentrelineBranch& branch = tree.branches()[0];
  EXPECT_EQ(branch.name, "1");
  EXPECT_NEAR(branch.length_mm, 60.0, 1e-4);
  EXPECT_NEAR(branch.tortuosity, 1.0, 1e-6);
  EXPECT_LT(worst_offset(tree, [](const Vector3d& p) { return std::hypot(p.x(), p.y()); }), 1e-3);
  const double inscribed = radius * std::cos(std::numbers::pi / around);  // of the prism
  EXPECT_NEAR(branch.min_radius_mm, inscribed, 2e-3);
  EXPECT_NEAR(branch.mean_radius_mm, inscribed, 2e-3);
  ASSERT_EQ(tree.ends().size(), 2U);
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::opening), 2);
  EXPECT_TRUE(tree.ends()[0].root);
  EXPECT_NE(tree.ends()[0].opening, tree.ends()[1].opening);
  for (const CentrelinePoint& p : tree.points()) EXPECT_LT(p.curvature_per_mm.norm(), 1e-3);
}

TEST(Centreline, ClosedTubeReachesItsCaps) {
  const CentrelineTree tree = tree_of(test::closed_tube(3.0, 60.0, 24, 30));
  ASSERT_EQ(tree.branches().size(), 1U);
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::cap), 2);
  EXPECT_GT(tree.branches()[0].length_mm, 59.0);
  EXPECT_LT(tree.branches()[0].length_mm, 60.0);
  // The radius falls towards the caps; the measures of the branch do not count that.
  EXPECT_NEAR(tree.branches()[0].cap_mm, 3.0, 0.6);
  EXPECT_GT(tree.branches()[0].min_radius_mm, 2.8);
  EXPECT_LT(tree.points().front().radius_mm, 1.0);
  EXPECT_LT(worst_offset(tree,
                         [](const Vector3d& p) {
                           return p.z() < 3.0 || p.z() > 57.0 ? 0.0 : std::hypot(p.x(), p.y());
                         }),
            2e-3);
}

TEST(Centreline, ConeIsItsAxis) {
  const std::vector<Vector3d> curve = straight_curve(80.0, 40);
  std::vector<double> radius;
  for (const Vector3d& p : curve) radius.push_back(1.0 + 5.0 * p.z() / 80.0);
  const CentrelineTree tree = tree_of(test::swept_tube(curve, radius, 24, false));
  ASSERT_EQ(tree.branches().size(), 1U);
  EXPECT_LT(worst_offset(tree, [](const Vector3d& p) { return std::hypot(p.x(), p.y()); }), 5e-3);
  EXPECT_NEAR(tree.branches()[0].length_mm, 80.0, 0.01);
  // The widest end is the root.
  EXPECT_NEAR(tree.points().front().position_mm.z(), 80.0, 1e-4);
  EXPECT_NEAR(tree.branches()[0].max_radius_mm, 6.0, 0.1);
  EXPECT_NEAR(tree.branches()[0].min_radius_mm, 1.0, 0.05);
}

TEST(Centreline, TorusSegmentIsItsCircle) {
  const double bend = 20.0;
  const double radius = 4.0;
  std::vector<Vector3d> curve;
  for (int i = 0; i <= 90; ++i) {
    const double a = std::numbers::pi * i / 90.0;
    curve.emplace_back(bend * std::cos(a), bend * std::sin(a), 0.0);
  }
  const CentrelineTree tree =
      tree_of(test::swept_tube(curve, std::vector<double>(curve.size(), radius), 32, false));
  ASSERT_EQ(tree.branches().size(), 1U);
  EXPECT_LT(worst_offset(
                tree, [&](const Vector3d& p) { return std::hypot(std::hypot(p.x(), p.y()) - bend, p.z()); }),
            0.01);
  EXPECT_NEAR(tree.branches()[0].length_mm, bend * std::numbers::pi, 0.1);
  EXPECT_NEAR(tree.branches()[0].tortuosity, 0.5 * std::numbers::pi, 0.01);
  for (const CentrelinePoint& p : tree.points()) {
    if (p.arc_mm < 4.0 || p.arc_mm > tree.branches()[0].length_mm - 4.0) continue;
    EXPECT_NEAR(p.curvature_per_mm.norm(), 1.0 / bend, 0.05 / bend);
    EXPECT_LT(p.curvature_per_mm.dot(p.position_mm), 0.0);  // towards the centre, which is the origin
  }
}

TEST(Centreline, BentTubeIsFollowedWithoutCuttingCorners) {
  const double bend = 8.0;
  const double radius = 3.0;
  const double angle = 0.75 * std::numbers::pi;
  const std::vector<Vector3d> curve = test::bent_curve(30.0, bend, angle, 0.8);
  const CentrelineTree tree =
      tree_of(test::swept_tube(curve, std::vector<double>(curve.size(), radius), 24, false));
  ASSERT_EQ(tree.branches().size(), 1U);
  const auto off_axis = [&](const Vector3d& p) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
      least = std::min(least, test::capsule(p, curve[i], curve[i + 1], 0.0));
    return least;
  };
  EXPECT_LT(worst_offset(tree, off_axis), 0.03);
  EXPECT_NEAR(tree.branches()[0].length_mm, 60.0 + bend * angle, 0.3);
  double sharpest = 0.0;
  for (const CentrelinePoint& p : tree.points()) sharpest = std::max(sharpest, p.curvature_per_mm.norm());
  EXPECT_NEAR(sharpest, 1.0 / bend, 0.15 / bend);
}

/// Three round legs of one radius that meet at the origin.
double y_shape(const Vector3d& p, double radius_mm) {
  return std::min({test::capsule(p, {0, 0, -40}, {0, 0, 0}, radius_mm),
                   test::capsule(p, {0, 0, 0}, {20, 0, 30}, radius_mm),
                   test::capsule(p, {0, 0, 0}, {-20, 0, 30}, 0.8 * radius_mm)});
}

TriangleMesh y_mesh() {
  return test::surface_of([](const Vector3d& p) { return y_shape(p, 4.0); },
                          Eigen::AlignedBox3d(Vector3d(-27.3, -6.1, -46.2), Vector3d(27.1, 6.3, 37.4)), 0.7);
}

TEST(Centreline, YHasThreeLegsOnTheirAxes) {
  CentrelineParameters parameters;
  parameters.root_near_mm = Vector3d(0, 0, -40);
  const CentrelineTree tree = tree_of(y_mesh(), parameters);
  ASSERT_EQ(tree.branches().size(), 3U);
  ASSERT_EQ(tree.bifurcations().size(), 1U);
  EXPECT_EQ(tree.ends().size(), 3U);
  const CentrelineBifurcation& fork = tree.bifurcations()[0];
  EXPECT_LT(fork.position_mm.norm(), 1.5 * 4.0);
  EXPECT_EQ(fork.parent, 0);
  EXPECT_EQ(fork.children, tree.branches()[0].children);
  // The wider leg goes on as the same vessel.
  EXPECT_EQ(tree.branches()[0].name, "1:1");
  EXPECT_EQ(tree.branches()[1].name, "1:2");
  EXPECT_EQ(tree.branches()[2].name, "1.1");
  EXPECT_EQ(tree.branch_named("1.1"), 2);
  EXPECT_GT(tree.branches()[1].mean_radius_mm, 3.7);
  EXPECT_NEAR(tree.branches()[2].mean_radius_mm, 3.2, 0.2);
  const std::array<Vector3d, 3> tips{Vector3d(0, 0, -40), Vector3d(20, 0, 30), Vector3d(-20, 0, 30)};
  for (std::int32_t b = 0; b < 3; ++b) {
    int tested = 0;
    for (const CentrelinePoint& p : tree.points_of(b)) {
      if (p.position_mm.norm() < 10.0) continue;  // near the fork the ridge is not the axes
      ++tested;
      EXPECT_LT(test::capsule(p.position_mm, Vector3d::Zero(), 1.2 * tips[static_cast<std::size_t>(b)], 0.0),
                0.03 * 4.0);
    }
    EXPECT_GT(tested, 10);
  }
  // Where the side leg leaves: half of it inside, half outside of the other's lumen.
  const Vector3d ostium = tree.state_at({2, tree.branches()[2].ostium_arc_mm}).position_mm;
  EXPECT_NEAR(ostium.norm(), 4.5, 2.0);
  EXPECT_EQ(tree.branches()[1].ostium_arc_mm, 0.0);
}

TEST(Centreline, TheRootIsTheEndAskedFor) {
  CentrelineParameters parameters;
  parameters.root_near_mm = Vector3d(-20, 0, 30);
  const CentrelineTree tree = tree_of(y_mesh(), parameters);
  ASSERT_FALSE(tree.ends().empty());
  EXPECT_TRUE(tree.ends()[0].root);
  EXPECT_LT((tree.ends()[0].position_mm - *parameters.root_near_mm).norm(), 4.0);
  EXPECT_EQ(std::count_if(tree.ends().begin(), tree.ends().end(), [](const auto& end) { return end.root; }),
            1);
}

TEST(Centreline, DoesNotDependOnTheOrderOfTriangles) {
  const TriangleMesh mesh = y_mesh();
  TriangleMesh inward = mesh;
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  const auto bytes = [](const TriangleMesh& m) { return extract_centrelines(repair(m, "m")).serialise(1); };
  const std::vector<std::byte> expected = bytes(mesh);
  EXPECT_EQ(bytes(test::shuffled(mesh, 5)), expected);
  EXPECT_EQ(bytes(inward), expected);
}

TEST(Centreline, OvalAndSlitLikeVesselsGrowNoTwigs) {
  for (double flat : {2.0, 3.5}) {
    TriangleMesh mesh = test::closed_tube(3.0, 60.0, 32, 30);
    for (Vector3d& v : mesh.vertices_mm) v.x() *= flat;
    const CentrelineTree tree = tree_of(mesh);
    EXPECT_EQ(tree.branches().size(), 1U) << flat;
    EXPECT_LT(
        worst_offset(tree,
                     [](const Vector3d& p) { return std::abs(p.z() - 30.0) > 20.0 ? 0.0 : std::abs(p.x()); }),
        0.1)
        << flat;
  }
}

TEST(Centreline, ASacIsOneBranch) {
  const auto shape = [](const Vector3d& p) {
    return std::min(test::capsule(p, {0, 0, 0}, {0, 0, 60}, 2.0),
                    test::capsule(p, {7.0, 0, 30}, {7.0, 0, 30}, 5.5));
  };
  const CentrelineTree tree = tree_of(test::surface_of(
      shape, Eigen::AlignedBox3d(Vector3d(-6.1, -6.2, -3.3), Vector3d(13.2, 6.1, 63.4)), 0.5));
  EXPECT_EQ(tree.branches().size(), 3U);
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::cap), 3);
  const auto widest =
      std::max_element(tree.points().begin(), tree.points().end(),
                       [](const auto& a, const auto& b) { return a.radius_mm < b.radius_mm; });
  EXPECT_GT(widest->radius_mm, 4.9);  // points stand a third of the radius apart
  EXPECT_LT((widest->position_mm - Vector3d(7.0, 0, 30)).norm(), 1.0);
  // The vessel goes on past the sac, which is the side branch though it is wider.
  EXPECT_EQ(tree.branches()[1].name, "1:2");
  EXPECT_NEAR(tree.branches()[1].max_radius_mm, 2.0, 0.1);
}

TEST(Centreline, AFineVesselOnAWideOneIsFound) {
  const auto shape = [](const Vector3d& p) {
    return std::min(test::capsule(p, {0, 0, 0}, {0, 0, 30}, 8.0),
                    test::capsule(p, {0, 0, 15}, {22, 0, 15}, 0.8));
  };
  // The fine vessel's own grid: the wide one alone would be meshed coarser.
  const CentrelineTree tree = tree_of(test::surface_of(
      shape, Eigen::AlignedBox3d(Vector3d(-8.6, -8.7, -8.9), Vector3d(23.2, 8.8, 38.6)), 0.4));
  ASSERT_EQ(tree.branches().size(), 3U);
  const CentrelineBranch& fine = tree.branches()[2];
  EXPECT_EQ(fine.name, "1.1");
  EXPECT_NEAR(fine.mean_radius_mm, 0.8, 0.15);
  EXPECT_NEAR(tree.state_at({2, fine.ostium_arc_mm}).position_mm.x(), 8.0, 1.0);
  EXPECT_GT(tree.state_at({2, fine.length_mm}).position_mm.x(), 22.0);
}

TEST(Centreline, WallsThatNearlyTouchAreNotPassed) {
  // A hairpin whose limbs leave 0.3 mm of tissue between their walls.
  const std::vector<Vector3d> curve = test::bent_curve(40.0, 3.15, std::numbers::pi, 0.5);
  const CentrelineTree tree =
      tree_of(test::swept_tube(curve, std::vector<double>(curve.size(), 3.0), 32, false));
  ASSERT_EQ(tree.branches().size(), 1U);
  EXPECT_NEAR(tree.branches()[0].length_mm, 80.0 + 3.15 * std::numbers::pi, 1.0);
}

TEST(Centreline, SeparateVesselsAreSeparateTrees) {
  TriangleMesh mesh = test::closed_tube(3.0, 40.0, 24, 20);
  const TriangleMesh copy = mesh;
  const auto shift = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (const Vector3d& v : copy.vertices_mm) mesh.vertices_mm.push_back(0.8 * v + Vector3d(6.0, 0.0, 0.0));
  for (const auto& t : copy.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  const CentrelineTree tree = tree_of(mesh);
  ASSERT_EQ(tree.branches().size(), 2U);
  EXPECT_EQ(tree.branches()[0].name, "1");
  EXPECT_EQ(tree.branches()[1].name, "2");
  EXPECT_TRUE(std::isinf(tree.distance_mm({0, 1.0}, {1, 1.0})));
  EXPECT_TRUE(tree.route({0, 1.0}, {1, 1.0}).empty());
}

TEST(Centreline, ALoopIsCutOnceAndSaysWhere) {
  const auto shape = [](const Vector3d& p) {
    const double ring = std::hypot(std::hypot(p.x(), p.z()) - 15.0, p.y()) - 2.5;
    return std::min({ring, test::capsule(p, {0, 0, -40}, {0, 0, -15}, 2.5),
                     test::capsule(p, {0, 0, 15}, {0, 0, 40}, 2.5)});
  };
  const TriangleMesh mesh = test::surface_of(
      shape, Eigen::AlignedBox3d(Vector3d(-18.3, -3.2, -43.4), Vector3d(18.2, 3.3, 43.1)), 0.6);
  ASSERT_EQ(test::euler_characteristic(repair(mesh, "ring").mesh), 0);  // one loop
  const CentrelineTree tree = tree_of(mesh);
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::cap), 2);
  ASSERT_GE(count_ends(tree, CentrelineEndKind::cut), 1);
  double length = 0.0;
  for (const CentrelineBranch& b : tree.branches()) length += b.length_mm;
  EXPECT_NEAR(length, 2.0 * 27.5 + 2.0 * std::numbers::pi * 15.0, 8.0);  // both halves of the ring are there
  for (const CentrelineEnd& end : tree.ends()) {
    if (end.kind != CentrelineEndKind::cut) continue;
    ASSERT_GE(end.rejoins, 0);
    EXPECT_LT((tree.state_at({end.rejoins, end.rejoins_arc_mm}).position_mm - end.position_mm).norm(), 2.5);
  }
}

TEST(Centreline, ATreeOfManyBranchesIsWhole) {
  // A stem with three rows of side branches of falling calibre.
  constexpr int rows = 3;
  constexpr int per_row = 22;
  const auto shape = [](const Vector3d& p) {
    double least = test::capsule(p, {0, 0, -15}, {0, 0, 190}, 5.0);
    for (int i = 0; i < per_row; ++i) {
      const double z = 5.0 + 8.0 * i;
      if (std::abs(p.z() - z) > 12.0) continue;
      for (int row = 0; row < rows; ++row) {
        const double a = 2.0 * std::numbers::pi * (row + 0.37 * i) / rows;
        const Vector3d out(std::cos(a), std::sin(a), 0.4);
        least = std::min(least, test::capsule(p, {0, 0, z}, Vector3d(0, 0, z) + 16.0 * out, 1.6 - 0.03 * i));
      }
    }
    return least;
  };
  const CentrelineTree tree = tree_of(test::surface_of(
      shape, Eigen::AlignedBox3d(Vector3d(-19.1, -19.2, -21.3), Vector3d(19.3, 19.1, 196.2)), 0.8));
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::cap), 2 + rows * per_row);
  EXPECT_EQ(count_ends(tree, CentrelineEndKind::cut), 0);
}

// As an atrium with its veins: whichever way round, a vessel leads through the chamber to each of the others.
TEST(Centreline, VesselsThatMeetInAChamberAreAllFound) {
  constexpr double chamber_mm = 22.0;
  constexpr double reach_mm = 60.0;
  const std::vector<std::pair<Vector3d, double>> vessels = {
      {{0.0, 0.0, -1.0}, 9.0}, {{0.1, 0.2, 1.0}, 7.0},   {{1.0, 0.1, 0.3}, 5.0},
      {{-0.9, 0.5, 0.2}, 4.0}, {{-0.8, -0.7, 0.1}, 3.0}, {{0.2, -1.0, -0.2}, 5.5}};
  const auto shape = [&](const Vector3d& p) {
    double least = p.norm() - chamber_mm;
    for (const auto& [direction, radius_mm] : vessels)
      least =
          std::min(least, test::capsule(p, Vector3d::Zero(), reach_mm * direction.normalized(), radius_mm));
    return least;
  };
  const TriangleMesh mesh =
      test::surface_of(shape, Eigen::AlignedBox3d(Vector3d::Constant(-72.3), Vector3d::Constant(72.1)), 1.6);
  for (const auto& root : {vessels.front(), vessels.back()}) {
    CentrelineParameters from;
    from.root_near_mm = reach_mm * root.first.normalized();
    const CentrelineTree tree = tree_of(mesh, from);
    EXPECT_EQ(count_ends(tree, CentrelineEndKind::cap), static_cast<int>(vessels.size()));
    EXPECT_EQ(count_ends(tree, CentrelineEndKind::cut), 0);
    const NearestCentreline begin = tree.nearest(*from.root_near_mm);
    for (const auto& [direction, radius_mm] : vessels) {
      const Vector3d outlet = 45.0 * direction.normalized();
      const NearestCentreline place = tree.nearest(outlet);
      EXPECT_LT((tree.state_at(place.place).position_mm - outlet).norm(), 0.2 * radius_mm);
      EXPECT_NEAR(tree.state_at(place.place).radius_mm, radius_mm, 0.1 * radius_mm);
      const double way_mm = tree.distance_mm(begin.place, place.place);
      if (direction == root.first) continue;
      EXPECT_GT(way_mm, (outlet - *from.root_near_mm).norm() - 2.0);
      EXPECT_LT(way_mm, 45.0 + reach_mm + 20.0);
    }
  }
}

TEST(Centreline, AChamberWithoutEndsHasNoBranches) {
  const CentrelineTree tree = tree_of(test::sphere(8.0, 3));
  EXPECT_TRUE(tree.branches().empty());
  EXPECT_EQ(tree.nearest(Vector3d::Zero()).place.branch, -1);
}

TEST(Centreline, TheKeyFollowsMeshAndParameters) {
  const RepairedMesh mesh = repair(test::open_tube(3.0, 12.0, 16, 8), "m");
  CentrelineParameters other;
  other.root_near_mm = Vector3d(0, 0, 12);
  EXPECT_NE(centreline_key(mesh, other), centreline_key(mesh));
  EXPECT_NE(centreline_key(repair(test::open_tube(3.0, 12.1, 16, 8), "m")), centreline_key(mesh));
  EXPECT_EQ(centreline_key(repair(test::shuffled(test::open_tube(3.0, 12.0, 16, 8), 3), "m")),
            centreline_key(mesh));
}

}  // namespace
}  // namespace endowire::vessel

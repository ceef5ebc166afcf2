// What a tree answers, and how it is stored; the tree is made by hand, so the answers are known.
#include "endowire/vessel/centreline_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/storage.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr double bend_mm = 20.0;

/// Points every millimetre or so along a curve given with its tangent and curvature.
struct Curve {
  std::vector<CentrelinePoint> points;
  void add(const Vector3d& position, const Vector3d& tangent, const Vector3d& curvature, double radius) {
    CentrelinePoint p;
    p.position_mm = position;
    p.tangent = tangent;
    p.curvature_per_mm = curvature;
    p.radius_mm = radius;
    p.arc_mm = points.empty() ? 0.0 : points.back().arc_mm + (position - points.back().position_mm).norm();
    points.push_back(p);
  }
  void straight(const Vector3d& from, const Vector3d& direction, int pieces, double radius) {
    for (int i = 0; i <= pieces; ++i) add(from + i * direction, direction, Vector3d::Zero(), radius);
  }
};

/// A stem of 50 mm along z (radius 5); there a branch goes on 40 mm (radius 4), one bends by a quarter circle to x
/// (radius 2), and at its end another one leaves along y (radius 1, its ostium after 2 mm). A separate tube far away.
class HandMadeTree : public testing::Test {
 protected:
  static CentrelineTree make() {
    std::vector<Curve> curves(5);
    curves[0].straight({0, 0, 0}, {0, 0, 1}, 50, 5.0);
    curves[1].straight({0, 0, 50}, {0, 0, 1}, 40, 4.0);
    for (int i = 0; i <= 30; ++i) {
      const double a = 0.5 * std::numbers::pi * i / 30.0;
      curves[2].add({bend_mm * (1.0 - std::cos(a)), 0, 50.0 + bend_mm * std::sin(a)},
                    {std::sin(a), 0, std::cos(a)}, Vector3d(std::cos(a), 0, -std::sin(a)) / bend_mm, 2.0);
    }
    curves[3].straight(curves[2].points.back().position_mm, {0, 1, 0}, 10, 1.0);
    curves[4].straight({100, 0, 0}, {0, 0, 1}, 10, 3.0);
    const std::array<std::int32_t, 5> parent{-1, 0, 0, 2, -1};
    std::vector<CentrelineBranch> branches(5);
    std::vector<CentrelinePoint> points;
    for (std::size_t b = 0; b < 5; ++b) {
      branches[b].name = std::string(1, static_cast<char>('a' + static_cast<char>(b)));
      branches[b].vessel = branches[b].name;
      branches[b].parent = parent[b];
      branches[b].first_point = points.size();
      branches[b].points = curves[b].points.size();
      branches[b].length_mm = curves[b].points.back().arc_mm;
      points.insert(points.end(), curves[b].points.begin(), curves[b].points.end());
      if (parent[b] < 0) continue;
      CentrelineBranch& before = branches[static_cast<std::size_t>(parent[b])];
      before.children.push_back(static_cast<std::int32_t>(b));
      branches[b].from_root_mm = before.from_root_mm + before.length_mm;
    }
    branches[3].ostium_arc_mm = 2.0;
    std::vector<CentrelineBifurcation> forks{{Vector3d(0, 0, 50), 5.0, 0, {1, 2}},
                                             {curves[2].points.back().position_mm, 2.0, 2, {3}}};
    branches[0].to_bifurcation = branches[1].from_bifurcation = branches[2].from_bifurcation = 0;
    branches[2].to_bifurcation = branches[3].from_bifurcation = 1;
    std::vector<CentrelineEnd> ends(2);
    ends[0].branch = 0;
    ends[0].root = true;
    ends[1].branch = 3;
    ends[1].kind = CentrelineEndKind::opening;
    ends[1].opening = 1;
    return {branches, points, forks, ends, "made by hand"};
  }
  CentrelineTree tree = make();
  double quarter_mm = tree.branches()[2].length_mm;
};

TEST_F(HandMadeTree, NearestIsTheLumenThatAPointLiesIn) {
  const NearestCentreline in_stem = tree.nearest({4.5, 0, 20.3});
  EXPECT_EQ(in_stem.place.branch, 0);
  EXPECT_NEAR(in_stem.place.arc_mm, 20.3, 1e-12);
  EXPECT_NEAR(in_stem.offset_mm, 4.5, 1e-12);
  EXPECT_EQ(in_stem.radius_mm, 5.0);
  EXPECT_EQ(tree.nearest({0.5, 0, 75}).place.branch, 1);
  EXPECT_EQ(tree.nearest({18, 0, 70.5}).place.branch, 2);
  EXPECT_EQ(tree.nearest({20, 9, 70.2}).place.branch, 3);
  EXPECT_EQ(tree.nearest({99, 0, -400}).place.branch, 4);
  // Nearer to the thin branch's line (2.3 mm) than to the wide one's (3.9), but in the wide lumen.
  const Vector3d between(3.4, 1.9, 65.0);
  const NearestCentreline found = tree.nearest(between);
  EXPECT_EQ(found.place.branch, 1);
}

TEST_F(HandMadeTree, NearestIsThatOfAllSegments) {
  SplitMix random(1);
  for (int n = 0; n < 3000; ++n) {
    const Vector3d p(random.uniform(-10, 40), random.uniform(-10, 20), random.uniform(-10, 100));
    double least = 1e9;
    for (std::size_t b = 0; b < tree.branches().size(); ++b) {
      const auto points = tree.points_of(static_cast<std::int32_t>(b));
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vector3d chord = points[i + 1].position_mm - points[i].position_mm;
        const double f = std::clamp((p - points[i].position_mm).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (p - points[i].position_mm - f * chord).norm() - points[i].radius_mm);
      }
    }
    const NearestCentreline found = tree.nearest(p);
    ASSERT_NEAR(found.offset_mm - found.radius_mm, least, 1e-9)
        << p.transpose();  // radii are constant per branch
    // A hint, good or bad, changes nothing.
    const auto b = static_cast<std::int32_t>(random.next() % tree.branches().size());
    const CentrelinePlace hint{b, random.uniform(-5, 60)};
    const NearestCentreline hinted = tree.nearest(p, hint);
    ASSERT_EQ(hinted.place.branch, found.place.branch);
    ASSERT_EQ(hinted.place.arc_mm, found.place.arc_mm);
    ASSERT_EQ(hinted.offset_mm, found.offset_mm);
  }
}

TEST_F(HandMadeTree, StateFollowsTheCurve) {
  for (double arc = 0.0; arc <= quarter_mm; arc += 0.37) {
    const CentrelineState state = tree.state_at({2, arc});
    const double a = arc / quarter_mm * 0.5 * std::numbers::pi;
    const Vector3d exact(bend_mm * (1.0 - std::cos(a)), 0, 50.0 + bend_mm * std::sin(a));
    EXPECT_LT((state.position_mm - exact).norm(), 1e-3);
    EXPECT_LT((state.tangent - Vector3d(std::sin(a), 0, std::cos(a))).norm(), 1e-3);
    EXPECT_NEAR(state.curvature_per_mm.norm(), 1.0 / bend_mm, 1e-3 / bend_mm);
    // The tangent is the derivative of the position.
    const double h = 1e-4;
    if (arc < h || arc > quarter_mm - h) continue;
    const Vector3d step = tree.state_at({2, arc + h}).position_mm - tree.state_at({2, arc - h}).position_mm;
    EXPECT_LT((step.normalized() - state.tangent).norm(), 1e-4);
  }
  EXPECT_EQ(tree.state_at({2, -7.0}).position_mm, Vector3d(0, 0, 50));  // beyond the branch: its ends
  EXPECT_EQ(tree.state_at({0, 1e9}).position_mm, Vector3d(0, 0, 50));
}

TEST_F(HandMadeTree, BeforeItsOstiumABranchIsItsParentsLumen) {
  EXPECT_EQ(tree.lumen_branch({3, 1.9}), 2);
  EXPECT_EQ(tree.lumen_branch({3, 2.1}), 3);
  EXPECT_EQ(tree.lumen_branch({2, 0.0}), 2);
}

TEST_F(HandMadeTree, WaysRunThroughTheBifurcations) {
  const CentrelinePlace in_stem{0, 20.0};
  const CentrelinePlace straight_on{1, 15.0};
  const CentrelinePlace twig{3, 4.0};
  EXPECT_NEAR(tree.distance_mm(in_stem, twig), 30.0 + quarter_mm + 4.0, 1e-9);
  EXPECT_NEAR(tree.distance_mm(twig, in_stem), 30.0 + quarter_mm + 4.0, 1e-9);
  EXPECT_NEAR(tree.distance_mm(straight_on, twig), 15.0 + quarter_mm + 4.0, 1e-9);
  EXPECT_NEAR(tree.from_root_mm(twig), 50.0 + quarter_mm + 4.0, 1e-9);
  EXPECT_EQ(tree.route(in_stem, twig), (std::vector<std::int32_t>{0, 2, 3}));
  EXPECT_EQ(tree.route(twig, in_stem), (std::vector<std::int32_t>{3, 2, 0}));
  EXPECT_EQ(tree.route(straight_on, twig), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(tree.route(twig, twig), (std::vector<std::int32_t>{3}));
  EXPECT_TRUE(tree.route(twig, {4, 1.0}).empty());
  EXPECT_TRUE(std::isinf(tree.distance_mm(twig, {4, 1.0})));
  // From branch to branch.
  EXPECT_EQ(tree.next_turn(in_stem, twig).branch, 2);
  EXPECT_NEAR(tree.next_turn(in_stem, twig).distance_mm, 30.0, 1e-12);
  EXPECT_EQ(tree.next_turn(straight_on, twig).branch, 2);
  EXPECT_NEAR(tree.next_turn(straight_on, twig).distance_mm, 15.0, 1e-12);
  EXPECT_EQ(tree.next_turn(twig, straight_on).branch, 2);
  EXPECT_EQ(tree.next_turn({2, 10.0}, straight_on).branch, 1);
  EXPECT_EQ(tree.next_turn({2, 10.0}, in_stem).branch, 0);
  EXPECT_EQ(tree.next_turn({3, 1.0}, twig).branch, -1);
  EXPECT_NEAR(tree.next_turn({3, 1.0}, twig).distance_mm, 3.0, 1e-12);
}

TEST_F(HandMadeTree, AheadSeesBendAndNarrowing) {
  const CentrelinePlace from{0, 20.0};
  const CentrelinePlace twig{3, 4.0};
  const CentrelineAhead near = tree.ahead(from, twig, 25.0);
  EXPECT_EQ(near.max_curvature_per_mm, 0.0);
  EXPECT_EQ(near.min_radius_mm, 5.0);
  EXPECT_NEAR(near.length_mm, 25.0, 1e-9);
  const CentrelineAhead bend = tree.ahead(from, twig, 40.0);
  EXPECT_NEAR(bend.max_curvature_per_mm, 1.0 / bend_mm, 1e-9);
  EXPECT_EQ(bend.min_radius_mm, 2.0);
  const CentrelineAhead all = tree.ahead(from, twig, 1e6);
  EXPECT_EQ(all.min_radius_mm, 1.0);
  EXPECT_NEAR(all.length_mm, tree.distance_mm(from, twig), 1e-9);
  const CentrelineAhead back = tree.ahead(twig, from, 1e6);
  EXPECT_EQ(back.min_radius_mm, 1.0);
  EXPECT_NEAR(back.length_mm, all.length_mm, 1e-9);
  EXPECT_EQ(tree.ahead(from, {4, 1.0}, 10.0).length_mm, 0.0);
}

class StoredTree : public HandMadeTree {
 protected:
  std::vector<std::byte> bytes = tree.serialise(7);
};

TEST_F(StoredTree, RoundTripIsBitIdentical) {
  const CentrelineTree loaded = CentrelineTree::deserialise(bytes, 7, "cache");
  EXPECT_EQ(loaded.serialise(7), bytes);
  EXPECT_EQ(loaded.branch_named("d"), 3);
  EXPECT_EQ(loaded.nearest({18, 0, 70.5}).place.arc_mm, tree.nearest({18, 0, 70.5}).place.arc_mm);
  EXPECT_EQ(loaded.ends()[1].kind, CentrelineEndKind::opening);
}

TEST_F(StoredTree, ForeignAndDamagedBytesAreRefused) {
  EXPECT_THROW(static_cast<void>(CentrelineTree::deserialise(bytes, 8, "cache")), base::InputError);
  EXPECT_THROW(static_cast<void>(CentrelineTree::deserialise({}, 7, "cache")), base::InputError);
  for (std::size_t part = 1; part < 20; ++part) {
    const std::vector<std::byte> cut(bytes.begin(),
                                     bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * part / 20));
    EXPECT_THROW(static_cast<void>(CentrelineTree::deserialise(cut, 7, "cache")), base::InputError);
  }
  SplitMix random(7);
  for (int n = 0; n < 50; ++n) {
    std::vector<std::byte> flipped = bytes;
    flipped[random.next() % bytes.size()] ^= static_cast<std::byte>(1U << (random.next() % 8));
    EXPECT_THROW(static_cast<void>(CentrelineTree::deserialise(flipped, 7, "cache")), base::InputError);
  }
}

TEST_F(StoredTree, HostileBytesUnderAnHonestChecksumAreATreeOrAnError) {
  SplitMix random(8);
  int refused = 0;
  for (int n = 0; n < 4000; ++n) {
    std::vector<std::byte> hostile = bytes;
    for (std::uint64_t k = random.next() % 3; k < 3; ++k)
      hostile[storage_header_bytes + random.next() % (bytes.size() - storage_header_bytes)] =
          static_cast<std::byte>(random.next());
    const std::uint64_t sum = storage_checksum(std::span(hostile).subspan(storage_header_bytes));
    std::memcpy(hostile.data() + 32, &sum, sizeof sum);
    try {
      const CentrelineTree loaded = CentrelineTree::deserialise(hostile, 7, "cache");
      static_cast<void>(loaded.nearest({1, 2, 3}));  // whatever it is, it answers
      static_cast<void>(loaded.ahead({0, 1.0}, {3, 1.0}, 100.0));
      static_cast<void>(loaded.route({1, 1.0}, {3, 1.0}));
    } catch (const base::InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace endowire::vessel

#include "endowire/vessel/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Triangles of every kind: fair ones, needles, caps, points, and copies of each other; far from the origin, so that single
/// precision has few bits left.
TriangleMesh soup(std::size_t count, double off_mm, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  std::uniform_real_distribution<double> step(-3.0, 3.0);
  TriangleMesh mesh;
  for (std::size_t t = 0; t < count; ++t) {
    const Vector3d a = Vector3d::Constant(off_mm) + Vector3d(place(bits), place(bits), place(bits));
    Vector3d b = a + Vector3d(step(bits), step(bits), step(bits));
    Vector3d c = a + Vector3d(step(bits), step(bits), step(bits));
    if (t % 5 == 1) b = a + 1e-7 * (b - a);
    if (t % 5 == 2) c = a + 0.3 * (b - a) + 1e-9 * (c - a);
    if (t % 5 == 3) b = c = a;
    const auto first = static_cast<std::int32_t>(mesh.vertices_mm.size());
    mesh.vertices_mm.insert(mesh.vertices_mm.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    if (t % 7 == 0) mesh.triangles.push_back(mesh.triangles.back());
  }
  return mesh;
}

NearestPoint nearest_of_all(const TriangleMesh& mesh, const Vector3d& p) {
  NearestPoint best;
  double best2 = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3d q;
    std::uint8_t feature = 0;
    const double d2 =
        nearest_on_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), q, feature);
    if (d2 < best2) {
      best2 = d2;
      best = {std::sqrt(d2), q, static_cast<std::int32_t>(t), feature};
    }
  }
  return best;
}

std::vector<Vector3d> places(const TriangleMesh& mesh, unsigned seed) {
  const Eigen::AlignedBox3d box = bounds_mm(mesh);
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> part(-0.2, 1.2);
  std::vector<Vector3d> all;
  for (int i = 0; i < 300; ++i)
    all.push_back(box.min() + Vector3d(part(bits), part(bits), part(bits)).cwiseProduct(box.sizes()));
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); v += 17) all.push_back(mesh.vertices_mm[v]);
  all.push_back(box.center() + 1e4 * box.sizes());
  return all;
}

class Soups : public testing::TestWithParam<double> {};

TEST_P(Soups, NearestIsThatOfAllTriangles) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{8}, std::size_t{9}, std::size_t{700}}) {
    const TriangleMesh mesh = soup(count, GetParam(), 3);
    const TriangleBvh bvh(mesh);
    for (const Vector3d& p : places(mesh, 4)) {
      const NearestPoint wanted = nearest_of_all(mesh, p);
      const NearestPoint found = bvh.nearest(p);
      ASSERT_EQ(found.triangle, wanted.triangle) << count << " triangles, " << p.transpose();
      ASSERT_EQ(found.distance_mm, wanted.distance_mm);
      ASSERT_EQ(found.point_mm, wanted.point_mm);
      ASSERT_EQ(found.feature, wanted.feature);
      // Within a radius that just reaches it, and one that does not.
      ASSERT_EQ(bvh.nearest(p, wanted.distance_mm * (1.0 + 1e-12) + 1e-300).triangle, wanted.triangle);
      if (wanted.distance_mm > 0.0) {
        ASSERT_EQ(bvh.nearest(p, wanted.distance_mm * (1.0 - 1e-9)).triangle, -1);
      }
    }
  }
}

TEST_P(Soups, TouchingAreThoseOfAllTriangles) {
  const TriangleMesh mesh = soup(700, GetParam(), 5);
  const TriangleBvh bvh(mesh);
  std::vector<std::int32_t> found;
  for (const Vector3d& p : places(mesh, 6)) {
    const Eigen::AlignedBox3d box(p, p + Vector3d(9.0, 4.0, 6.0));
    std::vector<std::int32_t> wanted;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::AlignedBox3d own;
      for (std::size_t k = 0; k < 3; ++k) own.extend(mesh.corner(t, k));
      if (box.intersects(own)) wanted.push_back(static_cast<std::int32_t>(t));
    }
    ASSERT_TRUE(bvh.touching(box, found));
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, wanted);
    ASSERT_TRUE(bvh.touching(box, found, wanted.size()));
    if (!wanted.empty()) {
      ASSERT_FALSE(bvh.touching(box, found, wanted.size() - 1));
    }
  }
}

TEST_P(Soups, ARayMeetsTheFirstOfAllTriangles) {
  const TriangleMesh mesh = soup(700, GetParam(), 7);
  const TriangleBvh bvh(mesh);
  std::mt19937 bits(8);
  std::uniform_int_distribution<std::size_t> any(0, mesh.triangles.size() - 1);
  int met = 0;
  for (const Vector3d& p : places(mesh, 9)) {
    const std::size_t aim = any(bits);
    const Vector3d towards = (mesh.corner(aim, 0) + mesh.corner(aim, 1) + mesh.corner(aim, 2)) / 3.0 - p;
    if (towards.norm() < 1e-6 || towards.norm() > 1e3) continue;
    const Vector3d direction = towards.normalized();
    TriangleBvh::Hit wanted;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      TriangleMesh one;
      one.vertices_mm = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
      one.triangles = {{0, 1, 2}};
      const TriangleBvh::Hit hit = TriangleBvh(one).cast(p, direction, 0.0, 500.0);
      if (hit.triangle >= 0 && hit.distance_mm < wanted.distance_mm)
        wanted = {hit.distance_mm, static_cast<std::int32_t>(t)};
    }
    const TriangleBvh::Hit found = bvh.cast(p, direction, 0.0, 500.0);
    ASSERT_EQ(found.triangle, wanted.triangle) << p.transpose();
    ASSERT_EQ(found.distance_mm, wanted.distance_mm);
    met += found.triangle >= 0 ? 1 : 0;
  }
  EXPECT_GT(met, 100);
}

INSTANTIATE_TEST_SUITE_P(OffTheOrigin, Soups, testing::Values(0.0, 3000.0));

// A point of a triangle of height h is no further than h/2 from its sides, and the nearest one lies below the query: with d_s the distance
// to the sides, d_s² − h²/4 ≤ d² ≤ d_s². Breaks where areas that rounding has eaten decide where on a needle the nearest point is.
TEST(NearestOnTriangle, IsNoFurtherThanTheSidesAndHardlyNearerOnANeedle) {
  std::mt19937 bits(11);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const auto any = [&] { return Vector3d(part(bits), part(bits), part(bits)); };
  const auto to_segment = [](const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const double t = std::clamp((b - a).dot(p - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - (a + t * (b - a))).norm();
  };
  for (int i = 0; i < 200'000; ++i) {
    const double height_mm = std::pow(10.0, -12.0 * std::abs(part(bits)));
    const Vector3d along = any().normalized();
    const Vector3d across = along.cross(any()).normalized();
    const Vector3d a = 20.0 * any();
    const Vector3d b = a + 4.0 * along;
    const Vector3d c = a + 4.0 * std::abs(part(bits)) * along + height_mm * across;
    // Straight above it every second time: there areas vanish.
    const Vector3d p = i % 2 == 0 ? Vector3d(a + std::pow(10.0, 2.0 * part(bits)) * any())
                                  : Vector3d(a + 4.0 * std::abs(part(bits)) * along +
                                             std::pow(10.0, 2.0 * part(bits)) * along.cross(across));
    Vector3d q;
    std::uint8_t feature = 0;
    const double mm = std::sqrt(nearest_on_triangle(p, a, b, c, q, feature));
    const double sides_mm = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
    ASSERT_LE(mm, sides_mm + 1e-9) << height_mm;
    ASSERT_GE(mm * mm, sides_mm * sides_mm - 0.25 * height_mm * height_mm - 1e-9 * (1.0 + sides_mm))
        << height_mm;
    ASSERT_NEAR((p - q).norm(), mm, 1e-12);
  }
}

TEST(Bvh, OfNothingFindsNothing) {
  const TriangleMesh mesh;
  const TriangleBvh bvh(mesh);
  std::vector<std::int32_t> found;
  EXPECT_EQ(bvh.nearest(Vector3d::Zero()).triangle, -1);
  EXPECT_EQ(bvh.cast(Vector3d::Zero(), Vector3d::UnitX(), 0.0, 1.0).triangle, -1);
  EXPECT_TRUE(bvh.touching({Vector3d::Zero(), Vector3d::Ones()}, found));
}

}  // namespace
}  // namespace endowire::vessel

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

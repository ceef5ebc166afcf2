#include "endowire/vessel/near_triangles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// The answers for points in a cube are those of the tree, bit for bit.
void expect_the_tree(const ExactSurface& surface, const NearTriangles::Cube& cube,
                     const std::vector<Vector3d>& points) {
  NearTriangles near(surface);
  near.turn_to(cube, surface.at(cube.middle_mm));
  PointBlock block;
  block.count = points.size();
  for (std::size_t n = 0; n < block.count; ++n) {
    block.x[n] = points[n].x();
    block.y[n] = points[n].y();
    block.z[n] = points[n].z();
  }
  near.nearest(block);
  for (std::size_t n = 0; n < block.count; ++n) {
    const ExactSurface::Sample wanted = surface.at(points[n]);
    ASSERT_EQ(block.distance_mm[n], wanted.distance_mm) << points[n].transpose();
    ASSERT_EQ(block.triangle[n], wanted.triangle);
    ASSERT_EQ(Vector3d(block.nearest_x[n], block.nearest_y[n], block.nearest_z[n]), wanted.nearest_mm);
  }
}

/// Points of random cubes in and around a mesh.
/// @return cubes that few triangles serve, and the others
std::array<int, 2> compare(const TriangleMesh& mesh, double largest_half_mm) {
  const ExactSurface surface(mesh);
  const Eigen::AlignedBox3d box = bounds_mm(mesh);
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> part(-0.1, 1.1);
  std::uniform_real_distribution<double> in_cube(-1.0, 1.0);
  std::uniform_int_distribution<std::size_t> count(1, PointBlock::size);
  std::array<int, 2> cubes{};
  std::vector<std::int32_t> touching;
  for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
    const NearTriangles::Cube cube{
        box.min() + Vector3d(part(bits), part(bits), part(bits)).cwiseProduct(box.sizes()),
        largest_half_mm * std::pow(0.5, i % 6)};
    const ExactSurface::Sample middle = surface.at(cube.middle_mm);
    const Vector3d around = Vector3d::Constant(std::abs(middle.distance_mm) + 3.0 * cube.half_mm);
    const bool few = surface.bvh().touching({cube.middle_mm - around, cube.middle_mm + around}, touching, 40);
    ++cubes[few ? 0 : 1];
    std::vector<Vector3d> points;
    // On the surface too, where distance and sign are most delicate.
    if (std::abs(middle.distance_mm) < cube.half_mm) points.push_back(middle.nearest_mm);
    for (std::size_t n = count(bits); points.size() < n;)
      points.push_back(cube.middle_mm + cube.half_mm * Vector3d(in_cube(bits), in_cube(bits), in_cube(bits)));
    expect_the_tree(surface, cube, points);
  }
  return cubes;
}

TEST(NearTriangles, AnswerAsTheTreeDoes) {
  const std::array<int, 2> coarse = compare(test::torus(20.0, 5.0, 40, 16), 3.0);
  EXPECT_GT(coarse[0], 50);
  const std::array<int, 2> fine = compare(test::thick_tube(4.0, 6.0, 60.0, 80, 200), 3.0);
  EXPECT_GT(fine[1], 50);
}

/// Two rings of a tube all but coincide.
TriangleMesh tube_with_needles(double apart_mm) {
  constexpr int around = 8;
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, around, 3);
  for (std::size_t v = 2 * around; v < 3 * around; ++v) {
    mesh.vertices_mm[v] = mesh.vertices_mm[v - around];
    mesh.vertices_mm[v].z() += apart_mm * static_cast<double>(1 + v % 3);
  }
  for (Vector3d& v : mesh.vertices_mm) v = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()) * v;
  return mesh;
}

TEST(NearTriangles, AnswerAsTheTreeDoesAmongNeedles) {
  for (const double apart_mm : {1e-6, 1e-9, 1e-12, 0.0}) {
    const TriangleMesh mesh = tube_with_needles(apart_mm);
    EXPECT_GT(compare(mesh, 3.0)[0], 20) << apart_mm;
    // Straight above them, where their areas vanish.
    const ExactSurface surface(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vector3d& from = mesh.corner(t, 0);
      const Vector3d side = mesh.corner(t, 1) - from;
      const Vector3d up = mesh.area_normal(t).stableNormalized();
      std::vector<Vector3d> points;
      for (int n = -10; n <= 10; ++n) points.push_back(from + (0.5 + 0.015 * n) * side + 0.17 * n * up);
      expect_the_tree(surface, {from + 0.5 * side, 2.0}, points);
    }
  }
}

}  // namespace
}  // namespace endowire::vessel

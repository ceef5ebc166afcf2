#include "endowire/vessel/near_triangles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Every point of random cubes in and around a mesh: its answer is that of the tree, bit for bit.
/// @return cubes that few triangles serve, and the others
std::array<int, 2> compare(const TriangleMesh& mesh, double largest_half_mm) {
  const ExactSurface surface(mesh);
  NearTriangles near(surface);
  const Eigen::AlignedBox3d box = bounds_mm(mesh);
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> part(-0.1, 1.1);
  std::uniform_real_distribution<double> in_cube(-1.0, 1.0);
  std::uniform_int_distribution<std::size_t> points(1, PointBlock::size);
  std::array<int, 2> cubes{};
  std::vector<std::int32_t> touching;
  for (int i = 0; i < 400; ++i) {
    const NearTriangles::Cube cube{
        box.min() + Vector3d(part(bits), part(bits), part(bits)).cwiseProduct(box.sizes()),
        largest_half_mm * std::pow(0.5, i % 6)};
    const ExactSurface::Sample middle = surface.at(cube.middle_mm);
    near.turn_to(cube, middle);
    const Vector3d around = Vector3d::Constant(std::abs(middle.distance_mm) + 3.0 * cube.half_mm);
    const bool few = surface.bvh().touching({cube.middle_mm - around, cube.middle_mm + around}, touching, 40);
    ++cubes[few ? 0 : 1];
    PointBlock block;
    block.count = points(bits);
    for (std::size_t n = 0; n < block.count; ++n) {
      // On the surface too, where distance and sign are most delicate.
      const Vector3d p = n == 0 && middle.distance_mm < cube.half_mm && middle.distance_mm > -cube.half_mm
                             ? middle.nearest_mm
                             : Vector3d(cube.middle_mm +
                                        cube.half_mm * Vector3d(in_cube(bits), in_cube(bits), in_cube(bits)));
      block.x[n] = p.x();
      block.y[n] = p.y();
      block.z[n] = p.z();
    }
    near.nearest(block);
    for (std::size_t n = 0; n < block.count; ++n) {
      const Vector3d p(block.x[n], block.y[n], block.z[n]);
      const ExactSurface::Sample wanted = surface.at(p);
      EXPECT_EQ(block.distance_mm[n], wanted.distance_mm) << p.transpose();
      EXPECT_EQ(block.triangle[n], wanted.triangle);
      EXPECT_EQ(Vector3d(block.nearest_x[n], block.nearest_y[n], block.nearest_z[n]), wanted.nearest_mm);
      if (testing::Test::HasFailure()) return cubes;
    }
  }
  return cubes;
}

TEST(NearTriangles, AnswerAsTheTreeDoes) {
  const std::array<int, 2> coarse = compare(test::torus(20.0, 5.0, 40, 16), 3.0);
  EXPECT_GT(coarse[0], 50);
  const std::array<int, 2> fine = compare(test::thick_tube(4.0, 6.0, 60.0, 80, 200), 3.0);
  EXPECT_GT(fine[1], 50);
}

// Needles: whose planes rounding leaves open, and whose bounds are therefore not used.
TEST(NearTriangles, AnswerAsTheTreeDoesAmongNeedles) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 20);
  for (Vector3d& v : mesh.vertices_mm) v = Vector3d(v.x(), v.y(), 1e-6 * v.z()) + Vector3d::Constant(700.0);
  EXPECT_GT(compare(mesh, 3.0)[1], 50);
}

}  // namespace
}  // namespace endowire::vessel

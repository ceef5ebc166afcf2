#include "endowire/vessel/self_intersection.hpp"

#include <gtest/gtest.h>

#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

TEST(SelfIntersection, SoundSurfacesHaveNone) {
  for (const TriangleMesh& mesh : {test::sphere(10.0, 3), test::closed_tube(5.0, 40.0, 24, 20),
                                   test::torus(20.0, 5.0, 40, 16), test::thick_tube(4.0, 6.0, 60.0, 24, 20)})
    EXPECT_EQ(self_intersections(mesh).count, 0U);
}

TEST(SelfIntersection, AVertexPushedThroughTheOppositeWallIsFoundThere) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 20);
  mesh.vertices_mm[240] = {-8.0, 0.0,
                           20.5};  // was at (5, 0, 20): its six triangles pass through the other wall
  const FlawPlaces found = self_intersections(mesh);
  EXPECT_GE(found.count, 6U);
  ASSERT_EQ(found.first_mm.size(), FlawPlaces::most_named);
  for (const Vector3d& place : found.first_mm) EXPECT_LT((place - Vector3d(-5.0, 0.0, 20.3)).norm(), 2.0);
}

TEST(SelfIntersection, TrianglesThatTouchDoNotCount) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {2, 1, 3}, {1, 2, 3}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};  // a corner on the face
  EXPECT_EQ(self_intersections(mesh).count, 0U);
  mesh.vertices_mm[3].z() = -0.5;
  EXPECT_EQ(self_intersections(mesh).count, 1U);
}

}  // namespace
}  // namespace endowire::vessel

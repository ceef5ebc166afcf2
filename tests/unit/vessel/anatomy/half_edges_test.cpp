#include "endowire/vessel/anatomy/half_edges.hpp"

#include <gtest/gtest.h>

#include "endowire/vessel/random.hpp"
#include "support/generated_meshes.hpp"
#include "support/mesh_facts.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Index = HalfEdges::Index;

/// The triangles that are left; positions are those of the first mesh's vertices where they exist still.
TriangleMesh rest_of(const HalfEdges& edges) {
  TriangleMesh mesh;
  std::vector<Index> kept;
  mesh.triangles = edges.compact(kept);
  SplitMix random(9);
  for (std::size_t i = 0; i < kept.size(); ++i)
    mesh.vertices_mm.emplace_back(random.uniform(), random.uniform(), random.uniform());
  return mesh;
}

void expect_consistent(const HalfEdges& edges) {
  for (Index h = 0; h < edges.count(); ++h) {
    if (!edges.alive(h)) continue;
    const Index o = edges.opposite(h);
    if (o == HalfEdges::none) continue;
    ASSERT_EQ(edges.opposite(o), h);
    ASSERT_EQ(edges.from(o), edges.to(h));
    ASSERT_EQ(edges.to(o), edges.from(h));
  }
  for (Index v = 0; v < edges.vertices(); ++v) {
    if (!edges.vertex_alive(v)) continue;
    int seen = 0;
    edges.around(v, [&](Index h) {
      ASSERT_EQ(edges.from(h), v);
      ++seen;
    });
    int there = 0;
    for (Index h = 0; h < edges.count(); ++h) there += edges.alive(h) && edges.from(h) == v ? 1 : 0;
    ASSERT_EQ(seen, there) << "the fan of vertex " << v;
  }
}

/// A sphere and an open tube; welded, as the generated meshes of the tests are not.
TriangleMesh tube() {
  return test::open_tube(3.0, 12.0, 9, 6);
}

TEST(HalfEdges, SplitAddsAVertexAndKeepsTheShape) {
  HalfEdges edges(tube());
  const test::MeshFacts before = test::facts_of(rest_of(edges));
  for (Index h = 0; h < 40; ++h) {
    const Index v = edges.split(h);
    EXPECT_EQ(edges.triangles_at(v), edges.on_border(v) ? 2 : 4);
  }
  expect_consistent(edges);
  const test::MeshFacts after = test::facts_of(rest_of(edges));
  EXPECT_EQ(after.bad_edges, 0U);
  EXPECT_EQ(after.pinched, 0U);
  EXPECT_EQ(after.borders, before.borders);
  EXPECT_EQ(after.euler, before.euler);
}

TEST(HalfEdges, FlipJoinsTheOtherTwoCorners) {
  HalfEdges edges(tube());
  for (Index h = 0; h < edges.count(); ++h) {
    const Index o = edges.opposite(h);
    if (o == HalfEdges::none) continue;
    const Index c = edges.apex(h);
    const Index d = edges.apex(o);
    if (edges.joined(c, d)) continue;
    const Index a = edges.from(h);
    const Index b = edges.to(h);
    edges.flip(h);
    EXPECT_TRUE(edges.joined(c, d));
    EXPECT_FALSE(edges.joined(a, b));
    break;
  }
  expect_consistent(edges);
}

TEST(HalfEdges, RandomOperationsNeverBreakTheMesh) {
  SplitMix random(4);
  HalfEdges edges(tube());
  const test::MeshFacts before = test::facts_of(rest_of(edges));
  int collapses = 0;
  int flips = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto h = static_cast<Index>(random.next() % static_cast<std::uint64_t>(edges.count()));
    if (!edges.alive(h)) continue;
    const Index o = edges.opposite(h);
    const double choice = random.uniform();
    if (choice < 0.3) {
      edges.split(h);
    } else if (choice < 0.65) {
      if (!edges.may_collapse(h)) continue;
      edges.collapse(h);
      ++collapses;
    } else if (o != HalfEdges::none && !edges.joined(edges.apex(h), edges.apex(o)) &&
               edges.triangles_at(edges.from(h)) > 4 && edges.triangles_at(edges.to(h)) > 4) {
      edges.flip(h);
      ++flips;
    }
    if (i % 400 == 0) expect_consistent(edges);
  }
  EXPECT_GT(collapses, 300);
  EXPECT_GT(flips, 100);
  expect_consistent(edges);
  const test::MeshFacts after = test::facts_of(rest_of(edges));
  EXPECT_EQ(after.bad_edges, 0U);
  EXPECT_EQ(after.pinched, 0U);
  EXPECT_EQ(after.components, 1U);
  EXPECT_EQ(after.borders, before.borders);
  EXPECT_EQ(after.euler, before.euler);
}

TEST(HalfEdges, ACollapseThatWouldPinchIsRefused) {
  // A tetrahedron: any collapse leaves two triangles back to back.
  TriangleMesh tetrahedron;
  tetrahedron.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const HalfEdges edges(tetrahedron);
  for (Index h = 0; h < edges.count(); ++h) EXPECT_FALSE(edges.may_collapse(h));
  // Across a strip from border to border.
  const HalfEdges strip(test::open_tube(3.0, 1.0, 12, 1));
  for (Index h = 0; h < strip.count(); ++h) {
    if (strip.opposite(h) != HalfEdges::none) {
      EXPECT_FALSE(strip.may_collapse(h));
    }
  }
}

}  // namespace
}  // namespace endowire::vessel::anatomy

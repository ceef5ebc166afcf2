#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/surface.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::test {

/// What every tree of a vessel holds, against the original triangles: points in the lumen, radii the exact
/// distance to the wall, no segment through it, children that begin where their parents end.
inline void expect_tree_in_lumen(const vessel::CentrelineTree& tree, const vessel::RepairedMesh& repaired) {
  using namespace vessel;
  const ClosedSurface closed = close_surface(repaired, 1.0);
  TriangleMesh wall = closed.mesh;
  wall.triangles.resize(closed.wall_triangles);
  const TriangleBvh bvh(wall);
  std::size_t probes = 0;
  for (std::size_t b = 0; b < tree.branches().size(); ++b) {
    const CentrelineBranch& branch = tree.branches()[b];
    const auto points = tree.points_of(static_cast<std::int32_t>(b));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const CentrelinePoint& p = points[i];
      ASSERT_NEAR(p.radius_mm, bvh.nearest(p.position_mm).distance_mm, 1e-9) << branch.name << " point " << i;
      ASSERT_NEAR(p.tangent.norm(), 1.0, 1e-9) << branch.name << " point " << i;
      // An opening's own point lies in its plane, where inside and outside meet.
      const bool in_opening =
          std::any_of(repaired.openings.begin(), repaired.openings.end(),
                      [&](const Opening& o) { return (p.position_mm - o.centre_mm).norm() < o.diameter_mm; });
      if (++probes % 7 == 0 && !in_opening) {
        ASSERT_GT(winding_number(closed.mesh, p.position_mm), 0.5) << branch.name << " point " << i;
      }
      if (i == 0) continue;
      const Eigen::Vector3d step = p.position_mm - points[i - 1].position_mm;
      ASSERT_LT(bvh.cast(points[i - 1].position_mm, step.normalized(), 0.0, step.norm()).triangle, 0)
          << branch.name << " passes the wall before point " << i;
      ASSERT_NEAR(p.arc_mm - points[i - 1].arc_mm, step.norm(), 1e-9);
    }
    if (branch.parent < 0) continue;
    const auto before = tree.points_of(branch.parent);
    ASSERT_EQ(points.front().position_mm, before.back().position_mm) << branch.name;
    ASSERT_NEAR(branch.from_root_mm,
                tree.branches()[static_cast<std::size_t>(branch.parent)].from_root_mm + before.back().arc_mm,
                1e-9);
  }
}

inline long count_ends(const vessel::CentrelineTree& tree, vessel::CentrelineEndKind kind) {
  return std::count_if(tree.ends().begin(), tree.ends().end(),
                       [&](const vessel::CentrelineEnd& end) { return end.kind == kind; });
}

}  // namespace endowire::test

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::test {

/// A branch that runs straight.
struct StraightBranch {
  const char* name;
  const char* vessel;
  std::int32_t parent;  ///< -1: from the origin; else from the parent's end
  Eigen::Vector3d direction;
  double length_mm;
  double radius_mm;
  double ostium_arc_mm;
};

/// A tree of straight branches, a point every millimetre. Parents come before children.
inline vessel::CentrelineTree straight_tree(const std::vector<StraightBranch>& parts) {
  std::vector<vessel::CentrelineBranch> branches;
  std::vector<vessel::CentrelinePoint> points;
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const StraightBranch& part = parts[b];
    vessel::CentrelineBranch branch;
    branch.name = part.name;
    branch.vessel = part.vessel;
    branch.parent = part.parent;
    branch.first_point = points.size();
    branch.ostium_arc_mm = part.ostium_arc_mm;
    branch.length_mm = part.length_mm;
    branch.min_radius_mm = branch.mean_radius_mm = branch.max_radius_mm = part.radius_mm;
    Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
    if (part.parent >= 0) {
      vessel::CentrelineBranch& parent = branches[static_cast<std::size_t>(part.parent)];
      parent.children.push_back(static_cast<std::int32_t>(b));
      branch.from_root_mm = parent.from_root_mm + parent.length_mm;
      from_mm = points[parent.first_point + parent.points - 1].position_mm;
    }
    const int pieces = static_cast<int>(std::ceil(part.length_mm));
    for (int i = 0; i <= pieces; ++i) {
      vessel::CentrelinePoint point;
      point.tangent = part.direction.normalized();
      point.arc_mm = part.length_mm * i / pieces;
      point.position_mm = from_mm + point.arc_mm * point.tangent;
      point.radius_mm = part.radius_mm;
      points.push_back(point);
    }
    branch.points = points.size() - branch.first_point;
    branches.push_back(branch);
  }
  return {std::move(branches), std::move(points), {}, {}, "tree"};
}

/// A stem along z (60 mm, radius 5) that goes on as the same vessel (40 mm, radius 4); between the two a side vessel
/// leaves along x (80 mm, radius 2, its ostium 5 mm along it), which at its end goes on along z (30 mm).
inline vessel::CentrelineTree tree_with_side_vessel() {
  return straight_tree({{"1:1", "1", -1, {0, 0, 1}, 60.0, 5.0, 0.0},
                        {"1:2", "1", 0, {0, 0, 1}, 40.0, 4.0, 0.0},
                        {"1.1:1", "1.1", 0, {1, 0, 0}, 80.0, 2.0, 5.0},
                        {"1.1:2", "1.1", 2, {0, 0, 1}, 30.0, 1.5, 0.0}});
}

/// Two vessels that meet where `bent_tube` begins to bend.
inline vessel::CentrelineTree bent_tube_tree() {
  return straight_tree(
      {{"1", "1", -1, {0, 0, 1}, 20.0, 3.0, 0.0}, {"1.1", "1.1", 0, {1, 0, 1}, 80.0, 3.0, 0.0}});
}

}  // namespace endowire::test

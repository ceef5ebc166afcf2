#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "endowire/vessel/anatomy/contour.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::test {

/// How large a tree is: a trunk along x, limbs that leave it to both sides in turn, twigs that leave those up and down in
/// turn, each a little bent. As many branches as a brain's arteries have, none near another.
struct TreeSize {
  std::size_t limbs = 20;
  std::size_t twigs_of_limb = 10;
  double trunk_radius_mm = 1.5;
  double limb_radius_mm = 0.8;
  double twig_radius_mm = 0.25;

  [[nodiscard]] std::size_t vessels() const { return 1 + limbs * (1 + twigs_of_limb); }
};

/// The tree as vessels whose axes and calibres are known.
inline vessel::anatomy::Plan branching_tree(const TreeSize& size) {
  using Eigen::Vector3d;
  namespace anatomy = vessel::anatomy;
  constexpr double limb_apart_mm = 8.0;
  constexpr double twig_apart_mm = 4.0;
  constexpr double twig_mm = 12.0;
  anatomy::Plan plan;
  const double length = limb_apart_mm * static_cast<double>(size.limbs) + 16.0;
  const std::size_t trunk = anatomy::add_trunk(
      plan, "trunk", {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::Zero()}, {{0.5 * length, 0.0, 4.0}},
      {{length, 0.0, 0.0}, Vector3d::UnitX(), Vector3d::Zero()});
  anatomy::set_calibre(plan, trunk, {{0.0, size.trunk_radius_mm}});
  anatomy::add_end(plan, "root", trunk, true);
  anatomy::add_end(plan, "trunk end", trunk);
  for (std::size_t i = 0; i < size.limbs; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double arc = 8.0 + limb_apart_mm * static_cast<double>(i);
    const Vector3d from = plan.branches[trunk].axis.at(arc).position_mm;
    const double reach = twig_apart_mm * static_cast<double>(size.twigs_of_limb) + 8.0;
    anatomy::SideBranch limb;
    limb.name = "limb " + std::to_string(i);
    limb.parent = trunk;
    limb.parent_arc_mm = arc;
    limb.direction = Vector3d(0.3, side, 0.0).normalized();
    limb.straight_mm = 2.0;
    limb.through_mm = {from + Vector3d(2.0, 0.5 * side * reach, 1.0),
                       from + Vector3d(1.0, side * reach, 0.0)};
    limb.end_direction = Vector3d(0.0, side, 0.0);
    const std::size_t l = anatomy::add_side_branch(plan, limb);
    anatomy::set_calibre(plan, l, {{0.0, size.limb_radius_mm}});
    anatomy::round_ostium(plan, l, 0.3);
    anatomy::add_end(plan, limb.name + " end", l);
    for (std::size_t k = 0; k < size.twigs_of_limb; ++k) {
      const double up = k % 2 == 0 ? 1.0 : -1.0;
      const double at = 5.0 + twig_apart_mm * static_cast<double>(k);
      const Vector3d start = plan.branches[l].axis.at(at).position_mm;
      anatomy::SideBranch twig;
      twig.name = limb.name + " twig " + std::to_string(k);
      twig.parent = l;
      twig.parent_arc_mm = at;
      twig.direction = Vector3d(0.0, 0.4 * side, up).normalized();
      twig.straight_mm = 1.0;
      twig.through_mm = {start + Vector3d(0.8, 1.5 * side, 0.6 * up * twig_mm),
                         start + Vector3d(0.0, 1.5 * side, up * twig_mm)};
      twig.end_direction = Vector3d(0.0, 0.0, up);
      const std::size_t t = anatomy::add_side_branch(plan, twig);
      anatomy::set_calibre(plan, t, {{0.0, size.twig_radius_mm}});
      anatomy::round_ostium(plan, t, 0.15);
      anatomy::add_end(plan, twig.name + " end", t);
    }
  }
  return plan;
}

/// Its surface, closed by half balls, vertices on it. As triangles about as long as the spacing, but thinner: what comes
/// out of a segmentation.
inline vessel::TriangleMesh surface_of(const vessel::anatomy::Plan& plan, double spacing_mm) {
  const vessel::anatomy::LumenShape shape = vessel::anatomy::shape_of(plan);
  vessel::TriangleMesh mesh = vessel::anatomy::contour(shape, spacing_mm);
  vessel::anatomy::WallSample sample;
  for (Eigen::Vector3d& v : mesh.vertices_mm) v = shape.projected(v, 1e-4, sample);
  return mesh;
}

}  // namespace endowire::test

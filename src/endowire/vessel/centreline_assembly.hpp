#pragma once

#include <vector>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/vessel_lines.hpp"

namespace endowire::vessel {

/// A fitted vessel among others: what a tree is put together from.
struct PlacedLine {
  FittedLine fit;
  std::int32_t parent = -1;   ///< an earlier line; -1: a root
  std::size_t leaves_at = 0;  ///< point of the parent
  bool root_is_end = false;   ///< of a line without parent: its first point is an end of the lumen
  int root_opening = 0;
  CentrelineEndKind end = CentrelineEndKind::cap;
  int opening = 0;
  std::int32_t rejoins = -1;                             ///< line; -1: none
  Eigen::Vector3d rejoins_mm = Eigen::Vector3d::Zero();  ///< where, on or near that line
};

/// Cuts vessels into branches at each other's bifurcations, measures and names them.
/// @param lines  parents before children
[[nodiscard]] CentrelineTree assemble_tree(const std::vector<PlacedLine>& lines);

}  // namespace endowire::vessel

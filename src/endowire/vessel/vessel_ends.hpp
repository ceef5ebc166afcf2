#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/repair.hpp"

namespace endowire::vessel {

/// Where a vessel ends: open, or closed by a cap.
struct VesselEnd {
  int number =
      0;  ///< from 1: openings first, with their own numbers, then closed ends in the order of the tree
  bool open = false;  ///< a wire can leave here
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< out of the vessel, length one
  double diameter_mm = 0.0;                             ///< of the opening; of the lumen before the cap
  std::string branch;  ///< as the tree names it; empty where no centreline leads there
  /// Where a wire enters by this end: the middle of an opening; before a cap, on the centreline, a radius inside.
  Eigen::Vector3d access_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();  ///< of a wire that enters, length one
  /// A point of the lumen a radius before the end: what a wire has to reach to be there.
  Eigen::Vector3d inside_mm = Eigen::Vector3d::Zero();
};

/// All ends. Places where a loop of the lumen was cut are none.
[[nodiscard]] std::vector<VesselEnd> vessel_ends(const RepairedMesh& repaired, const CentrelineTree& tree);

}  // namespace endowire::vessel

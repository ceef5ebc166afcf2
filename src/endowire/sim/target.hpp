#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::sim {

/// Where the tip of the wire is to go, in words of the vessel.
struct TargetSpec {
  std::string name;  ///< for people; may be empty
  /// As the centreline tree names it, or a vessel: its first stretch. Empty: `near_mm` tells.
  std::string branch;
  Eigen::Vector3d near_mm = Eigen::Vector3d::Zero();  ///< a point in the lumen of the branch meant
  /// How far along the branch, and on as the same vessel, from its ostium. None: to the ostium of a branch that is
  /// named, as far as the point that is given.
  std::optional<double> beyond_ostium_mm;
  double within_radii = 1.5;  ///< of the centreline, in radii of the lumen there
};

/// A target found on a tree.
struct Target {
  std::int32_t branch = -1;      ///< the one meant
  vessel::CentrelinePlace goal;  ///< where the tip has to come to, or beyond
  double beyond_ostium_mm = 0.0;
  double within_radii = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< of the goal
  double radius_mm = 0.0;                                 ///< of the lumen there
};

/// @throws base::InputError `target.branch is "9"; must be …` when the tree has no such branch, the point lies in no
///                          lumen, or the vessel ends before the goal.
[[nodiscard]] Target find_target(const vessel::CentrelineTree& tree, const TargetSpec& spec);

/// How a tip stands to a target.
struct TargetDistance {
  /// The way from the root to the tip leads through the goal, and the tip lies near enough to the centreline. Further
  /// on in the same vessel, or in a branch that leaves it behind the goal, counts.
  bool reached = false;
  double to_go_mm = 0.0;  ///< along the tree to the goal, back out of a wrong branch included; 0 behind it
  double offset_radii = 0.0;  ///< of the tip from the nearest centreline, in radii of the lumen there
};

[[nodiscard]] TargetDistance distance_to(const Target& target, const vessel::CentrelineTree& tree,
                                         const Eigen::Vector3d& tip_mm);

}  // namespace endowire::sim

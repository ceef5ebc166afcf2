#pragma once

#include <Eigen/Core>

#include "endowire/sim/chain_problem.hpp"
#include "endowire/sim/snapshot.hpp"

namespace endowire::sim {

/// Wall forces of a state, summed over windows of 5 mm of wire: single samples mean nothing.
struct WallForces {
  double max_window_n = 0.0;  ///< largest over all windows
  double tip_window_n = 0.0;  ///< of the window at the tip
  double max_deflection_mm = 0.0;
  double narrowest_clearance_mm =
      0.0;  ///< lumen radius less wire radius, where a touching sample has least; > 0 if none
  Eigen::Vector3d narrowest_at_mm = Eigen::Vector3d::Zero();
};

[[nodiscard]] WallForces measure_wall(const ChainProblem& problem);

/// The joint that is nearest to its kink curvature.
struct KinkReserve {
  double ratio = 0.0;  ///< curvature over κ_m
  double curvature_per_mm = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
};

[[nodiscard]] KinkReserve measure_kink(const ChainProblem& problem);

/// Joints, curvature, twist and wall forces per length; keeps the memory of `out`.
void fill_snapshot(const ChainProblem& problem, const rod::MaterialLine& line, Snapshot& out);

}  // namespace endowire::sim

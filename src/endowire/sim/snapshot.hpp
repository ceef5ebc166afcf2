#pragma once

#include <Eigen/Core>
#include <vector>

namespace endowire::sim {

/// The wire inside the vessel as viewers and files see it: points from the tip to the sheath.
struct SnapshotPoint {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double arc_mm = 0.0;  ///< material arc length from the tip
  double radius_mm = 0.0;
  double curvature_per_mm = 0.0;
  double twist_rad = 0.0;            ///< accumulated turn of the material about its axis
  double wall_force_n_per_mm = 0.0;  ///< normal force on the wall per length of wire
  double friction_n_per_mm = 0.0;    ///< friction force per length of wire
  Eigen::Vector3d wall_force_direction = Eigen::Vector3d::Zero();  ///< of the force on the wire
};

struct Snapshot {
  std::vector<SnapshotPoint> points;  ///< one per joint; the last lies in the sheath
  double inserted_length_mm = 0.0;
  double push_force_n = 0.0;
  double torque_n_mm = 0.0;
};

}  // namespace endowire::sim

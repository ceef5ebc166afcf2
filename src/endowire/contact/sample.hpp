#pragma once

#include <Eigen/Core>
#include <array>

#include "endowire/contact/local_wall.hpp"
#include "endowire/rod/chain.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::contact {

/// A wire as contact sees it: what it is made of, how it is divided into rods, and where these are.
struct Wire {
  const rod::MaterialLine& line;
  const rod::ChainMaterial& material;
  const rod::ChainShape& shape;
};

/// A point of the wire's axis that may touch the wall. It belongs to the material, not to the vessel.
struct Sample {
  // Where on the wire.
  int rod = 0;
  double fraction = 0.0;  ///< 0 at joint `rod` … 1 at joint `rod + 1`
  double arc_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;  ///< the stretch of wire that it stands for: stretches follow each other
  double radius_mm = 0.0;
  double friction = 0.0;

  // The wall as the last detection saw it.
  int walls = 0;
  std::array<LocalWall, kMaxWalls> wall;
  Eigen::Vector3d detected_at_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_way_mm = Eigen::Vector3d::Zero();  ///< to there, since the detection before
  double clearance_mm = 0.0;                              ///< at detection, from the field
  double lumen_radius_mm = 0.0;
  double foundation_n_per_mm2 = 0.0;
  double tip_cap_n_per_mm = 0.0;
  double stick_ratio = 1.0;
  double stiffness_n_per_mm = 0.0;
  double cap_mm = 0.0;
  double stick_stiffness_n_per_mm = 0.0;

  // Friction: where the step began, and what it remembers.
  Eigen::Vector3d start_mm = Eigen::Vector3d::Zero();  ///< position in the last converged state
  double start_spin_rad = 0.0;
  Eigen::Vector3d axial = Eigen::Vector3d::UnitX();
  Eigen::Vector3d around = Eigen::Vector3d::UnitY();
  Eigen::Vector2d traction_n_per_mm =
      Eigen::Vector2d::Zero();  ///< of friction on the wire, as remembered, turned round
  Eigen::Vector2d anchor_mm = Eigen::Vector2d::Zero();  ///< slip that gives that traction
  double lagged_normal_n = 0.0;
  double last_lag_n = 0.0;  ///< by which the normal force missed the lagged one at its last renewal

  // At the state evaluated last.
  double normal_n = 0.0;
  double deflection_mm = 0.0;
  bool wrong = false;  ///< found by the last verification
  bool fresh = false;  ///< detected since the last linearisation
  std::array<bool, kMaxWalls>
      closed{};  ///< walls that touch as the last model ended; what the next one assumes

  [[nodiscard]] double share_mm() const { return to_mm - from_mm; }
  [[nodiscard]] Eigen::Vector3d position_mm(const rod::ChainShape& shape) const {
    const auto i = static_cast<std::size_t>(rod);
    return (1.0 - fraction) * shape.joints_mm[i] + fraction * shape.joints_mm[i + 1];
  }
};

}  // namespace endowire::contact

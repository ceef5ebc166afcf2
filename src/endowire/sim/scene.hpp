#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "endowire/contact/wall.hpp"
#include "endowire/sim/resolution_spec.hpp"

namespace endowire::sim {

/// Where the sheath ends in the vessel. The sheath is a straight rigid tube behind that point.
struct Access {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< into the vessel; normalised on use
};

using contact::WallSpec;

/// How often a step looks for walls. Procedures are played with `as_needed`; the others are what it is compared with (docs/paper.md).
enum class Detection : std::uint8_t {
  as_needed,        ///< once for the whole wire; then for samples whose walls prove wrong, one by one
  once,             ///< once for the whole wire; what it found is never held against the field
  every_iteration,  ///< for the whole wire, at the start and after every Newton iteration
};

/// Numerical parameters; none of the numbers shapes the result (tests change each tenfold). What `detection` leaves out does.
struct SolverSpec {
  ResolutionSpec rods;
  double correction_tolerance_mm = 1e-3;
  double correction_tolerance_deg = 1e-2;
  double force_tolerance = 1e-6;       ///< of the largest internal force or moment
  double proximal_scale = 1.0;         ///< scales the term that guides through a snap
  double stick_stiffness_ratio = 1.0;  ///< tangential over normal wall stiffness while sticking
  double grip_stiffness_n_per_mm = 1000.0;
  int max_iterations = 60;  ///< Newton iterations before a step is split
  int max_splits = 6;       ///< halvings of one step before it is reported as not converged
  Detection detection = Detection::as_needed;  ///< anything else may let the wire pass a wall
};

struct SimulationSpec {
  double max_advance_mm = 1.0;   ///< per step, 0.001 … 10
  double max_torque_deg = 10.0;  ///< per step, 0.01 … 90
  Eigen::Vector3d gravity_m_per_s2 = Eigen::Vector3d(0.0, 9.81, 0.0);
  double blood_density_g_per_mm3 = 1.06e-3;  ///< buoyancy, 0 … 2e-3
  double perforation_force_n = 1.5;          ///< tip force that counts as a perforation event
  WallSpec wall;
  SolverSpec solver;
};

/// What one hand does during a motion.
struct HandMotion {
  int instrument = 1;  ///< counted from 1, outermost first
  double advance_mm = 0.0;
  double torque_deg = 0.0;
};

/// The hands of one motion move together; motions follow one another.
struct Motion {
  double duration_s = 1.0;
  std::vector<HandMotion> hands;
};

/// What the hands do to one instrument in one step.
struct Command {
  double advance_mm = 0.0;  ///< > 0 into the vessel
  double torque_rad = 0.0;  ///< > 0 right-handed about the direction of advance
};

}  // namespace endowire::sim

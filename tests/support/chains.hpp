#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/material_line.hpp"
#include "endowire/sim/chain_problem.hpp"
#include "endowire/solve/newton.hpp"

namespace endowire::test {

/// A uniform round wire; weightless, frictionless and straight unless changed.
[[nodiscard]] rod::Section uniform_section(double flexural_rigidity_n_mm2, double length_mm);
[[nodiscard]] rod::Instrument uniform_wire(double flexural_rigidity_n_mm2, double length_mm);

/// A chain of equal rods of one wire, as a problem of statics. Its pointers tie it to its place.
struct Chain {
  Chain(const rod::Instrument& wire, int rods, double rod_length_mm, double gravity_m_per_s2 = 0.0);
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  /// Joint n at the origin, the tip along x; first directors along y. Nothing held but joint n.
  void lay_straight();
  /// Lays the chain on other joints, without twist: frames are transported along it, from that of the rod at the hand.
  void lay_untwisted(const std::vector<Eigen::Vector3d>& joints_mm);
  /// Moves the joints, by little: frames are transported in time, spins kept, twists follow.
  void move_joints(const std::vector<Eigen::Vector3d>& joints_mm);
  /// Turns the rod about its axis.
  void spin(int rod, double angle_rad);
  /// Everything stays in the plane z = 0.
  void keep_plane();

  rod::MaterialLine line;
  sim::ChainProblem problem;
  double rod_length_mm;
};

/// Newton for statics: a straight start may be far from the solution.
[[nodiscard]] solve::NewtonSpec statics_spec();

/// Minimises; a value that is no number when that did not converge.
[[nodiscard]] double nan_unless_converged(const solve::SolveReport& report);

}  // namespace endowire::test

#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/joint_energy.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::rod {

/// A chain of rods between joints, both numbered from the tip: rod i lies between joints i and i + 1.
/// Unknowns of a chain are (x, y, z) of joint i and the spin of rod i, at 4i … 4i + 3.
struct ChainShape {
  std::vector<Eigen::Vector3d> joints_mm;
  std::vector<Frame> frames;         ///< one per rod, third column towards the tip
  std::vector<double> spin_rad;      ///< unwrapped turn of each rod since it entered
  std::vector<double> twist_rad;     ///< unwrapped twist at each joint (those at the ends unused)

  [[nodiscard]] int rods() const { return static_cast<int>(frames.size()); }
  void reserve(int rods);
  void resize(int rods);
};

/// What each rod and joint of a chain is made of.
struct ChainMaterial {
  std::vector<double> arc_mm;              ///< of each joint, from the tip
  std::vector<JointMaterial> joints;       ///< of each joint; those at the ends unused
  std::vector<double> length_mm;           ///< rest length of each rod
  std::vector<double> stretch_n_per_mm;    ///< EA/l of each rod; 0 for a rod held in the sheath
  std::vector<double> weight_n;            ///< weight less buoyancy of the half rods around each joint, per unit gravity

  [[nodiscard]] int rods() const { return static_cast<int>(length_mm.size()); }
  void reserve(int rods);
  void resize(int rods);
};

/// Fills `material` for joints at the given arcs; gravity_m_per_s2 is the magnitude used for weight_n.
/// @param arc_mm  increasing, at least three
void fill_material(const MaterialLine& line, const std::vector<double>& arc_mm, double gravity_m_per_s2,
                   double fluid_density_g_per_mm3, ChainMaterial& material);
/// The same for joints `first` … end only, after the chain changed there.
void fill_material_from(const MaterialLine& line, int first, double gravity_m_per_s2, double fluid_density_g_per_mm3,
                        ChainMaterial& material);

/// Energy of bending, twist and stretch.
///
///   E = Σ_joints joint_energy + Σ_rods (EA/2l)(|t| − l)²
///
/// The rods are rigid but for the physical compliance l/EA. Newton does not crawl on that stiffness because
/// trial states keep the stretch that the linear step predicts: see retract().
[[nodiscard]] double chain_energy(const ChainMaterial& material, const ChainShape& shape);

/// Adds gradient and Hessian of chain_energy; returns the energy.
double add_chain_derivatives(const ChainMaterial& material, const ChainShape& shape, math::BandMatrix& hessian,
                             std::vector<double>& gradient);

/// Axial force in rod i, > 0 in tension [N].
[[nodiscard]] double axial_force_n(const ChainMaterial& material, const ChainShape& shape, int rod);

/// Scratch of retract(), kept so that a step allocates nothing.
struct RetractScratch {
  std::vector<double> target, diagonal, off, rhs;
  std::vector<Eigen::Vector3d> tangent;
  void reserve(int rods);
  void resize(int rods);
};

/// A point of the curve that starts at `base` along `direction` and keeps every rod's length at the value
/// that the linear step predicts: |t_i| + α ê_i·δt_i.
///
/// To first order the step is linear; the second order is the least motion of the joints that restores the lengths
/// (constraint projection with the tridiagonal matrix of a chain). Along this curve the axial force changes linearly,
/// as an independent unknown condensed out of the Newton matrix would: the two methods take the same steps.
/// Source     the projection is that of [Ryckaert1977], solved directly.
/// @param held  joints that the projection does not move (their direction entries still apply)
/// @return      false when the lengths could not be restored: the step is too long
bool retract(const ChainShape& base, const std::vector<double>& direction, double alpha, const std::vector<char>& held,
             RetractScratch& scratch, ChainShape& out);

}  // namespace endowire::rod

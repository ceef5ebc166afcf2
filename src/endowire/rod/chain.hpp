#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/joint_energy.hpp"
#include "endowire/rod/material_line.hpp"

namespace endowire::rod {

/// How an instrument lies turned about the centreline of a chain.
struct RodFrames {
  std::vector<Frame> frames;      ///< one per rod, third column towards the tip
  std::vector<double> spin_rad;   ///< unwrapped turn of each rod since it entered
  std::vector<double> twist_rad;  ///< unwrapped twist at each joint (those at the ends unused)
};

/// A chain of rods between joints, both numbered from the tip: rod i lies between joints i and i + 1.
///
/// Unknowns of a chain, in blocks of `unknowns_per_joint()`, are (x, y, z) of joint i and the spins of rod i: of the instrument that
/// reaches to the tip, then of each that shares its centreline.
struct ChainShape : RodFrames {
  std::vector<Eigen::Vector3d> joints_mm;
  std::vector<RodFrames>
      coaxial;  ///< instruments within or around the one that reaches to the tip: see coaxial.hpp

  [[nodiscard]] int rods() const { return static_cast<int>(frames.size()); }
  [[nodiscard]] int unknowns_per_joint() const { return 4 + static_cast<int>(coaxial.size()); }
  void reserve(int rods);
  void resize(int rods);
};

/// What the joints of an instrument are made of that shares the centreline of another, to behind whose tip it reaches.
struct CoaxialMaterial {
  int first_joint = 1;                ///< the first that bends it; its tip is half a rod further
  std::vector<JointMaterial> joints;  ///< of each joint; those before the first unused
};

/// What each rod and joint of a chain is made of.
struct ChainMaterial {
  std::vector<double> arc_mm;            ///< of each joint, from the tip
  std::vector<JointMaterial> joints;     ///< of each joint; those at the ends unused
  std::vector<double> length_mm;         ///< rest length of each rod
  std::vector<double> stretch_n_per_mm;  ///< EA/l of each rod; 0 for a rod held in the sheath
  std::vector<double>
      weight_n;  ///< weight less buoyancy of the half rods around each joint, per unit gravity
  std::vector<CoaxialMaterial> coaxial;  ///< as many as in the shape

  [[nodiscard]] int rods() const { return static_cast<int>(length_mm.size()); }
  void reserve(int rods);
  void resize(int rods);
};

/// A joint that stands for the wire from one arc to another.
[[nodiscard]] JointMaterial joint_material(const MaterialLine& line, double from_mm, double to_mm);

/// Fills `material` for joints at the given arcs; gravity_m_per_s2 is the magnitude used for weight_n.
/// @param arc_mm  increasing, at least three
void fill_material(const MaterialLine& line, const std::vector<double>& arc_mm, double gravity_m_per_s2,
                   double fluid_density_g_per_mm3, ChainMaterial& material);

/// A wire in a fluid under gravity: what its rods and joints are made of wherever they lie.
struct ImmersedWire {
  const MaterialLine* line = nullptr;  ///< outlives this
  double gravity_m_per_s2 = 0.0;       ///< its magnitude
  double fluid_density_g_per_mm3 = 0.0;

  /// Weight less buoyancy of a stretch.
  [[nodiscard]] double weight_n(double from_mm, double to_mm) const;
  /// As fill_material(), for joints `first` … `last` and the rods next to them only, after arcs changed there.
  void fill(int first, int last, ChainMaterial& material) const;
};

/// Energy of bending, twist and stretch.
///
///   E = Σ_instruments Σ_joints joint_energy + Σ_rods (EA/2l)(|t| − l)²
///
/// Each instrument keeps its own energy in its own frames: what they share is the centreline.
/// The rods are rigid but for the physical compliance l/EA. Newton does not crawl on that stiffness because
/// trial states keep the stretch that the linear step predicts: see retract().
[[nodiscard]] double chain_energy(const ChainMaterial& material, const ChainShape& shape);

/// Adds gradient and Hessian of bending, twist and kink; returns their energy.
double add_joint_derivatives(const ChainMaterial& material, const ChainShape& shape,
                             math::BandMatrix& hessian, std::vector<double>& gradient);

/// Adds gradient and Hessian of the stretch; returns its energy.
///
///   g = Cᵀ N,  H = Cᵀ (EA/l) C + Σ Nᵢ ∇∇|tᵢ|,  C the gradients of the lengths
///
/// N in the gradient is the force in the rod. N in the Hessian is an independent estimate, which must agree at
/// equilibrium: see geometric_force_n.
double add_stretch_derivatives(const ChainMaterial& material, const ChainShape& shape,
                               const std::vector<double>& geometric_force_n, math::BandMatrix& hessian,
                               std::vector<double>& gradient);

/// Scratch of geometric_force_n(), kept so that a step allocates nothing.
struct TridiagonalScratch {
  std::vector<double> diagonal, off, rhs;
  void reserve(int rods);
  void resize(int rods);
};

/// The axial forces that enter the Hessian.
///
/// A rod is so stiff that its present force says little about the force it will carry: a stray 1e-5 mm is newtons, and
/// with those newtons in the geometric stiffness Newton crawls (100 iterations for an elastica of 100 rods). The force
/// that best balances all other forces, min |g + CᵀN|², depends on the shape alone; but it is wild where a wire
/// is pressed into a wall. Of the two the smaller is taken, none when they differ in sign: at equilibrium both are
/// equal, so convergence stays quadratic.
/// @param gradient  of everything but the stretch
/// @param held      one per unknown; held joints do not balance
void geometric_force_n(const ChainMaterial& material, const ChainShape& shape,
                       const std::vector<double>& gradient, const std::vector<char>& held,
                       TridiagonalScratch& scratch, std::vector<double>& out);

/// Axial force in rod i, > 0 in tension [N].
[[nodiscard]] double axial_force_n(const ChainMaterial& material, const ChainShape& shape, int rod);

/// A point of the curve that starts at `base` along `direction`: every rod turns to the direction and takes the length that
/// the linear step predicts, |t| + α e·δt, and the chain is laid out again from joint n.
///
/// Along this curve the axial forces change linearly, as independent unknowns condensed out of the Newton matrix would, and
/// curvature stays as smooth as the step is. (Restoring the lengths by the least motion of the joints instead,
/// as constraint projection does, bends the chain at second order times n².)
/// The frames of all instruments are carried along and turned by their own spins.
/// @param tip_held  coordinates of the tip that must end where the linear step puts them; restored by turning the
///                  rods, most at the tip
/// @return          false when a rod would turn too far: the step is too long
bool retract(const ChainShape& base, const std::vector<double>& direction, double alpha,
             const std::array<bool, 3>& tip_held, ChainShape& out);

}  // namespace endowire::rod

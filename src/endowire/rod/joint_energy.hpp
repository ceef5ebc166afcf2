#pragma once

#include <Eigen/Core>
#include <limits>

namespace endowire::rod {

/// Orthonormal material frame of a rod: columns m₁, m₂ and the tangent, which points to the tip.
using Frame = Eigen::Matrix3d;

/// What the instrument is made of around one joint, integrated over the half rods on both sides.
struct JointMaterial {
  double span_mm = 1.0;                                  ///< l̄, half the length of the two rods
  Eigen::Vector2d bend_n_mm2 = Eigen::Vector2d::Zero();  ///< EI₁, EI₂ (span over integrated compliance)
  Eigen::Vector2d rest_bend_rad = Eigen::Vector2d::Zero();  ///< bias angle κ̄: the turn of the unloaded wire
  double twist_n_mm2 = 0.0;                                 ///< GJ
  double rest_twist_rad = 0.0;                              ///< m̄
  double kink_per_mm = std::numeric_limits<double>::infinity();  ///< κ_m
};

/// The kink law begins at this share of κ_m; five times EI κ_m is added at κ_m itself.
inline constexpr double kKinkStart = 0.9;

/// Turns of the two rods at a joint: about m₁-wards, m₂-wards (a tangent moved along m₁, m₂) and the spin, first
/// of the rod on the hand's side, then of the rod on the tip's side [rad].
using Turns = Eigen::Matrix<double, 6, 1>;

/// Value, gradient and Hessian of a joint's energy in the turns of its rods, and the integrated curvatures.
struct JointDerivatives {
  double energy_mj = 0.0;
  Turns gradient = Turns::Zero();
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  // What changes when the joint is made of another piece of wire.
  Eigen::Vector2d bend_mj =
      Eigen::Vector2d::Zero();          ///< parts of the energy, proportional to EI₁/l̄ and EI₂/l̄
  double twist_mj = 0.0;                ///< part of the energy, proportional to GJ/l̄
  double kink_by_span_mj_per_mm = 0.0;  ///< ∂(l̄ w)/∂l̄
  /// ∂E/∂κ̄ and its gradient.
  Eigen::Vector2d rest_gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> rest_turn = Eigen::Matrix<double, 2, 6>::Zero();
};

/// Twist between two frames, in the branch nearest to `near_rad`:
///
///   m = atan2(m₂·n₁ − m₁·n₂, m₁·n₁ + m₂·n₂),
///
/// the angle left after transporting the frame of the one rod to the tangent of the other. [Bergou2008 §4.2]
[[nodiscard]] double twist_between(const Frame& hand_side, const Frame& tip_side, double near_rad);

/// Bending, twist and kink energy of one joint.
///
///   E = (1/4l̄) Σ_s (κˢ − κ̄)ᵀ B (κˢ − κ̄) + (GJ/2l̄)(m − m̄)² + l̄ w(φ/l̄)
///   κˢ = (φ / sin φ) (f·m₁, f·m₂) in the frame s of each of the two rods
///   w(κ) = (EI κ_m²/6) x³,  x = (κ − 0.9 κ_m) / 0.1 κ_m > 0
///
/// Symbols    e, f   unit tangents of the rod on the hand's and on the tip's side                  [-]
///            φ      angle between them; |κ| = φ                                                    [rad]
///            m      twist, see twist_between                                                       [rad]
///            w      moment–curvature law that stiffens towards the kink limit κ_m                  [mJ/mm]
/// Source     [Wang2015 §2] for the angle between adjacent rods and its bias; [Bergou2010 §4] for frames.
/// Departure  Bergou takes |κ| = 2 tan(φ/2) and averages the two frames, which weakens the bending of a twisted
///            joint by cos²(m/2). Here each rod's frame gives half of the energy: exact for a round section.
/// Domain     φ < π; at φ → 0 the factor φ/sin φ is a series. Returns +infinity at φ ≥ π.
/// Accuracy   second order in the rod length; derivatives by Taylor slope, tests/unit/rod/joint_energy_test.cpp.
/// @param hand_side, tip_side  frames of the two rods
/// @param twist_rad            twist_between them
/// @return                     energy [mJ], never negative
[[nodiscard]] double joint_energy(const JointMaterial& material, const Frame& hand_side,
                                  const Frame& tip_side, double twist_rad);

/// The same with exact first and second derivatives. The second derivatives are those along great arcs of the
/// tangents with frames transported in parallel from this state, which makes the Hessian symmetric.
void joint_derivatives(const JointMaterial& material, const Frame& hand_side, const Frame& tip_side,
                       double twist_rad, JointDerivatives& out);

}  // namespace endowire::rod

#pragma once

#include <vector>

#include "support/plane_point.hpp"

namespace endowire::test {

/// Shape of a cantilever's end, as shares of its length.
struct ElasticaEnd {
  double tip_angle_rad = 0.0;
  double deflection = 0.0;  ///< δ/L
  double shortening = 0.0;  ///< 1 − x/L
};

/// Cantilever under a dead end force P normal to its unloaded axis, α = P L²/EI.
///
///   EI θ'' = −P cos θ,  θ = 0 at the clamp, θ' = 0 at the tip
///
/// Shooting from the tip with the fourth-order Runge–Kutta rule; ten digits.
/// Source   [BisshoppDrucker1945]
[[nodiscard]] ElasticaEnd tip_loaded_elastica(double alpha);

/// Cantilever under its own weight w per length, γ = w L³/EI.
///
///   EI θ'' = −w s cos θ,  s from the tip
///
/// Source   [Rohde1953]
[[nodiscard]] ElasticaEnd self_weight_elastica(double gamma);

/// The same two as curves from the clamp to the tip, as shares of the length.
[[nodiscard]] std::vector<PlanePoint> tip_loaded_shape(double alpha);
[[nodiscard]] std::vector<PlanePoint> self_weight_shape(double gamma);

/// Column with pinned ends after buckling, by its end angle.
struct PostBuckling {
  double load = 0.0;        ///< P/Pcr, Pcr = π² EI/L²
  double span = 0.0;        ///< distance of the ends over L
  double deflection = 0.0;  ///< at the middle, over L
};

/// With k = sin(angle/2) and the complete elliptic integrals K, E:  P/Pcr = (2K/π)², span/L = 2E/K − 1, deflection/L = k/K.
/// Source   [TimoshenkoGere1961 §2.7]
[[nodiscard]] PostBuckling post_buckling(double end_angle_rad);

/// Total twist at which a ring of a naturally straight, round wire leaves its plane, by the ratio EI/GJ: 2π√3 EI/GJ.
/// Source   [Michell1889]
[[nodiscard]] double michell_twist_rad(double bend_over_twist);

/// Moment over 2√(EI T) at which a clamped rod under tension T buckles when it is twisted, by its length in units of √(EI/T). It
/// tends to 1 as the rod grows long: M² = 4 EI T.
///
/// The deflection w = y + iz has EI w'''' − iM w''' − T w'' = 0, w = w' = 0 at both ends; so w = A + iBs + C exp(ik₁s) + D exp(ik₂s) with
/// k = p ± q, p = M/2EI, q² = p² − T/EI. Symmetry about the middle leaves A … D real, and with h half the length
///
///   (sin k₁h − k₁h cos k₁h) k₂ sin k₂h = (sin k₂h − k₂h cos k₂h) k₁ sin k₁h
///
/// Source   first variation; [vanderHeijdenThompson2000] for the limit
[[nodiscard]] double twisted_rod_onset(double length);

/// Localised buckling of a long rod under tension T and twisting moment M: the angle φ of its tangent to its axis, φ₀ in the middle.
///
///   M² = 2EI T (1 + cos φ₀),  (cos φ − cos φ₀)/(1 − cos φ₀) = tanh²(s/s*),  s* = (2EI/M) √((1 + cos φ₀)/(1 − cos φ₀))
///
/// Source   [vanderHeijdenThompson2000]
struct LocalisedBuckling {
  double moment_n_mm = 0.0;
  double extent_mm = 0.0;  ///< s*
};
[[nodiscard]] LocalisedBuckling localised_buckling(double rigidity_n_mm2, double tension_n,
                                                   double middle_rad);

/// Torque whip: a wire of rest curvature κ0 in a tube of curvature κt, α the angle between their planes.
///
///   GJ α'' = EI κ0 κt sin α,  α' = 0 at the tip,  Λ = L √(EI κ0 κt/GJ)
///
/// The angle at the hand for an angle at the tip, by the Runge–Kutta rule from the tip. Between hand and curve there may be a
/// straight piece, where α'' = 0; its length is given as a share of L.
/// Source   first variation of ∫ ½GJ α'² − EI κ0 κt cos α
[[nodiscard]] double whip_hand_angle_rad(double lambda, double tip_angle_rad, double straight = 0.0);

/// Largest angle of the hand that has an equilibrium next to the path from rest: there the tip snaps. Λ > π/2.
[[nodiscard]] double whip_snap_angle_rad(double lambda, double straight = 0.0);

}  // namespace endowire::test

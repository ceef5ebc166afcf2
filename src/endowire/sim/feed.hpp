#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/contact/friction.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/chain.hpp"

namespace endowire::sim {

/// The hand at the end of the sheath.
///
/// Joint n − 1 sits at the end of the sheath and rod n − 1 lies in it: both stay where they are. The wire that enters lengthens rod n − 2,
/// whose material flows through joint n − 1: its rest length ℓ = inserted − s is an unknown of the same minimisation as the shape. Along
/// the line of the sheath and about it the wire hangs on the hand by a stiff spring that slips at the grip's limit: F_max|δ|, δ the slip.
///
/// With a joint at the end of the sheath that stands for the half rod beyond it, the energy does not depend on where the other joints
/// happen to be, to third order in their distance: the force at the hand does not ripple as joints enter.
struct Feed {
  bool active = false;
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double inserted_mm = 0.0;     ///< length beyond the sheath in the base state
  contact::FrictionLaw push;    ///< [N/mm], [N]
  contact::FrictionLaw torque;  ///< [N·mm/rad], [N·mm]
  double stretch_mm = 0.0;      ///< hand ahead of wire in the base state: pushes
  double twist_rad = 0.0;       ///< hand ahead of wire in the base state: turns it
};

/// Length of the rod that stands for the wire in the sheath.
inline constexpr double kSheathRod_mm = 1.0;

/// Energy of the grip, an elastic spring that slips.
[[nodiscard]] double grip_energy_mj(const Feed& feed);

/// Sets what the entering rod and its joints are made of, with so much wire inserted.
void fit_entering_rod(const rod::MaterialLine& line, double inserted_mm, rod::ChainMaterial& material);

/// Adds the derivatives by the inserted length L, in the place of the first coordinate of joint n − 1, and those of the grip:
///
///   ∂Π/∂L = −N(1 + ε/2) + Σ_j (−E_b C'/C − E_t D'/D + …),   C = ∫ds/EI, D = ∫ds/GJ over the span of a joint
///
/// Of these −E_b C'/C is the configurational force ½EIκ² of a sliding sleeve [Bigoni2015]. The column and the row of that unknown must be
/// empty. N force in the entering rod, ε its strain, E_b, E_t bending and twist of its two joints. The gradient is exact; of the Hessian what
/// the kink law changes along the wire is left out, and bending and twist are taken to soften at one rate, as they do in wires of one material.
/// @return  energy of the grip
double add_feed_derivatives(const Feed& feed, const rod::MaterialLine& line,
                            const rod::ChainMaterial& material, const rod::ChainShape& shape,
                            math::BandMatrix& hessian, std::vector<double>& gradient);

}  // namespace endowire::sim

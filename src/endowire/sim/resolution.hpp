#pragma once

#include <vector>

#include "endowire/rod/chain.hpp"
#include "endowire/sim/resolution_spec.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::sim {

/// What the changes of one step did.
struct RodChanges {
  int divided = 0;
  int joined = 0;
  double energy_mj = 0.0;  ///< Σ of the absolute changes of the wire's energy
};

/// Divides and joins the rods of a wire so that each is about as long as it may be.
///
///   h = min( √(8ε/κ),  φ_m/κ,  β_m/κ₀,  D·n )       κ curvature of the wire, κ₀ at rest, D diameter of the lumen
///
/// ε is the sagitta of a rod on a curve: what a shape loses by being made of rods. κ is the largest within 8 mm along the wire to both sides, at
/// the tip also that of the vessel ahead, so that rods are short before they come to a bend and until they have left it; from there on h grows by half
/// the way.
/// Rods are cells of a binary grid of the material, longest_mm · 2⁻ᵏ from the tip on: they come and go in the same places. A rod longer than h is
/// halved; two halves of a cell are joined when the whole is shorter than 0.7 h, which is the hysteresis. Neighbours do not change in one step.
/// Source  criteria after [Wang2015], which divides rods by the diameter of the vessel and their angle; sagitta, cells and hysteresis are ours
class Resolution {
 public:
  Resolution() = default;
  /// @param wire, field  outlive this
  Resolution(const ResolutionSpec& spec, const rod::ImmersedWire& wire, const vessel::Field& field);

  /// Most rods that a wire can have: the sizes to reserve.
  [[nodiscard]] int most_rods() const { return most_rods_; }

  /// Adapts the rods in the lumen but the entering one; allocates nothing.
  RodChanges adapt(rod::ChainMaterial& material, rod::ChainShape& shape);

  /// Arc of the joint that comes out of the sheath next, behind the last one at `arc_mm`.
  [[nodiscard]] double next_joint_mm(const rod::ChainShape& shape, double arc_mm) const;

 private:
  void measure(const rod::ChainMaterial& material, const rod::ChainShape& shape);
  [[nodiscard]] double longest_cell_mm(double arc_mm, double wanted_mm) const;
  [[nodiscard]] bool cell_of_two(const rod::ChainMaterial& material, int joint) const;

  ResolutionSpec spec_;
  rod::ImmersedWire wire_;
  const vessel::Field* field_ = nullptr;
  std::vector<double> grid_;  ///< arcs of the joints of a uniform wire
  std::vector<double> wanted_mm_;
  std::vector<double> window_mm_;
  double smallest_mm_ = 0.0;  ///< cell
  int most_rods_ = 0;
};

}  // namespace endowire::sim

#pragma once

#include <vector>

#include "endowire/sim/chain_problem.hpp"
#include "endowire/sim/scene.hpp"

namespace endowire::sim {

/// The end of the sheath: the tip comes out of it and goes back, and joints come and go between it and the rest of the wire.
///
/// The entering rod never gets so short that its stiffness spoils the matrix: a joint comes out when it is kEntry_mm beyond the sheath, and goes
/// back when it would be nearer than kLeave_mm.
class Sheath {
 public:
  static constexpr double kEntry_mm = 1.0;
  static constexpr double kLeave_mm = 0.5;

  Sheath() = default;
  /// @param line            outlives this
  /// @param joint_arcs_mm   material arcs of the joints, from the tip, as uniform_grid() gives them
  /// @param gravity_m_per_s2  its magnitude
  Sheath(const rod::MaterialLine& line, const Access& access, std::vector<double> joint_arcs_mm,
         double gravity_m_per_s2, double fluid_density_g_per_mm3);

  /// Most rods that a wire can have, that in the sheath included.
  [[nodiscard]] int most_rods() const { return static_cast<int>(arcs_mm_.size()); }

  /// The tip comes out, straight.
  void enter(double inserted_mm, double turn_rad, ChainProblem& problem) const;
  /// The tip is back in the sheath: no chain is left, and no contact.
  static void leave(ChainProblem& problem);
  /// Lets joints come and go so that the entering rod keeps a sound length now and with so much inserted.
  void adapt(double inserted_mm, ChainProblem& problem) const;
  /// Fills in what the joints from `first` on are made of, and the entering rod, with the wire that is inserted.
  void fill(int first, ChainProblem& problem) const;

 private:
  const rod::MaterialLine* line_ = nullptr;
  Access access_;
  std::vector<double> arcs_mm_;
  double gravity_m_per_s2_ = 0.0;
  double fluid_density_g_per_mm3_ = 0.0;
};

}  // namespace endowire::sim

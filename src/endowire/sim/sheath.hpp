#pragma once

#include "endowire/sim/chain_problem.hpp"
#include "endowire/sim/resolution.hpp"
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
  /// @param resolution  says where the next joint is; outlives this
  Sheath(const rod::ImmersedWire& wire, const Access& access, const Resolution& resolution);

  /// The tip comes out, straight.
  void enter(double inserted_mm, double turn_rad, ChainProblem& problem) const;
  /// The tip is back in the sheath: no chain is left, and no contact.
  static void leave(ChainProblem& problem);
  /// Lets joints come and go so that the entering rod keeps a sound length now and with so much inserted.
  void adapt(double inserted_mm, ChainProblem& problem) const;
  /// Fills in what the joints from `first` on are made of, and the entering rod, with the wire that is inserted.
  void fill_from(int first, ChainProblem& problem) const;

 private:
  rod::ImmersedWire wire_;
  Access access_;
  const Resolution* resolution_ = nullptr;
};

}  // namespace endowire::sim

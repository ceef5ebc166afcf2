#pragma once

#include "endowire/sim/simulation.hpp"
#include "support/tubes.hpp"
#include "support/wires.hpp"

namespace endowire::test {

/// What a procedure came to.
struct Outcome {
  sim::State state;
  double push_n = 0.0, torque_n_mm = 0.0, wall_5mm_n = 0.0, deflection_mm = 0.0;
  bool converged = false;  ///< every step
};

/// A soft wire with a curved tip that is pushed through a bent tube: what must not matter is changed in copies of this.
struct Procedure {
  FieldPointer field = bent_tube();
  rod::Instrument wire = curved_tip_wire();
  sim::Access access = origin_access();
  sim::SimulationSpec spec;
  double first_turn_rad = 0.0;  ///< a step of its own, while the tip is in the sheath
  int steps = 70;
  sim::Command command{1.0, 0.0};
  int settling = 0;  ///< steps at the end in which the hand rests

  template <typename EachStep>
  Outcome run(EachStep each_step) const {
    sim::Simulation simulation(field, wire, access, spec);
    Outcome out;
    out.converged = first_turn_rad == 0.0 || simulation.step({0.0, first_turn_rad}).converged;
    for (int i = 0; out.converged && i < steps + settling; ++i) {
      const sim::StepReport& r = simulation.step(i < steps ? command : sim::Command{});
      each_step(r);
      out = {simulation.state(), r.push_force_n,           r.torque_n_mm,
             r.max_force_5mm_n,  r.max_wall_deflection_mm, r.converged};
    }
    return out;
  }
  [[nodiscard]] Outcome operator()() const {
    return run([](const sim::StepReport&) {});
  }
};

}  // namespace endowire::test

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "endowire/base/stage.hpp"
#include "endowire/rod/instrument.hpp"
#include "endowire/sim/event.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/sim/state.hpp"
#include "endowire/solve/solve_report.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::sim {

/// What one step did: numbers only, no allocation but the events.
struct StepReport {
  solve::SolveReport solve;  ///< of the last (or the failed) sub-step
  bool converged = false;    ///< every sub-step converged and was verified against the field
  double detections =
      0.0;  ///< collision detections, in units of the whole wire: a sample that is detected anew
            ///< counts as its share of all samples
  int verifications = 0;  ///< checks of the final state against the field
  bool walls_at_rest =
      true;  ///< false: on an edge of the field the walls that touch swung to and fro until they were left as they
             ///< were, within the gap error that verification allows
  int splits = 0;             ///< halvings of the command
  int newton_iterations = 0;  ///< over all sub-steps
  int rods = 0;
  int contact_samples = 0;
  bool snapped = false;
  int rods_divided = 0, rods_joined = 0;  ///< rods that enter not counted
  double resolution_energy_mj = 0.0;      ///< Σ|ΔE| of these changes
  double inserted_length_mm = 0.0;
  double hand_slip_mm = 0.0;  ///< commanded minus achieved advance in this step
  double push_force_n = 0.0;  ///< force of the hand on the wire, > 0 pushes
  double torque_n_mm = 0.0;   ///< torque of the hand on the wire
  double max_wall_deflection_mm = 0.0;
  double max_force_5mm_n = 0.0;  ///< wall force summed over a sliding 5 mm window, largest
  double tip_force_n = 0.0;      ///< wall force within the last 5 mm, tip cap included
  /// What this step showed, again in every step that shows it: EventWatch tells each event once.
  std::vector<Event> events;
};

/// One instrument in one vessel: the loop of the method, one command at a time.
///
/// No globals, no I/O, no threads. The state is a value: copy it, compare it, put it back.
class Simulation {
 public:
  /// @throws base::InputError when the access lies outside the lumen, the wire is wider than it there, or a number of spec.solver.rods is out of its
  /// range.
  Simulation(std::shared_ptr<const vessel::Field> field, rod::Instrument instrument, Access access,
             SimulationSpec spec);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Moves the hand and finds the new equilibrium. Commands larger than the step limits are taken in
  /// equal sub-steps. Never throws for a numerical outcome: read the report.
  const StepReport& step(const Command& command);

  [[nodiscard]] const State& state() const;
  /// Puts back a state that this simulation, or one of the same vessel, instrument, access and spec, gave.
  void restore(const State& state);
  /// Bits of the state, the same for the same history on the same binary.
  [[nodiscard]] std::uint64_t state_hash() const;
  /// Most rods that this wire can have, for those who reserve.
  [[nodiscard]] int most_rods() const;
  /// The shape and its forces for viewers and files.
  void snapshot(Snapshot& out) const;
  /// Shapes that the last step passed through on its way, where it moved far: a snap has a path, and whoever draws or
  /// judges it needs more than its ends; and the ends of the pieces that a long command is taken in. Without forces. Empty
  /// after an ordinary step.
  [[nodiscard]] int waypoints() const;
  void waypoint(int index, Snapshot& out) const;
  /// From now on tells `observer` which stage a step is in, so that a clock of the caller's can divide its time; nullptr: nobody.
  /// No result depends on it. It must outlive its use here.
  void observe_stages(base::StageObserver* observer);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace endowire::sim

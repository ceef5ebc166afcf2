#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "endowire/sim/simulation.hpp"

namespace endowire::io {

/// The value below which a fraction of the values lies (nearest rank: ceil(fraction · n)); 0 of none.
/// @param fraction  0 … 1
[[nodiscard]] double percentile(std::vector<double> values, double fraction);

[[nodiscard]] std::string_view name_of(sim::EventKind kind);
/// Of an event's value; empty for a count.
[[nodiscard]] std::string_view unit_of(sim::EventKind kind);
[[nodiscard]] std::string_view name_of(solve::Termination termination);

struct TimedEvent {
  std::uint64_t step = 0;  ///< counted from 1
  double time_s = 0.0;
  sim::Event event;
};

/// The first step that did not converge.
struct FailedStep {
  std::uint64_t step = 0;
  double time_s = 0.0;
  double inserted_length_mm = 0.0;
  solve::SolveReport solve;
};

/// What a run was like, gathered step by step.
class RunStatistics {
 public:
  /// @param begun  the events that began in this step
  void add(double time_s, const sim::StepReport& report, std::span<const sim::Event> begun,
           double wall_time_us);

  std::uint64_t steps = 0;
  std::uint64_t converged_steps = 0;
  std::uint64_t split_steps = 0;
  double detections = 0.0;
  double calm_detections = 0.0;  ///< those of steps without a snap
  std::uint64_t verifications = 0;
  int least_rods = 0;
  int most_rods = 0;
  int last_rods = 0;
  double rods = 0.0;  ///< sum over the steps
  std::uint64_t rods_divided = 0;
  std::uint64_t rods_joined = 0;
  double max_resolution_energy_mj = 0.0;
  int most_contact_samples = 0;
  double max_force_5mm_n = 0.0;
  double max_tip_force_n = 0.0;
  double max_push_force_n = 0.0;  ///< of pushing; withdrawing counts with its own sign
  double min_push_force_n = 0.0;
  double max_torque_n_mm = 0.0;            ///< of its magnitude
  double hand_slip_mm = 0.0;               ///< sum
  std::vector<double> newton_iterations;   ///< a value a step
  std::vector<double> wall_deflection_mm;  ///< a value a step
  std::vector<double> step_us;             ///< of steps without a snap
  std::vector<double> snap_step_us;        ///< of steps with one
  std::vector<TimedEvent> events;
  std::vector<FailedStep> failed;  ///< the first of them, at most one
};

}  // namespace endowire::io

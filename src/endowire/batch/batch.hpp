#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "endowire/sim/simulation.hpp"

namespace endowire::batch {

/// Many independent simulations, stepped together over all cores.
///
///   Each simulation is stepped by one thread at a time, with the floating-point modes of the caller, and shares only what
///   does not change: its vessel's field. So every state has the same bits as if the simulation had been stepped alone,
///   whatever the number of threads and whichever thread takes it.
///
/// A simulation that throws (no memory, a broken contract, a field of the caller's own) does not disturb the others: its
/// error is kept, its report says `converged = false`, and it is left out until it is restored. A step allocates nothing
/// after warm-up but what oneTBB keeps for its tasks. A batch is no more thread-safe than a simulation: one caller at a time.
class Batch {
 public:
  /// Called after a simulation's step, on the thread that took it: for what else is worth doing in parallel. It must touch
  /// nothing that belongs to another simulation.
  using AfterStep = std::function<void(std::size_t index, const sim::Simulation& simulation,
                                       const sim::StepReport& report)>;

  /// @param threads  0: as many as this process may run at once
  /// @throws base::InputError when there is no simulation, or threads is negative or above 1024
  explicit Batch(std::vector<sim::Simulation> simulations, int threads = 0);
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] int threads() const;
  void set_threads(int threads);

  /// Moves every hand once. The reports are valid until the next step.
  /// @param commands  one a simulation
  /// @throws base::InputError when there are not as many commands as simulations; nothing is stepped then
  std::span<const sim::StepReport> step(std::span<const sim::Command> commands, const AfterStep& after = {});

  [[nodiscard]] const sim::Simulation& simulation(std::size_t index) const;
  /// Puts a state back, as Simulation::restore; a simulation that was left out takes part again.
  void restore(std::size_t index, const sim::State& state);
  /// Puts another simulation in the place of one.
  void replace(std::size_t index, sim::Simulation simulation);
  /// Why a simulation is left out; empty: it is not.
  [[nodiscard]] const std::string& error(std::size_t index) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace endowire::batch

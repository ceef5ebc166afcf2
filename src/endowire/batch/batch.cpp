#include "endowire/batch/batch.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <exception>
#include <utility>

#include "endowire/base/error.hpp"

namespace endowire::batch {

namespace {

constexpr int kMostThreads = 1024;  // a slip gives more; no machine of this kind has so many

int checked(int threads) {
  if (threads < 0 || threads > kMostThreads)
    throw base::InputError("threads is " + std::to_string(threads) + "; must be 0 … " +
                           std::to_string(kMostThreads) + ", 0 for all cores");
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

struct Slot {
  sim::Simulation simulation;
  std::string error;
};

}  // namespace

class Batch::Impl {
 public:
  Impl(std::vector<sim::Simulation> simulations, int threads) : threads_(checked(threads)), arena_(threads_) {
    if (simulations.empty()) throw base::InputError("simulations is an empty list; must hold at least one");
    slots_.reserve(simulations.size());
    for (sim::Simulation& simulation : simulations) slots_.push_back({std::move(simulation), {}});
    reports_.resize(slots_.size());
    for (sim::StepReport& report : reports_) report.events.reserve(16);  // as a simulation's own
  }

  void set_threads(int threads) {
    threads_ = checked(threads);
    arena_.terminate();
    arena_.initialize(threads_);
  }

  std::span<const sim::StepReport> step(std::span<const sim::Command> commands, const AfterStep& after) {
    if (commands.size() != slots_.size())
      throw base::InputError("commands is a list of " + std::to_string(commands.size()) + "; must be of " +
                             std::to_string(slots_.size()) + ", one a simulation");
    // The caller's rounding and flushing modes hold on every thread, or results would depend on who steps what.
    tbb::task_group_context modes(
        tbb::task_group_context::isolated,
        tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, slots_.size(), 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) step_one(i, commands[i], after);
          },
          tbb::simple_partitioner(), modes);
    });
    return reports_;
  }

  void step_one(std::size_t i, const sim::Command& command, const AfterStep& after) noexcept {
    Slot& slot = slots_[i];
    sim::StepReport& report = reports_[i];
    if (slot.error.empty()) {
      try {
        report = slot.simulation.step(command);
        if (after) after(i, slot.simulation, report);
        return;
      } catch (const std::exception& error) {
        keep(error.what(), slot.error);
      } catch (...) {
        keep("an exception of unknown type", slot.error);
      }
    }
    report.events.clear();
    std::vector<sim::Event> events = std::move(report.events);  // keeps its memory
    report = sim::StepReport{};
    report.events = std::move(events);
  }

  int threads_;
  tbb::task_arena arena_;
  std::vector<Slot> slots_;
  std::vector<sim::StepReport> reports_;

 private:
  static void keep(const char* what, std::string& error) noexcept {
    try {
      error = *what != '\0' ? what : "an exception without a message";
    } catch (...) {
      error = "no memory";  // short enough to need none
    }
  }
};

Batch::Batch(std::vector<sim::Simulation> simulations, int threads)
    : impl_(std::make_unique<Impl>(std::move(simulations), threads)) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

std::size_t Batch::size() const {
  return impl_->slots_.size();
}
int Batch::threads() const {
  return impl_->threads_;
}
void Batch::set_threads(int threads) {
  impl_->set_threads(threads);
}
std::span<const sim::StepReport> Batch::step(std::span<const sim::Command> commands, const AfterStep& after) {
  return impl_->step(commands, after);
}
const sim::Simulation& Batch::simulation(std::size_t index) const {
  return impl_->slots_.at(index).simulation;
}
void Batch::restore(std::size_t index, const sim::State& state) {
  Slot& slot = impl_->slots_.at(index);
  slot.simulation.restore(state);
  slot.error.clear();
}
void Batch::replace(std::size_t index, sim::Simulation simulation) {
  impl_->slots_.at(index) = {std::move(simulation), {}};
}
const std::string& Batch::error(std::size_t index) const {
  return impl_->slots_.at(index).error;
}

}  // namespace endowire::batch

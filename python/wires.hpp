#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/batch/batch.hpp"
#include "steered_scene.hpp"

namespace endowire::python {

/// A simulation of Python. One caller at a time: a lock is taken only where Python's own is not held, so the two cannot wait for each other.
class Steered {
 public:
  Steered(const std::string& scene, const std::optional<std::filesystem::path>& cache_folder)
      : Steered(read_source(scene, cache_folder)) {}
  Steered(std::shared_ptr<const Source> source, std::shared_ptr<const Variant> variant)
      : wire_(begin(*variant)), companion_(std::move(source), std::move(variant), wire_) {}

  void reset(std::optional<std::uint64_t> seed) {
    const std::scoped_lock lock(mutex_);
    wire_ = companion_.reset(seed);
  }
  Report step(const sim::Command& command) {
    const std::scoped_lock lock(mutex_);
    return companion_.after(command, wire_, wire_.step(command));
  }
  Observation observe() const {
    const std::scoped_lock lock(mutex_);
    return companion_.observe();
  }
  std::string save() const {
    const std::scoped_lock lock(mutex_);
    return companion_.save(wire_);
  }
  void restore(const std::string& bytes) {
    const std::scoped_lock lock(mutex_);
    auto other = companion_.restore(bytes, [&](const sim::State& state) { wire_.restore(state); });
    if (other) wire_ = std::move(*other);
  }
  std::uint64_t state_hash() const {
    const std::scoped_lock lock(mutex_);
    return wire_.state_hash();
  }
  std::vector<sim::Command> commands() const {
    const std::scoped_lock lock(mutex_);
    std::vector<sim::Command> all;
    for (const io::TimedCommand& timed : io::commands_of(companion_.source->scene))
      all.push_back(timed.command);
    return all;
  }
  std::pair<sim::Simulation, Companion> twin() const {
    const std::scoped_lock lock(mutex_);
    sim::Simulation wire = begin(*companion_.variant);
    wire.restore(wire_.state());
    return {std::move(wire), companion_};
  }
  std::shared_ptr<Steered> copy() const {
    auto [wire, companion] = twin();
    return std::shared_ptr<Steered>(new Steered(std::move(wire), std::move(companion)));
  }

 private:
  explicit Steered(const std::shared_ptr<const Source>& source) : Steered(source, source->as_written) {}
  Steered(sim::Simulation wire, Companion companion)
      : wire_(std::move(wire)), companion_(std::move(companion)) {}

  mutable std::mutex mutex_;
  sim::Simulation wire_;
  Companion companion_;
};

/// Many of them, stepped together.
class Batch {
 public:
  /// Owned together with Python, which may let go of them while they are copied.
  using Simulations = std::vector<std::shared_ptr<Steered>>;

  Batch(const Simulations& simulations, int threads) : batch_(twins(simulations, companions_), threads) {}

  std::size_t size() const { return batch_.size(); }
  std::vector<Report> step(const std::vector<sim::Command>& commands) {
    const std::scoped_lock lock(mutex_);
    std::vector<Report> reports(size());
    const auto steps =
        batch_.step(commands, [&](std::size_t i, const sim::Simulation& wire, const sim::StepReport& report) {
          reports[i] = companions_[i].after(commands[i], wire, report);
        });
    for (std::size_t i = 0; i < reports.size(); ++i)
      if (!batch_.error(i).empty()) reports[i] = {steps[i], {}, companions_[i].variant};
    return reports;
  }
  void reset(std::ptrdiff_t at, std::optional<std::uint64_t> seed) {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = checked(at);
    batch_.replace(index, companions_[index].reset(seed));
  }
  Observation observe(std::ptrdiff_t at) const {
    const std::scoped_lock lock(mutex_);
    return companions_[checked(at)].observe();
  }
  std::string save(std::ptrdiff_t at) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = checked(at);
    return companions_[index].save(batch_.simulation(index));
  }
  void restore(std::ptrdiff_t at, const std::string& bytes) {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = checked(at);
    auto other =
        companions_[index].restore(bytes, [&](const sim::State& state) { batch_.restore(index, state); });
    if (other) batch_.replace(index, std::move(*other));
  }
  std::uint64_t state_hash(std::ptrdiff_t at) const {
    const std::scoped_lock lock(mutex_);
    return batch_.simulation(checked(at)).state_hash();
  }
  std::string error(std::ptrdiff_t at) const {
    const std::scoped_lock lock(mutex_);
    return batch_.error(checked(at));
  }

 private:
  static std::vector<sim::Simulation> twins(const Simulations& simulations,
                                            std::vector<Companion>& companions) {
    std::vector<sim::Simulation> wires;
    for (const std::shared_ptr<Steered>& simulation : simulations) {
      if (!simulation) throw base::InputError("simulations holds None; must hold simulations");
      auto [wire, companion] = simulation->twin();
      wires.push_back(std::move(wire));
      companions.push_back(std::move(companion));
    }
    return wires;
  }
  std::size_t checked(std::ptrdiff_t index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= size())
      throw base::InputError("index is " + std::to_string(index) + "; must be 0 … " +
                             std::to_string(size() - 1));
    return static_cast<std::size_t>(index);
  }

  mutable std::mutex mutex_;
  std::vector<Companion> companions_;
  batch::Batch batch_;
};

}  // namespace endowire::python

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "endowire/io/prepared_scene.hpp"
#include "endowire/io/saved_state.hpp"
#include "endowire/sim/event_watch.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/sim/target.hpp"

namespace endowire::python {

/// A scene as written, and as one of its variants: what reset(seed) picks. Nothing in it changes, so any number of
/// simulations share it.
struct Variant {
  std::optional<std::uint64_t> seed;  ///< none: as the scene says
  std::shared_ptr<const io::PreparedScene> prepared;
};

/// What a simulation of Python stands on: the scene as it was read, kept for variants to be made of.
struct Source {
  io::SceneFile scene;
  std::shared_ptr<const Variant> as_written;
  std::uint64_t key = 0;  ///< of scene, instrument and vessel: whose saved states are whose
};

/// Reads and prepares a scene.
/// @param scene         the text of a scene when it holds a line break, else the path of one
/// @param cache_folder  of prepared vessels; none: the program's own
/// @throws base::InputError as the program says it
[[nodiscard]] std::shared_ptr<const Source> read_source(
    const std::string& scene, const std::optional<std::filesystem::path>& cache_folder);

/// The variant of a scene: a generated vessel is drawn anew by the seed; a vessel from a file stays. It goes into no
/// cache, which seeds would fill.
[[nodiscard]] std::shared_ptr<const Variant> variant_of(const Source& source,
                                                        std::optional<std::uint64_t> seed);

/// A simulation in the state in which a variant begins: a seed also turns the instrument at the hand.
[[nodiscard]] sim::Simulation begin(const Variant& variant);

/// A step as Python sees it.
struct Report {
  sim::StepReport step;
  std::vector<sim::Event> events;  ///< that began in this step
  std::shared_ptr<const Variant> variant;
};

/// What is known of the wire between two steps.
struct Observation {
  sim::Snapshot snapshot;
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();
  std::string branch;  ///< of the centreline tree, that the tip lies in; empty: it has none
  std::optional<sim::TargetDistance> target;
};

/// All beside the simulation itself that one wire of Python remembers.
struct Companion {
  std::shared_ptr<const Source> source;
  std::shared_ptr<const Variant> variant;
  sim::EventWatch events;
  sim::Snapshot last;  ///< after the last step: a state that is put back has no forces of its own

  Companion(std::shared_ptr<const Source> of, std::shared_ptr<const Variant> as, const sim::Simulation& wire);
  [[nodiscard]] Report after(const sim::Command& command, const sim::Simulation& wire,
                             const sim::StepReport& report);
  [[nodiscard]] Observation observe() const;

  /// Begins anew, as the variant of a seed.
  /// @return the wire to go on with
  [[nodiscard]] sim::Simulation reset(std::optional<std::uint64_t> seed);

  /// The bytes of a wire between two steps: state, events under way, the last forces, and its variant.
  [[nodiscard]] std::string save(const sim::Simulation& wire) const;
  /// Goes on as it was saved.
  /// @param put  puts a state into the wire at hand; it may throw
  /// @return the wire to go on with in its place, when another variant was saved
  /// @throws base::InputError for bytes that are none, damaged, or of another scene; nothing is changed then
  [[nodiscard]] std::optional<sim::Simulation> restore(const std::string& bytes,
                                                       const std::function<void(const sim::State&)>& put);
};

}  // namespace endowire::python

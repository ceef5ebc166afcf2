#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "endowire/io/scene_file.hpp"
#include "endowire/io/vessel_file.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/sim/target.hpp"
#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::io {

/// A scene and all that its simulation needs. Field, centrelines and target may be shared by any number of simulations,
/// on any number of threads: none of them changes.
struct PreparedScene {
  SceneFile scene;  ///< its access and target with what only the vessel tells
  VesselMesh vessel;
  PreparedField prepared;
  std::shared_ptr<const vessel::CentrelineTree> centrelines;
  std::optional<sim::Target> target;
};

/// Reads or makes the vessel of a scene and prepares it: the field on this thread, the centrelines on another.
/// @param cache_folder  of prepared vessels, created when missing; empty: no cache
/// @throws base::InputError one line about the vessel, the access or the target
[[nodiscard]] PreparedScene prepare_scene(SceneFile scene, const std::filesystem::path& cache_folder);

/// The wire of a scene in its vessel, its tip in the sheath.
/// @throws base::InputError named after the scene, when the wire does not fit where the scene puts it
[[nodiscard]] sim::Simulation simulation_of(const PreparedScene& prepared);

}  // namespace endowire::io

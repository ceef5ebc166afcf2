#pragma once

#include <optional>

#include "endowire/io/scene_file.hpp"
#include "endowire/io/vessel_file.hpp"
#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::io {

/// The vessel of a scene, read or made.
[[nodiscard]] VesselMesh vessel_of(const SceneFile& scene);

/// Where a scene's sheath ends: as given, at an end of the vessel (vessel::vessel_ends), or where a generated vessel says.
/// @throws base::InputError when the vessel lacks the end
[[nodiscard]] sim::Access access_of(const SceneFile& scene, const VesselMesh& vessel,
                                    const vessel::CentrelineTree& centrelines);

/// A scene's target, with the place of the end of the vessel that it names; none when it has none.
/// @throws base::InputError when the vessel lacks the end
[[nodiscard]] std::optional<sim::TargetSpec> target_of(const SceneFile& scene, const VesselMesh& vessel,
                                                       const vessel::CentrelineTree& centrelines);

}  // namespace endowire::io

#pragma once

#include "endowire/io/scene_file.hpp"
#include "endowire/io/vessel_file.hpp"

namespace endowire::io {

/// The vessel of a scene, read or made.
[[nodiscard]] VesselMesh vessel_of(const SceneFile& scene);

/// Where a scene's sheath ends: as given, at the centre of an opening, or where a generated vessel says.
/// @throws base::InputError when the vessel lacks the opening
[[nodiscard]] sim::Access access_of(const SceneFile& scene, const VesselMesh& vessel);

}  // namespace endowire::io

#include "endowire/io/scene_vessel.hpp"

#include <fmt/format.h>

#include "endowire/base/error.hpp"

namespace endowire::io {

VesselMesh vessel_of(const SceneFile& scene) {
  return scene.vessel.generate ? generate_vessel(*scene.vessel.generate)
                               : read_vessel_file(scene.vessel.file, scene.vessel.unit);
}

sim::Access access_of(const SceneFile& scene, const VesselMesh& vessel) {
  if (!scene.opening) return scene.access_given || !vessel.access ? scene.access : *vessel.access;
  const std::vector<vessel::Opening>& openings = vessel.repaired.openings;
  for (const vessel::Opening& opening : openings)
    if (opening.number == *scene.opening) return {opening.centre_mm, -opening.direction};
  throw base::InputError(fmt::format("{}: access.opening is {}; must be {}", scene.name, *scene.opening,
                                     openings.empty() ? "left out: the vessel has no opening"
                                                      : fmt::format("between 1 and {}", openings.size())));
}

}  // namespace endowire::io

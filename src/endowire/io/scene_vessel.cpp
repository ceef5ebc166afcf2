#include "endowire/io/scene_vessel.hpp"

#include <fmt/format.h>

#include "endowire/base/error.hpp"
#include "endowire/vessel/vessel_ends.hpp"

namespace endowire::io {

namespace {

vessel::VesselEnd end_of(const SceneFile& scene, const char* field, int number, const VesselMesh& vessel,
                         const vessel::CentrelineTree& centrelines) {
  const std::vector<vessel::VesselEnd> ends = vessel::vessel_ends(vessel.repaired, centrelines);
  for (const vessel::VesselEnd& end : ends)
    if (end.number == number) return end;
  throw base::InputError(fmt::format(
      "{}: {} is {}; must be {}", scene.name, field, number,
      ends.empty() ? "left out: the vessel has no end" : fmt::format("between 1 and {}", ends.size())));
}

}  // namespace

VesselMesh vessel_of(const SceneFile& scene) {
  return scene.vessel.generate ? generate_vessel(*scene.vessel.generate)
                               : read_vessel_file(scene.vessel.file, scene.vessel.unit, scene.vessel.volume);
}

sim::Access access_of(const SceneFile& scene, const VesselMesh& vessel,
                      const vessel::CentrelineTree& centrelines) {
  if (!scene.opening) return scene.access_given || !vessel.access ? scene.access : *vessel.access;
  const vessel::VesselEnd end = end_of(scene, "access.opening", *scene.opening, vessel, centrelines);
  return {end.access_mm, end.inward};
}

std::optional<sim::TargetSpec> target_of(const SceneFile& scene, const VesselMesh& vessel,
                                         const vessel::CentrelineTree& centrelines) {
  std::optional<sim::TargetSpec> target = scene.target;
  if (target && scene.target_opening)
    target->near_mm = end_of(scene, "target.opening", *scene.target_opening, vessel, centrelines).inside_mm;
  return target;
}

}  // namespace endowire::io

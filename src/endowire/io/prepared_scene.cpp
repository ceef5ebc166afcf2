#include "endowire/io/prepared_scene.hpp"

#include <future>
#include <string>
#include <utility>

#include "endowire/base/error.hpp"
#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_vessel.hpp"

namespace endowire::io {

namespace {

/// Calls something of a lower layer, which knows no file names: bad input is named after the scene.
template <class Call>
auto named_after(const std::string& scene, Call call) {
  try {
    return call();
  } catch (const base::InputError& error) {
    const std::string message = error.what();
    throw base::InputError(message.starts_with(scene) ? message : scene + ": " + message);
  }
}

}  // namespace

PreparedScene prepare_scene(SceneFile scene, const std::filesystem::path& cache_folder) {
  PreparedScene all;
  all.scene = std::move(scene);
  all.vessel = vessel_of(all.scene);
  std::future<std::shared_ptr<const vessel::CentrelineTree>> centrelines =
      std::async(std::launch::async, [&] { return prepare_centrelines(all.vessel, cache_folder); });
  all.prepared = prepare_field(all.vessel, cache_folder);
  all.centrelines = centrelines.get();
  all.scene.access = access_of(all.scene, all.vessel, *all.centrelines);
  all.scene.target = target_of(all.scene, all.vessel, *all.centrelines);
  if (all.scene.target)
    all.target =
        named_after(all.scene.name, [&] { return sim::find_target(*all.centrelines, *all.scene.target); });
  return all;
}

sim::Simulation simulation_of(const PreparedScene& prepared) {
  return named_after(prepared.scene.name, [&] {
    return sim::Simulation(prepared.prepared.field, prepared.scene.instrument, prepared.scene.access,
                           prepared.scene.simulation);
  });
}

}  // namespace endowire::io

#include "harness/scenario.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/io/centreline_file.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/io/scene_vessel.hpp"
#include "harness/machine.hpp"
#include "paper/coil.hpp"

namespace endowire::bench {

namespace {

namespace fs = std::filesystem;

const fs::path root = ENDOWIRE_SOURCE_DIR;

Prepared prepare_coil() {
  Prepared out;
  const double start_us = cpu_us();
  const paper::Coil coil = paper::coil();
  out.prepare_s = 1e-6 * (cpu_us() - start_us);
  out.field = coil.field;
  out.access = coil.access;
  out.instrument = paper::long_wire();
  out.spec.gravity_m_per_s2.setZero();
  out.commands.assign(static_cast<std::size_t>(paper::kLongWire_mm), {1.0, 0.0});
  return out;
}

Prepared prepare_scene(const Scenario& scenario, const fs::path& cache_folder) {
  Prepared out;
  io::SceneFile scene = io::read_scene_file(scenario.scene, {root / "instruments"});
  if (scenario.step_mm > 0.0) {  // turns become as much finer
    scene.simulation.max_torque_deg *= scenario.step_mm / scene.simulation.max_advance_mm;
    scene.simulation.max_advance_mm = scenario.step_mm;
  }
  if (scenario.rod_mm > 0.0) {
    scene.simulation.solver.rods.adaptive = false;
    scene.simulation.solver.rods.rod_length_mm = scenario.rod_mm;
  }
  const double start_us = cpu_us();
  const io::VesselMesh vessel = io::vessel_of(scene);
  const double read_us = cpu_us();
  const io::PreparedField prepared = io::prepare_field(vessel, cache_folder);
  out.field_s = 1e-6 * (cpu_us() - read_us);
  out.access = io::access_of(scene, vessel, *io::prepare_centrelines(vessel, cache_folder));
  out.prepare_s = 1e-6 * (cpu_us() - start_us);
  out.field = prepared.field;
  out.field_bytes = prepared.field->facts().bytes;
  out.triangles = vessel.repaired.mesh.triangles.size();
  out.instrument = scene.instrument;
  out.spec = scene.simulation;
  for (const io::TimedCommand& timed : io::commands_of(scene)) out.commands.push_back(timed.command);
  return out;
}

}  // namespace

std::vector<Scenario> scenarios() {
  const fs::path left_carotid = root / "scenes/femoral_to_left_carotid.toml";
  std::vector<Scenario> all{
      {"femoral_to_left_carotid", "steered into the left carotid of a patient, 1 mm a step", left_carotid,
       0.0, 0.0, 0, 20'000, false, "procedures"},
      {"femoral_to_left_carotid_fine_steps", "the same as a haptic loop takes it, 0.02 mm a step",
       left_carotid, 0.02, 0.0, 0, 0, false, "procedures"},
      {"femoral_to_left_carotid_300_rods", "the same with uniform rods of 1.6 mm; steps of 285 rods and more",
       left_carotid, 0.0, 1.6, 285, 0, false, "procedures"},
      {"generated_left_carotid", "the same in an aorta made in code",
       root / "scenes/generated_left_carotid.toml", 0.0, 0.0, 0, 3'000, false, "procedures"},
      {"generated_right_carotid", "past one vessel more", root / "scenes/generated_right_carotid.toml", 0.0,
       0.0, 0, 3'000, false, "procedures"},
      {"generated_entry", "pushed up the aorta into the arch, not steered",
       root / "scenes/generated_entry.toml", 0.0, 0.0, 0, 3'000, false, "procedures"},
      {"carotid_siphon", "a 0.014\" wire turned through the siphon: narrow, tortuous",
       root / "bench/scenes/carotid_siphon.toml", 0.0, 0.0, 0, 3'000, false, "procedures"},
      {"long_wire", "260 cm of wire pushed into a coil", {}, 0.0, 0.0, 0, 0, false, "long"}};
  for (const char* vessel : {"neuro", "fine"})
    for (const char* shaft : {"80mpa", "80gpa"})
      all.push_back({std::string("peer_") + vessel + "_" + shaft, "500 mm as the comparison pushes them",
                     root / "bench/scenes" / (std::string("peer_") + vessel + "_" + shaft + ".toml"), 0.0,
                     0.0, 0, 0, true, "peers"});
  if (!fs::exists(root / "../shared/vessels/femoral_to_neuro/lumen_mm.stl"))
    std::erase_if(all, [](const Scenario& s) { return s.name.starts_with("femoral") || s.group == "peers"; });
  return all;
}

Prepared prepare(const Scenario& scenario, const fs::path& cache_folder) {
  return scenario.scene.empty() ? prepare_coil() : prepare_scene(scenario, cache_folder);
}

}  // namespace endowire::bench

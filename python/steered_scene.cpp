#include "steered_scene.hpp"

#include <dlfcn.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "endowire/io/instrument_json.hpp"
#include "endowire/io/places.hpp"
#include "endowire/io/scene_file.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::python {

namespace fs = std::filesystem;

namespace {

/// Of this module, beside which an installed one keeps its instruments.
fs::path module_folder() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&begin), &info) == 0 || info.dli_fname == nullptr) return {};
  return fs::path(info.dli_fname).parent_path();
}

std::uint64_t key_of(const io::PreparedScene& prepared) {
  vessel::ContentHash key;
  for (const std::string& text : {prepared.scene.text, io::to_json(prepared.scene.instrument).dump()})
    key.add_bytes(reinterpret_cast<const std::byte*>(text.data()), text.size());
  key.add(prepared.vessel.content_hash);
  return key.value();
}

}  // namespace

std::shared_ptr<const Source> read_source(const std::string& scene,
                                          const std::optional<fs::path>& cache_folder) {
  const std::vector<fs::path> instruments = io::instrument_folders(module_folder(), ENDOWIRE_SOURCE_DIR);
  auto source = std::make_shared<Source>();
  source->scene = scene.find('\n') != std::string::npos
                      ? io::parse_scene(scene, "scene", instruments, io::Script::optional)
                      : io::read_scene_file(scene, instruments, io::Script::optional);
  auto prepared = std::make_shared<const io::PreparedScene>(
      io::prepare_scene(source->scene, cache_folder.value_or(io::default_cache_folder())));
  source->key = key_of(*prepared);
  source->as_written = std::make_shared<Variant>(Variant{std::nullopt, std::move(prepared)});
  return source;
}

std::shared_ptr<const Variant> variant_of(const Source& source, std::optional<std::uint64_t> seed) {
  if (!seed) return source.as_written;
  if (!source.scene.vessel.generate)  // the same vessel: only the instrument's turn is another
    return std::make_shared<Variant>(Variant{seed, source.as_written->prepared});
  io::SceneFile scene = source.scene;
  scene.vessel.generate->seed = seed;
  return std::make_shared<Variant>(
      Variant{seed, std::make_shared<const io::PreparedScene>(io::prepare_scene(std::move(scene), {}))});
}

sim::Simulation begin(const Variant& variant) {
  sim::Simulation wire = io::simulation_of(*variant.prepared);
  if (variant.seed) {
    sim::State state = wire.state();
    vessel::SplitMix draw(*variant.seed);
    state.hand_turn_rad = draw.uniform(-std::numbers::pi, std::numbers::pi);
    wire.restore(state);
  }
  return wire;
}

Companion::Companion(std::shared_ptr<const Source> of, std::shared_ptr<const Variant> as,
                     const sim::Simulation& wire)
    : source(std::move(of)), variant(std::move(as)), events(variant->prepared->centrelines) {
  events.reserve(static_cast<std::size_t>(wire.most_rods()), source->scene.instrument.length_mm());
  wire.snapshot(last);
}

Report Companion::after(const sim::Command& command, const sim::Simulation& wire,
                        const sim::StepReport& report) {
  wire.snapshot(last);
  const std::span<const sim::Event> begun = events.after(command, report, last);
  return {report, {begun.begin(), begun.end()}, variant};
}

Observation Companion::observe() const {
  Observation seen;
  seen.snapshot = last;
  const io::PreparedScene& prepared = *variant->prepared;
  seen.tip_mm = last.points.empty() ? prepared.scene.access.position_mm : last.points.front().position_mm;
  if (const std::int32_t branch = prepared.centrelines->branch_at(seen.tip_mm); branch >= 0)
    seen.branch = prepared.centrelines->branches()[static_cast<std::size_t>(branch)].name;
  if (prepared.target) seen.target = sim::distance_to(*prepared.target, *prepared.centrelines, seen.tip_mm);
  return seen;
}

sim::Simulation Companion::reset(std::optional<std::uint64_t> seed) {
  std::shared_ptr<const Variant> other = variant_of(*source, seed);
  sim::Simulation wire = begin(*other);
  *this = Companion(source, std::move(other), wire);
  return wire;
}

std::string Companion::save(const sim::Simulation& wire) const {
  return io::pack_state({variant->seed, wire.state(), events.memory(), last}, source->key);
}

std::optional<sim::Simulation> Companion::restore(const std::string& bytes,
                                                  const std::function<void(const sim::State&)>& put) {
  io::SavedState saved = io::unpack_state(bytes, source->key, "state");
  std::shared_ptr<const Variant> of = saved.seed == variant->seed ? variant : variant_of(*source, saved.seed);
  sim::EventWatch(of->prepared->centrelines).restore(saved.events);  // refuses what cannot be
  std::optional<sim::Simulation> other;
  if (of == variant) {
    put(saved.state);
  } else {
    other = begin(*of);
    other->restore(saved.state);
    *this = Companion(source, std::move(of), *other);
  }
  events.restore(saved.events);
  last = std::move(saved.last);
  return other;
}

}  // namespace endowire::python

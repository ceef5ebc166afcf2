#include "endowire/io/vessel_file.hpp"

#include <cstdlib>
#include <span>
#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::io {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t max_field_bytes = std::uintmax_t{2} << 30;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

}  // namespace

VesselMesh read_vessel_file(const fs::path& path, vessel::LengthUnit unit) {
  VesselMesh mesh;
  mesh.source = one_line(path.string());
  mesh.unit = unit;
  const std::string bytes = read_file(path, max_mesh_bytes);
  mesh.content_hash = content_hash(bytes);
  mesh.repaired = vessel::repair(vessel::parse_stl(bytes_of(bytes), mesh.source, unit), mesh.source, unit);
  return mesh;
}

VesselMesh generate_vessel(const vessel::GenerateRequest& request) {
  const vessel::GeneratedVessel made = vessel::generate(request);
  VesselMesh mesh;
  mesh.source = std::string(generated_prefix) + request.name;
  if (request.seed) mesh.source += " seed " + std::to_string(*request.seed);
  mesh.content_hash = vessel::content_hash(made.mesh);
  mesh.repaired = vessel::repair(made.mesh, mesh.source);
  mesh.access = sim::Access{made.access_position_mm, made.access_direction};
  return mesh;
}

PreparedField prepare_field(const VesselMesh& mesh, const fs::path& cache_folder,
                            const vessel::FieldParameters& parameters) {
  PreparedField prepared;
  const std::uint64_t key = vessel::MeshField::key(mesh.repaired, parameters);
  const fs::path file = cache_folder / field_cache_name(key);
  std::error_code error;
  if (!cache_folder.empty() && fs::is_regular_file(file, error)) {
    try {
      const std::string bytes = read_file(file, max_field_bytes);
      prepared.field = std::make_shared<const vessel::MeshField>(
          vessel::MeshField::deserialise(bytes_of(bytes), key, one_line(file.string())));
      prepared.origin = FieldOrigin::cached;
      return prepared;
    } catch (const base::InputError&) {
      // Damaged or of an older version: no fault of the user's input, and prepared anew below.
    }
  }
  prepared.field =
      std::make_shared<const vessel::MeshField>(vessel::MeshField::build(mesh.repaired, parameters));
  if (cache_folder.empty()) return prepared;
  try {
    fs::create_directories(cache_folder, error);
    const std::vector<std::byte> bytes = prepared.field->serialise();
    write_file_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    prepared.origin = FieldOrigin::prepared;
  } catch (const base::InputError&) {
    prepared.origin = FieldOrigin::prepared_not_cached;  // a full or read-only disk costs time, never the run
  }
  return prepared;
}

std::string field_cache_name(std::uint64_t key) {
  return "field-" + hash_text(key) + ".bin";
}

fs::path default_cache_folder() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg != '\0')
    return fs::path(xdg) / "endowire";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "endowire";
  return {};
}

}  // namespace endowire::io

#include "endowire/io/vessel_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/surface_file.hpp"
#include "endowire/io/volume_file.hpp"
#include "endowire/io/volume_surface.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/scale.hpp"

namespace endowire::io {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t max_field_bytes = std::uintmax_t{2} << 30;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

void read_volume_into(VesselMesh& mesh, const fs::path& path, std::optional<vessel::LengthUnit> unit,
                      const VolumeOptions& options) {
  mesh.content_hash = vessel_content_hash(path);
  Volume volume =
      read_volume(path, unit ? std::optional<double>(vessel::millimetres_in(*unit)) : std::nullopt);
  const double unit_mm = volume.unit_mm;
  VolumeReport report;
  const vessel::TriangleMesh surface = lumen_surface(std::move(volume), options, mesh.source, report);
  mesh.volume = report;
  // Held against what vessels are in the unit of the file, so that the message names the one to give.
  vessel::LengthUnit named = vessel::LengthUnit::millimetre;
  for (const vessel::LengthUnit other : {vessel::LengthUnit::centimetre, vessel::LengthUnit::metre})
    if (unit_mm == vessel::millimetres_in(other)) named = other;
  vessel::TriangleMesh in_file = surface;
  for (Eigen::Vector3d& v : in_file.vertices_mm) v /= vessel::millimetres_in(named);
  const vessel::UnitChoice choice = vessel::choose_unit(in_file, named, mesh.source);
  mesh.unit = named;
  mesh.unit_text = unit_mm == 0.001 ? "um" : std::string(vessel::name_of(named));
  mesh.unit_text += unit ? ", as declared" : ", from the image";
  mesh.unit_text += choice.likelier_text();
  mesh.repaired = vessel::repair(surface, mesh.source);
}

void read_surface_into(VesselMesh& mesh, const fs::path& path, std::optional<vessel::LengthUnit> unit) {
  const std::string bytes = read_file(path, max_mesh_bytes);
  mesh.content_hash = content_hash(bytes);
  vessel::TriangleMesh surface = parse_surface(bytes, path);
  const vessel::UnitChoice choice = vessel::choose_unit(surface, unit, mesh.source);
  mesh.unit = choice.unit;
  mesh.unit_inferred = choice.inferred;
  mesh.unit_text = choice.text();
  mesh.repaired =
      vessel::repair(vessel::in_millimetres(std::move(surface), choice.unit), mesh.source, choice.unit);
}

}  // namespace

VesselMesh read_vessel_file(const fs::path& path, std::optional<vessel::LengthUnit> unit,
                            const VolumeOptions& options) {
  VesselMesh mesh;
  mesh.source = one_line(path.string());
  if (names_a_volume(path)) {
    read_volume_into(mesh, path, unit, options);
  } else {
    read_surface_into(mesh, path, unit);
  }
  return mesh;
}

std::uint64_t vessel_content_hash(const fs::path& path) {
  std::error_code error;
  fs::path folder = path;
  if (names_a_dicom_file(path)) folder = path.parent_path().empty() ? "." : path.parent_path();
  if (!fs::is_directory(folder, error)) return content_hash(read_file(path, max_mesh_bytes));
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (std::error_code ignored; entry.is_regular_file(ignored) && entry.file_size(ignored) > 0)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  vessel::ContentHash hash;
  for (const fs::path& file : files) {
    const std::string bytes = read_file(file, max_mesh_bytes);
    hash.add_bytes(bytes_of(bytes).data(), bytes.size());
  }
  return hash.value();
}

bool uses_the_files_triangles(const VesselMesh& mesh) {
  const vessel::MeshReport& report = mesh.repaired.report;
  const bool is_stl = fs::path(mesh.source).extension() == ".stl";
  return is_stl && !report.wall_with_thickness && report.fins.count == 0 && report.membranes.count == 0 &&
         report.debris.count == 0;
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

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "endowire/io/lumen_image.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/vessel/generate.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/repair.hpp"

namespace endowire::io {

/// What the source of a vessel made in code begins with.
inline constexpr std::string_view generated_prefix = "generate:";

/// A vessel as read and understood, not yet prepared.
struct VesselMesh {
  std::string source;              ///< path as given, or `generate:name`, `generate:name seed 7`
  std::uint64_t content_hash = 0;  ///< of the file's bytes; of the triangles when generated
  vessel::LengthUnit unit = vessel::LengthUnit::millimetre;
  vessel::RepairedMesh repaired;
  std::optional<sim::Access> access;  ///< of a generated vessel: where a wire enters
  std::string unit_text = {};         ///< why that unit, for people; empty when generated
  bool unit_inferred = false;
  std::optional<VolumeReport> volume = {};  ///< of an image: how its lumen was found
};

inline constexpr std::uintmax_t max_mesh_bytes = std::uintmax_t{2} << 30;  // 43 million triangles

/// Reads a surface of at most max_mesh_bytes (parse_surface) or an image volume (read_volume), and repairs it.
/// @param unit     of the lengths in the file; none: of a surface inferred, of an image volume as its header says
/// @param options  of an image volume
/// @throws base::InputError one line that names the file and what is wrong with it.
[[nodiscard]] VesselMesh read_vessel_file(const std::filesystem::path& path,
                                          std::optional<vessel::LengthUnit> unit = {},
                                          const VolumeOptions& options = {});

/// Hash of what a vessel file holds; of a folder, or of the folder of a DICOM file, of all its files in the order of their
/// names.
[[nodiscard]] std::uint64_t vessel_content_hash(const std::filesystem::path& path);

/// Whether the triangles that are used are those of a file that the crossing judge can read: an STL of which nothing was
/// taken away.
[[nodiscard]] bool uses_the_files_triangles(const VesselMesh& mesh);

/// A vessel made in code.
/// @throws base::InputError one line that names the field, its value and what is allowed
[[nodiscard]] VesselMesh generate_vessel(const vessel::GenerateRequest& request);

/// Where a prepared field came from.
enum class FieldOrigin {
  prepared,             ///< prepared now, and kept in the cache
  prepared_not_cached,  ///< prepared now; the cache could not be written to, or there is none
  cached,               ///< read from the cache
};

struct PreparedField {
  std::shared_ptr<const vessel::MeshField> field;
  FieldOrigin origin = FieldOrigin::prepared_not_cached;
};

/// The distance field of a vessel, from the cache when it holds one of the same mesh and parameters. A
/// damaged or foreign file there is prepared anew and replaced; a cache that cannot be written to costs time,
/// never the run.
/// @param cache_folder  created when missing; empty: no cache
[[nodiscard]] PreparedField prepare_field(const VesselMesh& mesh, const std::filesystem::path& cache_folder,
                                          const vessel::FieldParameters& parameters = {});

/// Name of a prepared field within the cache.
[[nodiscard]] std::string field_cache_name(std::uint64_t key);

/// `$XDG_CACHE_HOME/endowire`, else `$HOME/.cache/endowire`; empty when neither is set.
[[nodiscard]] std::filesystem::path default_cache_folder();

}  // namespace endowire::io

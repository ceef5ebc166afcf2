#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "endowire/io/vessel_file.hpp"
#include "endowire/vessel/centreline.hpp"

namespace endowire::io {

/// The centrelines of a vessel, from the cache when it holds those of the same mesh and parameters; else computed,
/// and kept there. A damaged file is replaced; a cache that cannot be written to costs time, never the run.
/// @param cache_folder  created when missing; empty: no cache
[[nodiscard]] std::shared_ptr<const vessel::CentrelineTree> prepare_centrelines(
    const VesselMesh& mesh, const std::filesystem::path& cache_folder,
    const vessel::CentrelineParameters& parameters = {});

/// Name of prepared centrelines within the cache.
[[nodiscard]] std::string centreline_cache_name(std::uint64_t key);

/// Writes the tree as VTK PolyData (XML, raw appended binary, not compressed): one polyline a branch, in order.
///
/// Point data: `radius_mm`, `arc_mm` (along the branch), `from_root_mm`, `curvature_per_mm`, `branch` (index).
/// Cell data: `branch`, `parent` (-1: none), `ostium_arc_mm`, `length_mm`, `mean_radius_mm`.
/// Field data: `branch_name`, one string a branch.
/// @throws base::InputError when the file cannot be written, or this build has no VTK
void write_centrelines_vtp(const std::filesystem::path& path, const vessel::CentrelineTree& tree);

/// Branches, bifurcations and ends, without the points.
[[nodiscard]] nlohmann::ordered_json centrelines_json(const vessel::CentrelineTree& tree);

/// "opening 3", "cap" or "cut".
[[nodiscard]] std::string name_of(const vessel::CentrelineEnd& end);

}  // namespace endowire::io

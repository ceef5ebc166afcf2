#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "endowire/sim/scene.hpp"
#include "endowire/sim/snapshot.hpp"

namespace endowire::io {

/// True when this build can write VTK's files; without VTK `write_wire_vtp` throws base::InputError.
[[nodiscard]] bool vtp_available();

/// Writes one shape of the wire as VTK PolyData (XML, raw appended binary, not compressed).
///
/// One polyline, tip first. Point data: `arc_mm`, `radius_mm`, `curvature_per_mm`, `twist_rad`,
/// `wall_force_n_per_mm`, `friction_n_per_mm`, `wall_force_direction` (3). Field data, one value each:
/// `inserted_length_mm` (points with more arc lie in the sheath), `push_force_n`, `torque_n_mm`,
/// `access_position_mm` (3), `access_direction` (3).
/// Positions are written in double precision: a judge of crossings must not see our rounding.
/// @throws base::InputError when the file cannot be written.
void write_wire_vtp(const std::filesystem::path& path, const sim::Snapshot& snapshot,
                    const sim::Access& access);

/// One file of a time series.
struct SeriesEntry {
  double time_s = 0.0;
  std::string file;  ///< relative to the collection
};

/// Writes a ParaView collection (`wire.pvd`).
/// @throws base::InputError when the file cannot be written.
void write_pvd(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries);

}  // namespace endowire::io

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "endowire/io/scene_file.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/io/vessel_file.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/sim/target.hpp"
#include "endowire/vessel/vessel_ends.hpp"

namespace endowire::io {

/// The verdict of the independent judge of crossings; without a count, why there is none.
struct CrossingVerdict {
  std::optional<long long> crossings;
  std::string note;  ///< empty when there is a count
};

/// What belongs to this machine and this hour: everything else in a summary is the same from run to run.
struct MachineFacts {
  double peak_memory_mb = 0.0;
  double preparation_s = 0.0;
  bool field_from_cache = false;
  std::string isa;
};

/// Facts of a mesh as JSON: triangles, openings, pin holes, lumen diameters, what was repaired, and its
/// field.
[[nodiscard]] nlohmann::ordered_json vessel_json(const VesselMesh& mesh, const vessel::MeshField& field);

/// The ends of a vessel as JSON: number, open or closed, centre, direction, diameter, branch.
[[nodiscard]] nlohmann::ordered_json ends_json(const std::vector<vessel::VesselEnd>& ends);

/// The centrelines of a run's vessel, and the target on them if its scene has one.
struct RunGoal {
  const vessel::CentrelineTree& tree;
  std::optional<sim::Target> target;
};

/// `summary.json`, schema 1. A number that is not finite becomes null.
[[nodiscard]] std::string summary_json(const SceneFile& scene, const VesselMesh& mesh,
                                       const vessel::MeshField& field, const RunGoal& goal,
                                       const RunStatistics& run, const sim::Snapshot& last,
                                       std::uint64_t state_hash, const CrossingVerdict& verdict,
                                       const MachineFacts& machine);

}  // namespace endowire::io

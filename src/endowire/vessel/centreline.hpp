#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/repair.hpp"

namespace endowire::vessel {

struct CentrelineParameters {
  std::optional<Eigen::Vector3d> root_near_mm;  ///< the root is the end nearest to this; none: the widest end
  double cells_per_radius = 2.2;   ///< of the graph; below 1.5 narrow branches lose their connection [-]
  double points_per_radius = 3.0;  ///< of the result [-]
  /// Of the graph, about 80 MB: a vessel that asks for more is seen coarser. The femoral tree takes 60,000.
  std::size_t max_nodes = 500'000;
};

/// The centrelines of a vessel's lumen.
///
///   mesh ─▶ points inside, dense where the lumen is narrow (LumenGraph)
///        ─▶ ends, and least-cost paths to them that run along the ridge of the inscribed radius (TreeGrowth)
///        ─▶ vessels: at each bifurcation the straightest and widest branch goes on
///        ─▶ points moved to the ridge by the exact distance, smoothed without cutting corners (smooth_row)
///        ─▶ branches with ostia, radii, names
///
/// Accuracy   on a tube, cone, torus segment the ridge of the faceted wall, within 1 % of the radius of the
///            axis; on real vessels a mean of a few per cent of the radius from centrelines made otherwise
///            (tests/unit/vessel/centreline_*).
/// Domain     closed meshes (their closed ends are ends) and open ones; lumens wider than 0.2 mm of radius.
///            Where the lumen forms loops the tree is cut where the paths from both sides meet.
/// The result depends on the set of triangles, not on their order. Every segment between two points lies in
/// the lumen.
[[nodiscard]] CentrelineTree extract_centrelines(const RepairedMesh& repaired,
                                                 const CentrelineParameters& parameters = {});

/// Identifies mesh, parameters and version of the algorithm: the key of a cached tree.
[[nodiscard]] std::uint64_t centreline_key(const RepairedMesh& repaired,
                                           const CentrelineParameters& parameters = {});

}  // namespace endowire::vessel

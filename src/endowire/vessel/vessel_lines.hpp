#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/lumen_space.hpp"
#include "endowire/vessel/tree_growth.hpp"

namespace endowire::vessel {

/// One vessel from where it begins to its end, through all bifurcations at which it goes on.
struct VesselLine {
  std::int32_t parent = -1;              ///< line it leaves; -1: begins at a root
  std::size_t leaves_at = 0;             ///< point of the parent's path
  std::vector<Eigen::Vector3d> path_mm;  ///< raw, on the ridge; the first is the parent's
  int opening = 0;                       ///< at its end; 0: closed
  bool cut = false;                      ///< ends where a loop was cut
  std::int32_t rejoins = -1;             ///< the line that the lumen goes on in
};

/// Takes a grown tree apart into vessels, parents before children.
[[nodiscard]] std::vector<VesselLine> vessel_lines(const TreeGrowth& growth);

/// What stands at an end of a line that leads there.
enum class LineEnd : std::uint8_t {
  fixed,   ///< the point stays where it is: on the parent, in an opening, on the other side of a cut
  closed,  ///< the lumen is closed: the line goes straight on to the cap
};

/// A line in the middle of the lumen.
struct FittedLine {
  std::vector<CentrelinePoint> points;
  double ostium_arc_mm = 0.0;
  double start_cap_mm = 0.0;  ///< of arc at a closed root, towards the cap
  double end_cap_mm = 0.0;
};

/// Moves a raw path to the ridge and smooths it.
/// @param parent  the line it leaves: inside that one's lumen the ridge is not its own; null for a root
[[nodiscard]] FittedLine fit_line(const LumenSpace& lumen, const std::vector<Eigen::Vector3d>& path_mm,
                                  LineEnd start, LineEnd end, const FittedLine* parent,
                                  double points_per_radius);

}  // namespace endowire::vessel

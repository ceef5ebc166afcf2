#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "endowire/vessel/anatomy/lumen_shape.hpp"
#include "endowire/vessel/anatomy/remesh.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel::anatomy {

/// One vessel of an anatomy.
struct Branch {
  std::string name;
  Axis axis;
  int parent = -1;                ///< index of the vessel that it leaves; -1 for the first
  double parent_arc_mm = 0.0;     ///< where on the parent's axis its own begins
  double ostium_arc_mm = 0.0;     ///< where it leaves the parent's lumen, on its own axis
  bool shares_beginning = false;  ///< its axis is the parent's before it begins, and so is its calibre there
  RadiusProfile calibre;
  Fillet fillet;  ///< with the parent
};

/// An end of a vessel: an opening of the mesh.
struct VesselEnd {
  std::string name;
  std::size_t branch = 0;
  bool at_begin = false;  ///< of the branch's axis
};

/// A place on a vessel's axis.
struct NamedPlace {
  std::string name;
  std::size_t branch = 0;
  double arc_mm = 0.0;
};

/// What an anatomy is before it is meshed: vessels, where they meet, where they end, what is where.
struct Plan {
  std::deque<Branch> branches;  ///< a deque: references to axes outlive the branches added later
  std::vector<VesselEnd> ends;
  std::vector<NamedPlace> landmarks;
  NamedPlace access;              ///< where a wire enters
  bool access_backward = false;   ///< it goes against the direction of the axis
  double route_end_arc_mm = 0.0;  ///< on the access's axis: how far the main route goes

  /// The index of a branch.
  [[nodiscard]] std::size_t index_of(const std::string& name) const;
};

/// The lumen of a plan.
/// @param beyond_mm  how far vessels go on straight behind their ends
[[nodiscard]] LumenShape shape_of(const Plan& plan, double beyond_mm = 0.0);

/// The circles that the vessels of a plan end with, in the order of its ends.
[[nodiscard]] std::vector<Rim> rims_of(const Plan& plan);

/// Why a plan is no vessel, as the end of a message; empty when it is one. Either two vessels come too near each other
/// though neither leaves the other, `leave 0.4 mm between A and B; must be >= 1.5 mm`, or one is too wide for a bend of
/// its axis, where the wall would fold: `make A 110 mm wide in a bend of 34 mm radius; must be <= 61 mm`.
[[nodiscard]] std::string fault_of(const Plan& plan);

/// The surface of a plan's lumen: every facet faces outward, and there are no handles.
/// @param open_ends  openings at the vessels' ends; else half balls behind them, and the mesh is closed
/// @return           nothing where no grid shows such a surface: vessels touch where `fault_of` does not look, as one
///                   that is its own neighbour, or the wall turns within less than a facet
[[nodiscard]] std::optional<TriangleMesh> mesh_of(const Plan& plan, bool open_ends,
                                                  const EdgeSizes& sizes = {});

}  // namespace endowire::vessel::anatomy

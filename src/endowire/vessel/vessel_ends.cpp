#include "endowire/vessel/vessel_ends.hpp"

#include <algorithm>

namespace endowire::vessel {
namespace {

/// The centreline a radius before an end, and the way into the vessel there.
struct Before {
  Eigen::Vector3d place_mm;
  Eigen::Vector3d inward;
};

Before before(const CentrelineTree& tree, const CentrelineEnd& end) {
  const CentrelineBranch& branch = tree.branches()[static_cast<std::size_t>(end.branch)];
  const double back_mm = std::min(end.radius_mm, 0.5 * branch.length_mm);
  const CentrelineState state = tree.state_at({end.branch, end.root ? back_mm : branch.length_mm - back_mm});
  return {state.position_mm, end.root ? state.tangent : Eigen::Vector3d(-state.tangent)};
}

}  // namespace

std::vector<VesselEnd> vessel_ends(const RepairedMesh& repaired, const CentrelineTree& tree) {
  std::vector<VesselEnd> ends;
  for (const Opening& opening : repaired.openings) {
    VesselEnd& end = ends.emplace_back();
    end.number = opening.number;
    end.open = true;
    end.centre_mm = end.access_mm = end.inside_mm = opening.centre_mm;
    end.direction = opening.direction;
    end.inward = -opening.direction;
    end.diameter_mm = opening.diameter_mm;
    for (const CentrelineEnd& known : tree.ends()) {
      if (known.kind != CentrelineEndKind::opening || known.opening != opening.number) continue;
      end.branch = tree.branches()[static_cast<std::size_t>(known.branch)].name;
      end.inside_mm = before(tree, known).place_mm;
    }
  }
  for (const CentrelineEnd& known : tree.ends()) {
    if (known.kind != CentrelineEndKind::cap) continue;
    VesselEnd& end = ends.emplace_back();
    end.number = static_cast<int>(ends.size());
    end.centre_mm = known.position_mm;
    end.direction = known.direction;
    end.diameter_mm = 2.0 * known.radius_mm;
    end.branch = tree.branches()[static_cast<std::size_t>(known.branch)].name;
    const Before inside = before(tree, known);
    end.access_mm = end.inside_mm = inside.place_mm;
    end.inward = inside.inward;
  }
  return ends;
}

}  // namespace endowire::vessel

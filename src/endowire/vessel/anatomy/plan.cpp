#include "endowire/vessel/anatomy/plan.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/vessel/anatomy/contour.hpp"
#include "endowire/vessel/anatomy/cut.hpp"
#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

/// The distance to the wall is needed within a cell of the first mesh and within a fillet.
constexpr double reach_mm = 6.0;
/// Coarsest and finest spacing of the first mesh. `remesh` brings it to size, so it only has to see every vessel:
/// a tube needs 1.2 cells across.
constexpr double coarsest_mm = 2.0;
constexpr double finest_mm = 0.4;
constexpr double cells_per_radius = 1.25;
constexpr double cells_per_carina_radius = 0.8;
/// A first mesh that is too coarse for one carina in some hundreds folds over it, or bridges thin tissue; then it is made
/// finer, so often.
constexpr int attempts = 4;
constexpr double finer = 0.8;
constexpr double least_outward = 0.5;  // cosine between a facet and the wall: 60°
/// How far vessels go on behind an open end, so that the cut meets a tube and not the half ball that closes it.
constexpr double overshoot_mm = 3.0;
/// Tissue between vessels that do not meet: two walls, and room for a triangle.
constexpr double least_tissue_mm = 1.5;
constexpr double bridge_margin_mm = 0.4;
constexpr double crowding_step_mm = 2.0;
/// Radius of the lumen over that of a bend: at one the wall on its inner side has no length, and beyond it folds.
constexpr double widest_over_bend = 0.9;

double spacing_mm(const Plan& plan) {
  double spacing = coarsest_mm;
  for (const Branch& branch : plan.branches) {
    for (const Axis::Station& station : branch.axis.stations())
      spacing = std::min(spacing, station.radius_mm / cells_per_radius);
    if (branch.parent >= 0)
      spacing = std::min(spacing, branch.fillet.carina_radius_mm() / cells_per_carina_radius);
  }
  return std::max(spacing, finest_mm);
}

/// A closed mesh is a sphere when V − E + F = 2, and E = 3/2 F. Vessels that touch give it handles.
bool is_sphere(const TriangleMesh& closed) {
  return closed.vertices_mm.size() == closed.triangles.size() / 2 + 2;
}

bool faces_outward(const TriangleMesh& mesh, const LumenShape& shape) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d& a = mesh.corner(t, 0);
    const Vector3d& b = mesh.corner(t, 1);
    const Vector3d& c = mesh.corner(t, 2);
    const Vector3d area = cross(b - a, c - a);
    const double outward = dot(area, shape.at((a + b + c) / 3.0).gradient);
    if (!(outward >= least_outward * length(area))) return false;  // also where a vertex is not a number
  }
  return true;
}

/// Tissue between two vessels outside those that they leave, by points every `crowding_step_mm` along them.
double tissue_between_mm(const Branch& a, const Branch& b) {
  double least = HUGE_VAL;
  for (double s = a.ostium_arc_mm; s <= a.axis.length_mm(); s += crowding_step_mm) {
    const AxisPoint p = a.axis.at(s);
    for (double t = b.ostium_arc_mm; t <= b.axis.length_mm();) {
      const AxisPoint q = b.axis.at(t);
      const double tissue = length(p.position_mm - q.position_mm) - p.radius_mm - q.radius_mm;
      least = std::min(least, tissue);
      t += std::max(crowding_step_mm, 0.5 * (tissue - least));  // far away it cannot become near at once
    }
  }
  return least;
}

std::string crowding_of(const Plan& plan) {
  for (std::size_t b = 0; b < plan.branches.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      const Branch& one = plan.branches[a];
      const Branch& other = plan.branches[b];
      if (other.parent == static_cast<int>(a)) continue;
      // Thinner tissue would be bridged by the fillet of the one that comes later.
      const double least = std::max(least_tissue_mm, other.fillet.bridged_mm() + bridge_margin_mm);
      const double tissue = tissue_between_mm(one, other);
      if (tissue < least)
        return "leave " + text_of(0.01 * std::floor(100.0 * tissue)) + " mm between " + one.name + " and " +
               other.name + "; must be >= " + text_of(0.1 * std::ceil(10.0 * least)) + " mm";
    }
  return {};
}

std::string folding_of(const Plan& plan) {
  for (const Branch& branch : plan.branches)
    for (const Axis::Station& station : branch.axis.stations()) {
      const double curvature = length(station.curvature_per_mm);
      if (curvature * station.radius_mm > widest_over_bend)
        return "make " + branch.name + " " + text_of(0.1 * std::round(20.0 * station.radius_mm)) +
               " mm wide in a bend of " + text_of(0.1 * std::round(10.0 / curvature)) +
               " mm radius; must be <= " + text_of(0.1 * std::floor(20.0 * widest_over_bend / curvature)) +
               " mm";
    }
  return {};
}

}  // namespace

std::size_t Plan::index_of(const std::string& name) const {
  std::size_t i = 0;
  while (i < branches.size() && branches[i].name != name) ++i;
  ENDOWIRE_EXPECTS(i < branches.size(), "a plan is asked for a branch of its own");
  return i;
}

LumenShape shape_of(const Plan& plan, double beyond_mm) {
  std::vector<Tube> tubes;
  for (const Branch& branch : plan.branches) tubes.push_back({branch.axis, branch.fillet, 0.0, 0.0});
  for (const VesselEnd& end : plan.ends)
    (end.at_begin ? tubes[end.branch].before_mm : tubes[end.branch].beyond_mm) = beyond_mm;
  return {std::move(tubes), reach_mm};
}

std::vector<Rim> rims_of(const Plan& plan) {
  std::vector<Rim> rims;
  for (const VesselEnd& end : plan.ends) {
    const Axis& axis = plan.branches[end.branch].axis;
    const AxisPoint at = axis.at(end.at_begin ? 0.0 : axis.length_mm());
    rims.push_back({at.position_mm, end.at_begin ? Vector3d(-at.tangent) : at.tangent, at.radius_mm});
  }
  return rims;
}

std::string fault_of(const Plan& plan) {
  const std::string crowding = crowding_of(plan);
  return crowding.empty() ? folding_of(plan) : crowding;
}

std::optional<TriangleMesh> mesh_of(const Plan& plan, bool open_ends, const EdgeSizes& sizes) {
  const LumenShape shape = shape_of(plan, open_ends ? overshoot_mm : 0.0);
  const std::vector<Rim> rims = open_ends ? rims_of(plan) : std::vector<Rim>{};
  double spacing = spacing_mm(plan);
  for (int i = 0; i < attempts; ++i, spacing *= finer) {
    const TriangleMesh first = contour(shape, spacing);
    if (!is_sphere(first)) continue;
    TriangleMesh mesh = remesh(open_ends ? cut_at(first, rims, overshoot_mm) : first, shape, rims, sizes);
    if (faces_outward(mesh, shape)) return mesh;
  }
  return std::nullopt;
}

}  // namespace endowire::vessel::anatomy

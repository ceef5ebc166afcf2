#include "endowire/vessel/repair.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/error.hpp"
#include "endowire/vessel/mesh_text.hpp"
#include "endowire/vessel/mesh_topology.hpp"
#include "endowire/vessel/orientation.hpp"
#include "endowire/vessel/scale.hpp"
#include "endowire/vessel/self_intersection.hpp"
#include "endowire/vessel/sheets.hpp"
#include "endowire/vessel/walls.hpp"
#include "endowire/vessel/weld.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// A piece of surface below this part of the largest one's area is debris: floating triangles, bubbles, calcifications.
/// The smallest vessel beside an aorta, a millimetre wide and ten long, has 4e-4 of its area.
constexpr double debris_part = 3e-4;

void check_extent(double extent_mm, const std::string& file, LengthUnit unit) {
  if (extent_mm >= min_extent_mm && extent_mm <= max_extent_mm) return;
  std::string message = file + ": extent is " + rounded(extent_mm) + " mm; must be " +
                        rounded(min_extent_mm) + " … " + rounded(max_extent_mm) + " mm";
  for (LengthUnit other : {LengthUnit::millimetre, LengthUnit::metre, LengthUnit::centimetre}) {
    const double guess = extent_mm / millimetres_in(unit) * millimetres_in(other);
    if (other == unit || guess < 10.0 * min_extent_mm || guess > max_extent_mm) continue;
    const char* saved = other == LengthUnit::metre        ? "metres"
                        : other == LengthUnit::centimetre ? "centimetres"
                                                          : "millimetres";
    message +=
        std::string("; was it saved in ") + saved + "? then unit = \"" + std::string(name_of(other)) + "\"";
    break;
  }
  throw base::InputError(message);
}

void drop_debris(TriangleMesh& mesh, MeshReport& report) {
  const Pieces pieces = pieces_of(mesh);
  report.components_in_file = pieces.count;
  if (pieces.count < 2) return;
  const auto piece = [&](std::size_t t) { return static_cast<std::size_t>(pieces.of_triangle[t]); };
  std::vector<double> area(pieces.count, 0.0);
  std::vector<Vector3d> place(pieces.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area[piece(t)] += mesh.area_normal(t).norm();
    place[piece(t)] = mesh.corner(t, 0);
  }
  const double least = debris_part * *std::max_element(area.begin(), area.end());
  for (std::size_t c = 0; c < pieces.count; ++c)
    if (area[c] < least) report.debris.add(place[c]);
  if (report.debris.count > 0) keep_triangles(mesh, [&](std::size_t t) { return area[piece(t)] >= least; });
}

std::size_t slivers(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double longest2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest2 = std::max(longest2, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).squaredNorm());
    if (mesh.area_normal(t).norm() <= 1e-9 * longest2) ++count;
  }
  return count;
}

}  // namespace

RepairedMesh repair(const TriangleMesh& soup, const std::string& file_label, LengthUnit unit) {
  if (soup.triangles.empty()) throw base::InputError(file_label + ": triangle count is 0; must be > 0");
  const double extent_mm = bounds_mm(soup).diagonal().norm();
  check_extent(extent_mm, file_label, unit);
  RepairedMesh repaired;
  TriangleMesh& mesh = repaired.mesh;
  MeshReport& report = repaired.report;
  report.triangles_in_file = soup.triangles.size();
  mesh = merge_points(soup, 1e-6 * extent_mm);
  report.merged_points = 3 * soup.triangles.size() - mesh.vertices_mm.size();
  drop_bad_triangles(mesh, report);
  if (mesh.triangles.empty())
    throw base::InputError(file_label + ": all " + std::to_string(report.triangles_in_file) +
                           " triangles are degenerate; at least one must have an area");
  drop_sheets(mesh, report);
  drop_debris(mesh, report);
  orient_patches(mesh, report, file_label);
  const Pieces pieces = pieces_of(mesh);
  const std::vector<int> depths = orient_pieces(mesh, pieces, report);
  const bool wall = take_lumen_of_wall(mesh, pieces, depths, report, file_label);
  report.components = wall ? pieces_of(mesh).count : pieces.count;
  for (auto& t : mesh.triangles) rotate_smallest_first(t);
  report.sliver_triangles = slivers(mesh);
  report.self_intersections = self_intersections(mesh);
  Borders borders = find_borders(mesh);
  repaired.openings = std::move(borders.openings);
  repaired.pin_holes = std::move(borders.pin_holes);
  report.triangles = mesh.triangles.size();
  report.vertices = mesh.vertices_mm.size();
  report.bounds_mm = bounds_mm(mesh);
  report.area_mm2 = area_mm2(mesh);
  report.volume_mm3 = std::abs(signed_volume_mm3(mesh));
  return repaired;
}

}  // namespace endowire::vessel

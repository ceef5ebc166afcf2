#include "endowire/vessel/sheets.hpp"

#include <cmath>
#include <vector>

#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/mesh_topology.hpp"
#include "endowire/vessel/orientation.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

/// A fin with more than this part of the area is no flaw of the mesh.
constexpr double max_fin_part = 0.02;
/// A flap that lies against the wall within this distance stays: its border is closed as a pin hole is [mm]. Half the
/// width of a wire; flaps of remeshed vessels lie within 0.3 mm.
constexpr double max_flap_mm = 0.5;
/// Dropping a sheet can lay bare another one, or its borders.
constexpr int max_rounds = 8;
/// The largest of them are looked at as membranes: each asks for a pass over the mesh.
constexpr std::size_t max_membranes_tried = 32;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// A part of the mesh that is connected over edges of two triangles.
struct Sheet {
  double area_mm2 = 0.0;
  Vector3d middle_mm = Vector3d::Zero();  ///< of one of its triangles, the largest
  double largest_mm2 = 0.0;
  std::size_t free_edges = 0;    ///< of one triangle
  std::size_t shared_edges = 0;  ///< of three or more
  bool only_threes = true;       ///< none of more than three: the rest is a surface without it
};

struct Sheets {
  std::vector<Index> of_triangle;
  std::vector<Sheet> all;
  bool any_shared = false;
};

Sheets sheets_of(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  UnionFind joined(mesh.triangles.size());
  for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 2) joined.join(first[0].triangle, first[1].triangle);
  });
  Sheets sheets;
  std::size_t count = 0;
  sheets.of_triangle = joined.groups(count);
  sheets.all.resize(count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Sheet& sheet = sheets.all[at(sheets.of_triangle[t])];
    const double area = 0.5 * mesh.area_normal(t).norm();
    sheet.area_mm2 += area;
    if (area < sheet.largest_mm2) continue;
    sheet.largest_mm2 = area;
    sheet.middle_mm = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
  }
  for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
    const std::ptrdiff_t degree = last - first;
    if (degree == 2) return;
    sheets.any_shared = sheets.any_shared || degree > 2;
    for (const HalfEdge* e = first; e < last; ++e) {
      Sheet& sheet = sheets.all[at(sheets.of_triangle[at(e->triangle)])];
      ++(degree == 1 ? sheet.free_edges : sheet.shared_edges);
      sheet.only_threes = sheet.only_threes && degree <= 3;
    }
  });
  return sheets;
}

double total_area(const Sheets& sheets) {
  double area = 0.0;
  for (const Sheet& sheet : sheets.all) area += sheet.area_mm2;
  return area;
}

/// Whether the mesh without a sheet encloses it.
bool encloses(const TriangleMesh& mesh, const Sheets& sheets, std::size_t sheet) {
  TriangleMesh rest = mesh;
  keep_triangles(rest, [&](std::size_t t) { return at(sheets.of_triangle[t]) != sheet; });
  if (rest.triangles.empty() || !boundary_loops(rest).empty()) return false;
  MeshReport unsaid;
  orient_patches(rest, unsaid, "");
  return std::abs(winding_number(rest, sheets.all[sheet].middle_mm)) > 0.5;
}

std::vector<bool> fins(const TriangleMesh& mesh, const Sheets& sheets) {
  const double limit = max_fin_part * total_area(sheets);
  std::vector<bool> hangs(sheets.all.size());
  for (std::size_t s = 0; s < sheets.all.size(); ++s) {
    const Sheet& sheet = sheets.all[s];
    hangs[s] = sheet.shared_edges > 0 && sheet.free_edges > 0 && sheet.area_mm2 < limit;
  }
  std::vector<bool> drop(sheets.all.size(), false);
  TriangleMesh wall = mesh;
  keep_triangles(wall, [&](std::size_t t) { return !hangs[at(sheets.of_triangle[t])]; });
  if (wall.triangles.empty()) return drop;
  const TriangleBvh bvh(wall);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t sheet = at(sheets.of_triangle[t]);
    if (!hangs[sheet] || drop[sheet]) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (bvh.nearest(mesh.corner(t, k), max_flap_mm).triangle < 0) drop[sheet] = true;
  }
  return drop;
}

/// At most one: what is left after it is another mesh.
std::vector<bool> membrane(const TriangleMesh& mesh, const Sheets& sheets) {
  std::vector<bool> drop(sheets.all.size(), false);
  std::size_t tried = 0;
  for (std::size_t s = 0; s < sheets.all.size() && tried < max_membranes_tried; ++s) {
    const Sheet& sheet = sheets.all[s];
    if (sheet.shared_edges == 0 || sheet.free_edges > 0 || !sheet.only_threes) continue;
    ++tried;
    drop[s] = encloses(mesh, sheets, s);
    if (drop[s]) break;
  }
  return drop;
}

/// @return  false when there was nothing to drop
bool drop_marked(TriangleMesh& mesh, const Sheets& sheets, const std::vector<bool>& drop,
                 FlawPlaces& places) {
  bool any = false;
  for (std::size_t s = 0; s < drop.size(); ++s) {
    if (!drop[s]) continue;
    any = true;
    places.add(sheets.all[s].middle_mm);
  }
  if (any) keep_triangles(mesh, [&](std::size_t t) { return !drop[at(sheets.of_triangle[t])]; });
  return any;
}

}  // namespace

void drop_sheets(TriangleMesh& mesh, MeshReport& report) {
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first > 2)
      report.non_manifold_edges.add(0.5 *
                                    (mesh.vertices_mm[at(first->low)] + mesh.vertices_mm[at(first->high)]));
  });
  if (report.non_manifold_edges.count == 0) return;
  for (int round = 0; round < max_rounds; ++round) {
    const Sheets sheets = sheets_of(mesh);
    if (!sheets.any_shared) return;
    if (drop_marked(mesh, sheets, fins(mesh, sheets), report.fins)) continue;
    if (!drop_marked(mesh, sheets, membrane(mesh, sheets), report.membranes)) return;
  }
}

}  // namespace endowire::vessel

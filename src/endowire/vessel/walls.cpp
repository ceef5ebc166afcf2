#include "endowire/vessel/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/end_cut.hpp"
#include "endowire/vessel/mesh_text.hpp"
#include "endowire/vessel/mesh_topology.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr int rays = 32;
/// A triangle sees walls before it in this part of its rays when it bounds the lumen of a wall. Inside a tube all of them
/// but at its ends; on the outer surface at most half, in the angle between two vessels.
constexpr double min_enclosed = 0.65;
/// What a mesh has to show to be a wall, as parts of its area, by this many samples: an inner surface takes a third of it
/// and more; behind it lies the outer one. In a dense tree of lumens, where triangles see others all round as well, the
/// far side of the same lumen lies behind them.
constexpr std::size_t samples = 2000;
constexpr double min_inner_part = 0.12;
constexpr double min_outer_behind = 0.7;
/// Edges that part surfaces: rims meet walls at right angles, facets of a coarse tube at 45 degrees.
constexpr double crease_rad = 60.0 * std::numbers::pi / 180.0;
/// A part between sharp edges of which the smaller side has more than this much of the area is taken apart.
constexpr double max_mixed = 0.1;
constexpr std::size_t samples_of_part = 1000;
/// Pieces below this part of the largest volume are no lumen of their own.
constexpr double min_lumen_volume = 0.01;
/// Rags of an inner surface below this part of its area are dropped.
constexpr double min_rag = 0.02;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

Vector3d centroid(const TriangleMesh& mesh, std::size_t t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
}

/// Directions over the half ball around z, the denser the closer to it (a cosine law): Fibonacci's lattice.
std::array<Vector3d, rays> half_ball() {
  std::array<Vector3d, rays> directions;
  for (int k = 0; k < rays; ++k) {
    const double radius2 = (k + 0.5) / rays;
    const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
    directions[static_cast<std::size_t>(k)] = {
        std::sqrt(radius2) * std::cos(angle), std::sqrt(radius2) * std::sin(angle), std::sqrt(1.0 - radius2)};
  }
  return directions;
}

/// What lies before and behind triangles that face out of the solid.
class Sight {
 public:
  explicit Sight(const TriangleMesh& mesh)
      : mesh_(mesh), bvh_(mesh), away_mm_(1e-7 * bounds_mm(mesh).diagonal().norm()) {}

  /// Whether walls stand before a triangle as they do in a lumen.
  [[nodiscard]] bool enclosed(std::size_t t) const {
    const Vector3d normal = mesh_.area_normal(t).stableNormalized();
    if (normal.isZero()) return false;
    const Vector3d side = normal.unitOrthogonal();
    const Vector3d up = normal.cross(side);
    const Vector3d from = centroid(mesh_, t);
    int met = 0;
    for (const Vector3d& d : directions_) {
      const Vector3d direction = d.x() * side + d.y() * up + d.z() * normal;
      if (bvh_.cast(from, direction, away_mm_, std::numeric_limits<double>::infinity()).triangle >= 0) ++met;
    }
    return met >= min_enclosed * rays;
  }

  /// The triangle at the other side of the solid; -1: none.
  [[nodiscard]] Index behind(std::size_t t) const {
    const Vector3d normal = mesh_.area_normal(t).stableNormalized();
    if (normal.isZero()) return -1;
    return bvh_.cast(centroid(mesh_, t), -normal, away_mm_, std::numeric_limits<double>::infinity()).triangle;
  }

 private:
  const TriangleMesh& mesh_;
  TriangleBvh bvh_;
  double away_mm_;
  std::array<Vector3d, rays> directions_ = half_ball();
};

bool looks_like_a_wall(const TriangleMesh& mesh, const Sight& sight) {
  // Sampled by area, at equal steps.
  double total = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) total += mesh.area_normal(t).norm();
  const double step = total / static_cast<double>(samples);
  double sum = 0.0;
  double next = 0.5 * step;
  int seen = 0;
  int inner = 0;
  int outer_behind = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += mesh.area_normal(t).norm();
    for (; next < sum; next += step) {
      ++seen;
      if (!sight.enclosed(t)) continue;
      ++inner;
      const Index other = sight.behind(t);
      if (other >= 0 && !sight.enclosed(at(other))) ++outer_behind;
    }
  }
  return inner >= min_inner_part * seen && outer_behind >= min_outer_behind * inner;
}

/// Parts of the mesh between sharp edges.
std::vector<Index> parts_between_creases(const TriangleMesh& mesh, std::size_t& count) {
  UnionFind joined(mesh.triangles.size());
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 2) return;
    const Vector3d a = mesh.area_normal(at(first[0].triangle));
    const Vector3d b = mesh.area_normal(at(first[1].triangle));
    if (std::atan2(a.cross(b).norm(), a.dot(b)) < crease_rad)
      joined.join(first[0].triangle, first[1].triangle);
  });
  return joined.groups(count);
}

/// Which triangles bound the lumen. A part that is all of one side is told by some of its triangles.
std::vector<bool> inner_surface(const TriangleMesh& mesh, const Sight& sight) {
  std::size_t count = 0;
  const std::vector<Index> part_of = parts_between_creases(mesh, count);
  std::vector<std::vector<Index>> parts(count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    parts[at(part_of[t])].push_back(static_cast<Index>(t));
  std::vector<bool> result(mesh.triangles.size());
  for (const std::vector<Index>& part : parts) {
    const std::size_t step = part.size() / samples_of_part + 1;
    double area = 0.0;
    double inner = 0.0;
    for (std::size_t k = 0; k < part.size(); k += step) {
      const double a = mesh.area_normal(at(part[k])).norm();
      area += a;
      if (sight.enclosed(at(part[k]))) inner += a;
    }
    const bool mixed = std::min(inner, area - inner) > max_mixed * area;
    for (Index t : part) result[at(t)] = mixed ? sight.enclosed(at(t)) : inner > 0.5 * area;
  }
  return result;
}

/// Rags that came loose are dropped.
void drop_rags(TriangleMesh& mesh, const std::string& file_label) {
  const Pieces pieces = pieces_of(mesh);
  std::vector<double> area(pieces.count, 0.0);
  double total = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area[at(pieces.of_triangle[t])] += mesh.area_normal(t).norm();
    total += mesh.area_normal(t).norm();
  }
  if (total > 0.0 && *std::max_element(area.begin(), area.end()) < 0.5 * total)
    throw base::InputError(file_label + ": a vessel wall with a thickness whose inner surface falls into " +
                           std::to_string(pieces.count) + " shreds near " + place_text(centroid(mesh, 0)) +
                           "; must be one that can be told from the outer, or the surface of a lumen");
  keep_triangles(mesh, [&](std::size_t t) { return area[at(pieces.of_triangle[t])] >= min_rag * total; });
}

/// The pieces that lie in another one and are no debris; none when there are none.
std::vector<bool> enclosed_pieces(const TriangleMesh& mesh, const Pieces& pieces,
                                  const std::vector<int>& depths) {
  std::vector<TriangleMesh> parts(pieces.count);
  for (TriangleMesh& part : parts) part.vertices_mm = mesh.vertices_mm;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    parts[at(pieces.of_triangle[t])].triangles.push_back(mesh.triangles[t]);
  std::vector<double> volume(pieces.count);
  for (std::size_t c = 0; c < pieces.count; ++c) volume[c] = std::abs(signed_volume_mm3(parts[c]));
  const double largest = *std::max_element(volume.begin(), volume.end());
  std::vector<bool> inner(pieces.count, false);
  for (std::size_t c = 0; c < pieces.count; ++c)
    inner[c] = depths[c] % 2 == 1 && volume[c] > min_lumen_volume * largest;
  return inner;
}

}  // namespace

bool take_lumen_of_wall(TriangleMesh& mesh, const Pieces& pieces, const std::vector<int>& depths,
                        MeshReport& report, const std::string& file_label) {
  const std::size_t before = mesh.triangles.size();
  bool nested = std::any_of(depths.begin(), depths.end(), [](int depth) { return depth > 0; });
  if (nested) {
    const std::vector<bool> inner = enclosed_pieces(mesh, pieces, depths);
    nested = std::find(inner.begin(), inner.end(), true) != inner.end();
    if (nested) keep_triangles(mesh, [&](std::size_t t) { return inner[at(pieces.of_triangle[t])]; });
  }
  if (!nested) {
    const Sight sight(mesh);
    if (!looks_like_a_wall(mesh, sight)) return false;
    const std::vector<bool> inner = inner_surface(mesh, sight);
    TriangleMesh lumen = mesh;
    keep_triangles(lumen, [&](std::size_t t) { return inner[t]; });
    drop_rags(lumen, file_label);
    mesh = std::move(lumen);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) flip(mesh, t);
  report.wall_with_thickness = true;
  report.wall_triangles = before - mesh.triangles.size();
  report.cut_ends = cut_ragged_ends(mesh);
  return true;
}

}  // namespace endowire::vessel

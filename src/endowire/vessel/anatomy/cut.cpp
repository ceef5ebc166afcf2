#include "endowire/vessel/anatomy/cut.hpp"

#include <array>
#include <cmath>
#include <map>

#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

/// A vertex nearer to the plane than this is moved into it: no edge of the cut is much shorter than the others.
constexpr double snap_mm = 0.2;
/// Around a rim's axis and its radius, where vertices count as those of its vessel.
constexpr double around_rim = 1.2;

/// Which vertices lie beyond a rim's plane, and how far; negative before every plane.
std::vector<double> beyond_planes(TriangleMesh& mesh, const std::vector<Rim>& rims, double beyond_mm) {
  std::vector<double> side(mesh.vertices_mm.size(), -1.0);
  for (const Rim& rim : rims)
    for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
      const Vector3d away = mesh.vertices_mm[v] - rim.centre_mm;
      const double along = dot(away, rim.direction);
      if (length(away - along * rim.direction) > around_rim * rim.radius_mm ||
          std::abs(along) > around_rim * rim.radius_mm + beyond_mm)
        continue;
      side[v] = along;
      if (std::abs(along) > snap_mm) continue;
      mesh.vertices_mm[v] -= along * rim.direction;
      side[v] = 0.0;
    }
  return side;
}

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<Index> number(mesh.vertices_mm.size(), -1);
  for (const auto& t : mesh.triangles)
    for (const Index v : t) number[static_cast<std::size_t>(v)] = 0;
  std::vector<Vector3d> used;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<Index>(used.size());
      used.push_back(mesh.vertices_mm[v]);
    }
  for (auto& t : mesh.triangles)
    for (Index& v : t) v = number[static_cast<std::size_t>(v)];
  mesh.vertices_mm = std::move(used);
}

}  // namespace

TriangleMesh cut_at(const TriangleMesh& mesh, const std::vector<Rim>& rims, double beyond_mm) {
  TriangleMesh cut;
  cut.vertices_mm = mesh.vertices_mm;
  const std::vector<double> side_of = beyond_planes(cut, rims, beyond_mm);
  const auto side = [&](Index v) { return side_of[static_cast<std::size_t>(v)]; };
  std::map<std::pair<Index, Index>, Index> crossings;
  const auto crossing = [&](Index a, Index b) {
    const Index in = side(a) < 0.0 ? a : b;
    const Index out = in == a ? b : a;
    const auto [entry, fresh] = crossings.try_emplace({in, out}, static_cast<Index>(cut.vertices_mm.size()));
    if (fresh) {
      const Vector3d p = cut.vertices_mm[static_cast<std::size_t>(in)];
      const Vector3d q = cut.vertices_mm[static_cast<std::size_t>(out)];
      cut.vertices_mm.emplace_back(p + side(in) / (side(in) - side(out)) * (q - p));
    }
    return entry->second;
  };
  for (const auto& t : mesh.triangles) {
    if (!(side(t[0]) < 0.0 || side(t[1]) < 0.0 || side(t[2]) < 0.0)) continue;
    std::array<Index, 4> kept{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if (side(a) <= 0.0) kept[count++] = a;
      if (side(a) * side(b) < 0.0) kept[count++] = crossing(a, b);
    }
    for (std::size_t k = 2; k < count; ++k) cut.triangles.push_back({kept[0], kept[k - 1], kept[k]});
  }
  drop_unused_vertices(cut);
  return cut;
}

}  // namespace endowire::vessel::anatomy

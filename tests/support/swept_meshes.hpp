#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "support/generated_meshes.hpp"

namespace endowire::test {

/// A circle swept along a curve, its vertices on the circles; closed by flat caps or open.
///
/// @param curve    points of the axis; the circles stand across it
/// @param radius   at each of them [mm]
inline TriangleMesh swept_tube(const std::vector<Eigen::Vector3d>& curve, const std::vector<double>& radius,
                               std::size_t around, bool closed) {
  using Eigen::Vector3d;
  TriangleMesh mesh;
  const std::size_t rings = curve.size();
  Vector3d side = (curve[1] - curve[0]).unitOrthogonal();
  for (std::size_t i = 0; i < rings; ++i) {
    const Vector3d along = (curve[std::min(i + 1, rings - 1)] - curve[i == 0 ? 0 : i - 1]).normalized();
    side = (side - side.dot(along) * along).normalized();
    for (std::size_t j = 0; j < around; ++j) {
      const double a = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
      mesh.vertices_mm.emplace_back(curve[i] +
                                    radius[i] * (std::cos(a) * side + std::sin(a) * along.cross(side)));
    }
  }
  add_rings(mesh, rings, around, false);
  if (!closed) return mesh;
  const auto first = static_cast<std::int32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.push_back(curve.front());
  mesh.vertices_mm.push_back(curve.back());
  const auto last = static_cast<std::int32_t>((rings - 1) * around);
  for (std::size_t j = 0; j < around; ++j) {
    const auto a = static_cast<std::int32_t>(j);
    const auto b = static_cast<std::int32_t>((j + 1) % around);
    mesh.triangles.push_back({b, a, first});
    mesh.triangles.push_back({last + a, last + b, first + 1});
  }
  return mesh;
}

/// Straight, then bent by an angle on a circle, then straight again; starts at the origin along z, bends to x.
inline std::vector<Eigen::Vector3d> bent_curve(double straight_mm, double bend_radius_mm, double angle_rad,
                                               double step_mm) {
  std::vector<Eigen::Vector3d> curve;
  const auto count = [&](double length) { return static_cast<int>(std::ceil(length / step_mm)); };
  for (int i = 0; i < count(straight_mm); ++i)
    curve.emplace_back(0.0, 0.0, straight_mm * i / count(straight_mm));
  const int arc = count(bend_radius_mm * angle_rad);
  for (int i = 0; i < arc; ++i) {
    const double a = angle_rad * i / arc;
    curve.emplace_back(bend_radius_mm * (1.0 - std::cos(a)), 0.0, straight_mm + bend_radius_mm * std::sin(a));
  }
  const Eigen::Vector3d end(bend_radius_mm * (1.0 - std::cos(angle_rad)), 0.0,
                            straight_mm + bend_radius_mm * std::sin(angle_rad));
  const Eigen::Vector3d along(std::sin(angle_rad), 0.0, std::cos(angle_rad));
  for (int i = 0; i <= count(straight_mm); ++i)
    curve.emplace_back(end + straight_mm * i / count(straight_mm) * along);
  return curve;
}

/// Signed distance to a capsule, negative inside.
inline double capsule(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double radius_mm) {
  const Eigen::Vector3d along = b - a;
  const double t = along.isZero() ? 0.0 : std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm() - radius_mm;
}

/// The surface f = 0 of a function negative inside, by marching tetrahedra: six to a cell, closed and manifold
/// where the box holds all of it.
inline TriangleMesh surface_of(const std::function<double(const Eigen::Vector3d&)>& f,
                               const Eigen::AlignedBox3d& box, double spacing_mm) {
  using Eigen::Vector3d;
  const Eigen::Array3i count = (box.sizes() / spacing_mm).array().ceil().cast<int>() + 1;
  const auto index = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(count[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(count[2]) +
           static_cast<std::size_t>(k);
  };
  const auto place = [&](int i, int j, int k) {
    return Vector3d(box.min() + spacing_mm * Vector3d(i, j, k));
  };
  std::vector<double> value(index(count[0] - 1, count[1] - 1, count[2] - 1) + 1);
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) value[index(i, j, k)] = f(place(i, j, k));
  struct Corner {
    std::size_t index;
    Vector3d position;
    double value;
  };
  TriangleMesh mesh;
  std::unordered_map<std::uint64_t, std::int32_t> cut;
  const auto vertex = [&](const Corner& p, const Corner& q) {
    const Corner& low = p.index < q.index ? p : q;
    const Corner& high = p.index < q.index ? q : p;
    const auto [at, fresh] =
        cut.try_emplace((low.index << 32) | high.index, static_cast<std::int32_t>(mesh.vertices_mm.size()));
    if (fresh) {
      const double t = std::clamp(low.value / (low.value - high.value), 0.02, 0.98);  // no slivers
      mesh.vertices_mm.emplace_back(low.position + t * (high.position - low.position));
    }
    return at->second;
  };
  const auto emit = [&](std::int32_t a, std::int32_t b, std::int32_t c, const Vector3d& outward) {
    const Vector3d& va = mesh.vertices_mm[static_cast<std::size_t>(a)];
    const Vector3d normal = (mesh.vertices_mm[static_cast<std::size_t>(b)] - va)
                                .cross(mesh.vertices_mm[static_cast<std::size_t>(c)] - va);
    if (normal.dot(outward) < 0.0) std::swap(b, c);
    mesh.triangles.push_back({a, b, c});
  };
  constexpr std::array<std::array<int, 4>, 6> tetrahedra{
      {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
  for (int i = 0; i + 1 < count[0]; ++i)
    for (int j = 0; j + 1 < count[1]; ++j)
      for (int k = 0; k + 1 < count[2]; ++k) {
        std::array<Corner, 8> corner;
        int inside = 0;
        for (int o = 0; o < 8; ++o) {
          const int x = i + (o & 1);
          const int y = j + ((o >> 1) & 1);
          const int z = k + (o >> 2);
          corner[static_cast<std::size_t>(o)] = {index(x, y, z), place(x, y, z), value[index(x, y, z)]};
          inside += value[index(x, y, z)] < 0.0 ? 1 : 0;
        }
        if (inside == 0 || inside == 8) continue;
        for (const auto& tetrahedron : tetrahedra) {
          std::vector<Corner> in;
          std::vector<Corner> out;
          for (int o : tetrahedron) {
            const Corner& c = corner[static_cast<std::size_t>(o)];
            (c.value < 0.0 ? in : out).push_back(c);
          }
          if (in.empty() || out.empty()) continue;
          Vector3d outward = Vector3d::Zero();
          for (const Corner& c : out) outward += c.position / static_cast<double>(out.size());
          for (const Corner& c : in) outward -= c.position / static_cast<double>(in.size());
          if (in.size() == 1) {
            emit(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]), outward);
          } else if (out.size() == 1) {
            emit(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]), outward);
          } else {
            const std::int32_t b = vertex(in[0], out[1]);
            const std::int32_t d = vertex(in[1], out[0]);
            emit(vertex(in[0], out[0]), b, vertex(in[1], out[1]), outward);
            emit(vertex(in[0], out[0]), vertex(in[1], out[1]), d, outward);
          }
        }
      }
  return mesh;
}

/// Vertices − edges + faces of a closed mesh: 2 − 2 · (loops of the lumen inside).
inline long euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<long>(mesh.vertices_mm.size()) - static_cast<long>(mesh.triangles.size()) / 2;
}

}  // namespace endowire::test

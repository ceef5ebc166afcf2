#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::test {

using vessel::TriangleMesh;

/// A grid of points (i along, j around; the latter closes on itself) joined by triangles that face away from
/// the axis when the points run counter-clockwise seen against the direction of i.
inline void add_rings(TriangleMesh& mesh, std::size_t rings, std::size_t around, bool closed_along) {
  const auto id = [&](std::size_t i, std::size_t j) {
    return static_cast<std::int32_t>((i % rings) * around + j % around);
  };
  for (std::size_t i = 0; i + (closed_along ? 0 : 1) < rings; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      mesh.triangles.push_back({id(i, j), id(i, j + 1), id(i + 1, j)});
      mesh.triangles.push_back({id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
    }
}

/// A straight open tube along z with vertices on the circle of radius_mm; faces outward.
inline TriangleMesh open_tube(double radius_mm, double length_mm, std::size_t around, std::size_t along) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i <= along; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      const double a = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
      mesh.vertices_mm.emplace_back(radius_mm * std::cos(a), radius_mm * std::sin(a),
                                    length_mm * static_cast<double>(i) / static_cast<double>(along));
    }
  add_rings(mesh, along + 1, around, false);
  return mesh;
}

/// The same with flat caps.
inline TriangleMesh closed_tube(double radius_mm, double length_mm, std::size_t around, std::size_t along) {
  TriangleMesh mesh = open_tube(radius_mm, length_mm, around, along);
  const auto bottom = static_cast<std::int32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.emplace_back(0.0, 0.0, 0.0);
  mesh.vertices_mm.emplace_back(0.0, 0.0, length_mm);
  const auto last = static_cast<std::int32_t>(along * around);
  for (std::size_t j = 0; j < around; ++j) {
    const auto a = static_cast<std::int32_t>(j);
    const auto b = static_cast<std::int32_t>((j + 1) % around);
    mesh.triangles.push_back({b, a, bottom});
    mesh.triangles.push_back({last + a, last + b, bottom + 1});
  }
  return mesh;
}

/// The same mesh elsewhere, beside another one.
inline void add_mesh(TriangleMesh& mesh, const TriangleMesh& other,
                     const Eigen::Vector3d& shift_mm = Eigen::Vector3d::Zero()) {
  const auto first = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (const Eigen::Vector3d& v : other.vertices_mm) mesh.vertices_mm.emplace_back(v + shift_mm);
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

inline void turn_over(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// The wall of a straight tube along z as one solid: outer surface, inner surface and a flat rim at each end.
inline TriangleMesh thick_tube(double inner_mm, double outer_mm, double length_mm, std::size_t around,
                               std::size_t along) {
  TriangleMesh mesh = open_tube(outer_mm, length_mm, around, along);
  TriangleMesh inner = open_tube(inner_mm, length_mm, around, along);
  turn_over(inner);
  const auto first = static_cast<std::int32_t>(mesh.vertices_mm.size());
  add_mesh(mesh, inner);
  const auto end = static_cast<std::int32_t>(along * around);
  for (std::size_t j = 0; j < around; ++j) {
    const auto a = static_cast<std::int32_t>(j);
    const auto b = static_cast<std::int32_t>((j + 1) % around);
    mesh.triangles.push_back({b, a, first + a});
    mesh.triangles.push_back({b, first + a, first + b});
    mesh.triangles.push_back({end + a, end + b, first + end + a});
    mesh.triangles.push_back({end + b, first + end + b, first + end + a});
  }
  return mesh;
}

/// A closed curve (distance from z, height) turned about z; faces away from what the curve goes round counter-clockwise.
inline TriangleMesh turned(const std::vector<Eigen::Vector2d>& curve_mm, std::size_t around) {
  TriangleMesh mesh;
  for (const Eigen::Vector2d& point : curve_mm)
    for (std::size_t j = 0; j < around; ++j) {
      const double a = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
      mesh.vertices_mm.emplace_back(point.x() * std::cos(a), point.x() * std::sin(a), point.y());
    }
  add_rings(mesh, curve_mm.size(), around, true);
  return mesh;
}

/// A torus around z.
inline TriangleMesh torus(double bend_radius_mm, double radius_mm, std::size_t along, std::size_t around) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < along; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      const double u = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(along);
      const double v = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
      const double rho = bend_radius_mm + radius_mm * std::cos(v);
      mesh.vertices_mm.emplace_back(rho * std::cos(u), rho * std::sin(u), radius_mm * std::sin(v));
    }
  add_rings(mesh, along, around, true);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);  // i runs along, so the rings turn the other way
  return mesh;
}

/// An octahedron split `levels` times, its vertices on the sphere.
inline TriangleMesh sphere(double radius_mm, int levels) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& t : mesh.triangles) {
      std::array<std::int32_t, 3> m{};
      for (std::size_t k = 0; k < 3; ++k) {  // duplicates are merged by repair
        m[k] = static_cast<std::int32_t>(mesh.vertices_mm.size());
        mesh.vertices_mm.push_back((mesh.vertices_mm[static_cast<std::size_t>(t[k])] +
                                    mesh.vertices_mm[static_cast<std::size_t>(t[(k + 1) % 3])])
                                       .normalized());
      }
      finer.push_back({t[0], m[0], m[2]});
      finer.push_back({m[0], t[1], m[1]});
      finer.push_back({m[2], m[1], t[2]});
      finer.push_back({m[0], m[1], m[2]});
    }
    mesh.triangles = std::move(finer);
  }
  for (auto& v : mesh.vertices_mm) v *= radius_mm;
  return mesh;
}

/// Fisher–Yates with a fixed generator: another order of the same triangles, their corners rotated too.
inline TriangleMesh shuffled(TriangleMesh mesh, std::uint64_t seed) {
  for (std::size_t i = mesh.triangles.size(); i > 1; --i) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    std::swap(mesh.triangles[i - 1], mesh.triangles[(seed >> 33) % i]);
    auto& t = mesh.triangles[i - 1];
    if ((seed >> 20) % 2 == 0) t = {t[1], t[2], t[0]};
  }
  return mesh;
}

}  // namespace endowire::test

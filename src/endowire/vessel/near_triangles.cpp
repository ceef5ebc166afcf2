#include "endowire/vessel/near_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr std::size_t few = 40;    // more take longer to try than the tree to search
constexpr double slack_mm = 1e-9;  // rounding of the bounds; they only save work
constexpr double flat_mm = 5e-10;  // bounds that a triangle's corners pass by more are not used
constexpr double square = 1e-9;    // cosine

}  // namespace

void NearTriangles::turn_to(const Cube& cube, const ExactSurface::Sample& middle) {
  last_ = middle.triangle;
  const double reach_mm = std::abs(middle.distance_mm) + std::sqrt(3.0) * cube.half_mm + slack_mm;
  const Vector3d around = Vector3d::Constant(cube.half_mm + reach_mm);
  triangles_.clear();
  const Eigen::AlignedBox3d box(Vector3d(cube.middle_mm - around), Vector3d(cube.middle_mm + around));
  if (!surface_->bvh().touching(box, touching_, 4 * few)) return;
  const double ball_mm = reach_mm + std::sqrt(3.0) * cube.half_mm;
  const auto place = [&](std::int32_t triangle) {
    return std::abs(surface_->at(cube.middle_mm, {&triangle, 1}).distance_mm);
  };
  places_.clear();
  for (const std::int32_t t : touching_)
    if (const double mm = place(t); mm <= ball_mm) places_.emplace_back(mm, t);
  if (places_.size() > few) return;
  std::sort(places_.begin(), places_.end());  // the nearest first: what they find rules out others
  for (const auto& [mm, t] : places_) triangles_.push_back(bounded(t));
}

KernelTriangle NearTriangles::bounded(std::int32_t triangle) const {
  const auto t = static_cast<std::size_t>(triangle);
  const TriangleMesh& mesh = surface_->mesh();
  const Vector3d& normal = surface_->normal(t);
  const auto off = [&](const Vector3d& direction, std::size_t from) {
    double most_mm = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      most_mm = std::max(most_mm, direction.dot(mesh.corner(t, k) - mesh.corner(t, from)));
    return most_mm;
  };
  KernelTriangle bounds{mesh.corner(t, 0).data(),
                        mesh.corner(t, 1).data(),
                        mesh.corner(t, 2).data(),
                        normal.data(),
                        triangle,
                        1.0,
                        {}};
  if (std::max(off(normal, 0), off(-normal, 0)) > flat_mm) bounds.flat = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d edge = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    const Vector3d side = edge.cross(normal).stableNormalized();
    if (bounds.flat == 0.0 || off(side, k) > flat_mm || std::abs(side.dot(normal)) > square) continue;
    bounds.side[k] = {side.x(), side.y(), side.z()};
  }
  return bounds;
}

void NearTriangles::nearest(PointBlock& block) {
  if (block.count == 0) return;
  const bool few_triangles = !triangles_.empty();
  if (few_triangles) {
    begin_search(block);
    for (const KernelTriangle& triangle : triangles_) try_triangle(triangle, block);
    end_search(block);
  }
  for (std::size_t n = 0; n < block.count; ++n) {
    const Vector3d p(block.x[n], block.y[n], block.z[n]);
    if (!few_triangles || block.needle[n] != 0) {
      ask_tree(p, n, block);
    } else if (block.feature[n] != 0) {
      const NearestPoint found{std::abs(block.distance_mm[n]),
                               Vector3d(block.nearest_x[n], block.nearest_y[n], block.nearest_z[n]),
                               static_cast<std::int32_t>(block.triangle[n]),
                               static_cast<std::uint8_t>(block.feature[n])};
      block.distance_mm[n] = surface_->signed_at(p, found).distance_mm;
    }
  }
}

void NearTriangles::ask_tree(const Vector3d& p, std::size_t n, PointBlock& block) {
  const double within_mm = std::abs(surface_->at(p, {&last_, 1}).distance_mm);
  const ExactSurface::Sample s = surface_->at(p, within_mm * (1.0 + slack_mm) + slack_mm);
  last_ = s.triangle;
  block.distance_mm[n] = s.distance_mm;
  block.triangle[n] = s.triangle;
  block.nearest_x[n] = s.nearest_mm.x();
  block.nearest_y[n] = s.nearest_mm.y();
  block.nearest_z[n] = s.nearest_mm.z();
}

}  // namespace endowire::vessel

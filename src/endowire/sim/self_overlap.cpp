#include "endowire/sim/self_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace endowire::sim {

namespace {

using Eigen::Vector3d;

constexpr double longest_piece_mm = 4.0;  // shorter: more pieces; longer: more of them near each other

/// Half of the 26 neighbours: the other half finds the pair from the other side.
constexpr std::array<std::array<int, 3>, 13> forward{{{1, 0, 0},
                                                      {-1, 1, 0},
                                                      {0, 1, 0},
                                                      {1, 1, 0},
                                                      {-1, -1, 1},
                                                      {0, -1, 1},
                                                      {1, -1, 1},
                                                      {-1, 0, 1},
                                                      {0, 0, 1},
                                                      {1, 0, 1},
                                                      {-1, 1, 1},
                                                      {0, 1, 1},
                                                      {1, 1, 1}}};

/// The parts (0 … 1) of two segments at which they are nearest.
struct Nearest {
  double on_first;
  double on_second;
};

/// Minimises |p + s u − q − t v|² over the unit square: the free minimum, then clamped, one variable after the other,
/// which is exact for a convex quadratic of two variables.
Nearest nearest_parts(const Vector3d& p, const Vector3d& u, const Vector3d& q, const Vector3d& v) {
  const Vector3d w = p - q;
  const double uu = u.squaredNorm();
  const double uv = u.dot(v);
  const double vv = v.squaredNorm();
  const double determinant = uu * vv - uv * uv;
  // Parallel segments: any point of the first serves, the clamps below find the nearest of the second.
  double s = determinant > 1e-12 * uu * vv
                 ? std::clamp((uv * v.dot(w) - vv * u.dot(w)) / determinant, 0.0, 1.0)
                 : 0.5;
  const double t = std::clamp((v.dot(w) + s * uv) / vv, 0.0, 1.0);
  s = std::clamp((t * uv - u.dot(w)) / uu, 0.0, 1.0);
  return {s, t};
}

}  // namespace

void SelfOverlap::reserve(std::size_t points, double length_mm) {
  const auto most = points + static_cast<std::size_t>(std::ceil(length_mm / longest_piece_mm));
  pieces_.reserve(most);
  std::size_t size = 16;
  while (size < 2 * most) size *= 2;
  chains_.reserve(size);
}

void SelfOverlap::cut(std::span<const SnapshotPoint> points) {
  pieces_.clear();
  widest_mm_ = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const SnapshotPoint& a = points[i];
    const SnapshotPoint& b = points[i + 1];
    const Vector3d chord = b.position_mm - a.position_mm;
    const double length = chord.norm();
    if (!(length > 0.0)) continue;
    const auto count = static_cast<int>(std::ceil(length / longest_piece_mm));
    const double radius = std::max(a.radius_mm, b.radius_mm);
    widest_mm_ = std::max(widest_mm_, radius);
    const Vector3d part = chord / count;
    const double arc = (b.arc_mm - a.arc_mm) / count;
    for (int k = 0; k < count; ++k)
      pieces_.push_back({a.position_mm + k * part, a.position_mm + (k + 1) * part, a.arc_mm + k * arc, radius,
                         Cell::Zero(), -1});
  }
}

std::size_t SelfOverlap::chain_of(const Cell& cell) const {
  const auto part = [](int i, std::uint32_t prime) { return static_cast<std::uint32_t>(i) * prime; };
  const std::uint32_t mixed =
      part(cell.x(), 73'856'093U) ^ part(cell.y(), 19'349'663U) ^ part(cell.z(), 83'492'791U);
  return mixed & (chains_.size() - 1);
}

/// Middles of pieces that touch are no farther apart than a cell is wide.
void SelfOverlap::sort_into_cells() {
  std::size_t size = 16;
  while (size < 2 * pieces_.size()) size *= 2;
  chains_.assign(size, -1);
  const double width = longest_piece_mm + 2.0 * widest_mm_;
  const Vector3d origin = pieces_.empty() ? Vector3d::Zero() : pieces_.front().begin_mm;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    const Vector3d middle = 0.5 * (piece.begin_mm + piece.end_mm) - origin;
    piece.cell = (middle / width).array().floor().cast<int>();
    std::int32_t& first = chains_[chain_of(piece.cell)];
    piece.next = first;
    first = static_cast<std::int32_t>(i);
  }
}

void SelfOverlap::measure(const Piece& a, const Piece& b, SelfGap& least) {
  const double radii = a.radius_mm + b.radius_mm;
  const Vector3d u = a.end_mm - a.begin_mm;
  const Vector3d v = b.end_mm - b.begin_mm;
  ++measured_;
  const Nearest parts = nearest_parts(a.begin_mm, u, b.begin_mm, v);
  const double arc_a = a.arc_mm + parts.on_first * u.norm();
  const double arc_b = b.arc_mm + parts.on_second * v.norm();
  if (std::abs(arc_a - arc_b) <= std::numbers::pi * radii) return;
  const Vector3d on_a = a.begin_mm + parts.on_first * u;
  const Vector3d on_b = b.begin_mm + parts.on_second * v;
  const double gap = (on_a - on_b).norm() - radii;
  if (gap < 0.0 && gap < least.gap_mm) least = {gap, arc_a < arc_b ? on_a : on_b};
}

SelfGap SelfOverlap::nearest(std::span<const SnapshotPoint> points) {
  cut(points);
  sort_into_cells();
  measured_ = 0;
  SelfGap least;
  // Neighbours along the wire share cells too: most of them need no measuring.
  const auto apart = [](const Piece& a, const Piece& b) {
    return std::abs(a.arc_mm - b.arc_mm) > std::numbers::pi * (a.radius_mm + b.radius_mm);
  };
  for (const Piece& piece : pieces_) {
    for (std::int32_t i = piece.next; i >= 0; i = pieces_[static_cast<std::size_t>(i)].next) {
      const Piece& other = pieces_[static_cast<std::size_t>(i)];
      if (other.cell == piece.cell && apart(piece, other)) measure(piece, other, least);
    }
    for (const auto& step : forward) {
      const Cell cell = piece.cell + Cell(step[0], step[1], step[2]);
      for (std::int32_t i = chains_[chain_of(cell)]; i >= 0; i = pieces_[static_cast<std::size_t>(i)].next) {
        const Piece& other = pieces_[static_cast<std::size_t>(i)];
        if (other.cell == cell && apart(piece, other)) measure(piece, other, least);
      }
    }
  }
  return least;
}

}  // namespace endowire::sim

#include "endowire/vessel/mesh_field.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Weights of the four nodes from `start` on for value and slope [per cell] of the Catmull–Rom interpolant in
/// cell `cell` at fraction f. In the first and last cell the missing neighbour is 3 n₀ − 3 n₁ + n₂.
struct Stencil {
  int start;
  std::array<float, 4> value;
  std::array<float, 4> slope;
};

Stencil stencil_at(double u) {
  const int cell = std::clamp(static_cast<int>(u), 0, MeshField::cells - 1);
  const auto f = static_cast<float>(std::clamp(u - cell, 0.0, 1.0));
  const std::array<float, 4> w{0.5F * ((2.0F - f) * f - 1.0F) * f, 0.5F * ((3.0F * f - 5.0F) * f * f + 2.0F),
                               0.5F * ((4.0F - 3.0F * f) * f + 1.0F) * f, 0.5F * (f - 1.0F) * f * f};
  const std::array<float, 4> d{0.5F * ((4.0F - 3.0F * f) * f - 1.0F), 0.5F * (9.0F * f - 10.0F) * f,
                               0.5F * ((8.0F - 9.0F * f) * f + 1.0F), 0.5F * (3.0F * f - 2.0F) * f};
  const auto first = [](const std::array<float, 4>& a) {
    return std::array<float, 4>{a[1] + 3.0F * a[0], a[2] - 3.0F * a[0], a[3] + a[0], 0.0F};
  };
  const auto last = [](const std::array<float, 4>& a) {
    return std::array<float, 4>{0.0F, a[0] + a[3], a[1] - 3.0F * a[3], a[2] + 3.0F * a[3]};
  };
  if (cell == 0) return {0, first(w), first(d)};
  if (cell == MeshField::cells - 1) return {MeshField::cells - 3, last(w), last(d)};
  return {cell - 1, w, d};
}

using Row = Eigen::Array4f;

Row row_at(const std::uint16_t* nodes) {
  return Eigen::Map<const Eigen::Array<std::uint16_t, 4, 1>>(nodes).cast<float>();
}

/// In one order on every machine.
float sum(const Row& r) {
  return (r[0] + r[1]) + (r[2] + r[3]);
}

double trilinear(const std::array<std::uint16_t, 8>& corner, const Vector3d& f) {
  double sum = 0.0;
  for (unsigned i = 0; i < 8; ++i) {
    const double wx = (i & 1U) != 0 ? f.x() : 1.0 - f.x();
    const double wy = (i & 2U) != 0 ? f.y() : 1.0 - f.y();
    const double wz = (i & 4U) != 0 ? f.z() : 1.0 - f.z();
    sum += wx * wy * wz * static_cast<double>(corner[i]);
  }
  return sum;
}

constexpr double smallest_radius_mm = 0.01;
constexpr double codes_per_octave = 4096.0;

}  // namespace

Eigen::AlignedBox3d MeshField::box_mm() const {
  const Vector3d size = root_mm_ * Vector3d(roots_along_[0], roots_along_[1], roots_along_[2]);
  return {origin_mm_, origin_mm_ + size};
}

MeshField::Place MeshField::find(const Vector3d& point_mm) const {
  const double finest = root_mm_ / static_cast<double>(1 << levels_);
  std::array<std::int32_t, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const std::int32_t end = roots_along_[k] << levels_;
    const double cell = (point_mm[axis] - origin_mm_[axis]) / finest;
    at[k] = cell < 0.0 ? 0 : cell >= end ? end - 1 : static_cast<std::int32_t>(cell);
  }
  std::int32_t level = levels_;
  Reference reference =
      roots_[(static_cast<std::size_t>(at[0] >> level) * static_cast<std::size_t>(roots_along_[1]) +
              static_cast<std::size_t>(at[1] >> level)) *
                 static_cast<std::size_t>(roots_along_[2]) +
             static_cast<std::size_t>(at[2] >> level)];
  while (reference >= 0) {
    --level;
    const auto octant = static_cast<std::size_t>(((at[0] >> level) & 1) | (((at[1] >> level) & 1) << 1) |
                                                 (((at[2] >> level) & 1) << 2));
    reference = children_[static_cast<std::size_t>(reference)][octant];
  }
  const Vector3d corner(static_cast<double>((at[0] >> level) << level),
                        static_cast<double>((at[1] >> level) << level),
                        static_cast<double>((at[2] >> level) << level));
  return {reference, origin_mm_ + finest * corner, finest * static_cast<double>(1 << level)};
}

WallDistance MeshField::interpolate(std::size_t brick, const Vector3d& point_mm, const Place& place) const {
  const double per_mm = cells / place.size_mm;
  const Vector3d u = per_mm * (point_mm - place.origin_mm);
  const Stencil sx = stencil_at(u.x());
  const Stencil sy = stencil_at(u.y());
  const Stencil sz = stencil_at(u.z());
  const std::uint16_t* corner =
      samples_.data() + brick * samples_per_brick + (sx.start * nodes + sy.start) * nodes + sz.start;
  // Four nodes along z at a time; what is summed over y and x first costs nothing along z.
  Row value = Row::Zero();
  Row by_x = Row::Zero();
  Row by_y = Row::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    Row v = Row::Zero();
    Row dy = Row::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      const Row nodes_along_z = row_at(corner + (i * nodes + j) * nodes);
      v += sy.value[j] * nodes_along_z;
      dy += sy.slope[j] * nodes_along_z;
    }
    value += sx.value[i] * v;
    by_x += sx.slope[i] * v;
    by_y += sx.value[i] * dy;
  }
  const Row along(sz.value.data());
  const Row slope(sz.slope.data());
  const Brick& b = bricks_[brick];
  const auto step = static_cast<double>(b.step_mm);
  const double slope_unit = step * per_mm;
  return {
      static_cast<double>(b.low_mm) + step * static_cast<double>(sum(value * along)),
      slope_unit * Vector3d(static_cast<double>(sum(by_x * along)), static_cast<double>(sum(by_y * along)),
                            static_cast<double>(sum(value * slope)))};
}

WallDistance MeshField::at(const Vector3d& point_mm) const {
  const Place place = find(point_mm);
  const std::size_t index = index_of(place.reference);
  const Eigen::AlignedBox3d box = box_mm();
  if (!is_far(place.reference) && box.contains(point_mm)) return interpolate(index, point_mm, place);
  // Deep in the wall, or off the box: never nearer than the band, pointing back.
  const Vector3d inside = point_mm.cwiseMax(box.min()).cwiseMin(box.max());
  const Vector3d back = inside - point_mm;
  WallDistance result;
  if (is_far(place.reference)) {
    const FarCell& cell = far_[index];
    result.gradient = Vector3d(static_cast<double>(cell.gradient[0]), static_cast<double>(cell.gradient[1]),
                               static_cast<double>(cell.gradient[2]));
    const Vector3d centre = place.origin_mm + Vector3d::Constant(0.5 * place.size_mm);
    result.distance_mm = static_cast<double>(cell.distance_mm) + result.gradient.dot(inside - centre);
  } else {
    result = interpolate(index, inside, place);
  }
  result.distance_mm = std::min(result.distance_mm, -band_mm_) - back.norm();
  if (!back.isZero()) result.gradient = back.stableNormalized();
  return result;
}

double MeshField::lumen_radius_mm(const Vector3d& point_mm) const {
  const Place place = find(point_mm);
  if (is_far(place.reference)) return static_cast<double>(far_[index_of(place.reference)].radius_mm);
  const Vector3d f =
      ((point_mm - place.origin_mm) / place.size_mm).cwiseMax(Vector3d::Zero()).cwiseMin(Vector3d::Ones());
  return decode_radius_mm(trilinear(bricks_[index_of(place.reference)].radius_code, f));
}

double MeshField::tissue_to_next_lumen_mm(const Vector3d& point_mm) const {
  const Reference reference = find(point_mm).reference;
  return static_cast<double>(is_far(reference) ? far_[index_of(reference)].tissue_mm
                                               : bricks_[index_of(reference)].tissue_mm);
}

std::uint16_t MeshField::encode_radius(double radius_mm) {
  const double octaves = std::log2(std::max(radius_mm, smallest_radius_mm) / smallest_radius_mm);
  return static_cast<std::uint16_t>(std::min(std::round(codes_per_octave * octaves), 65535.0));
}

double MeshField::decode_radius_mm(double code) {
  return smallest_radius_mm * std::exp2(code / codes_per_octave);
}

int MeshField::exit_at(const Vector3d& point_mm) const {
  constexpr double wall_mm = 1.0;  // a wire pressed into the virtual wall has left, too
  for (std::size_t k = 0; k < tubes_.size(); ++k) {
    const VirtualTube& tube = tubes_[k];
    const Vector3d r = point_mm - tube.centre_mm;
    const double along = r.dot(tube.direction);
    if (along <= tube.begin_mm || along > tube.end_mm + wall_mm) continue;
    if ((r - along * tube.direction).squaredNorm() <= (tube.radius_mm + wall_mm) * (tube.radius_mm + wall_mm))
      return static_cast<int>(k) + 1;
  }
  return 0;
}

double MeshField::spacing_mm(const Vector3d& point_mm) const {
  const Place place = find(point_mm);
  return is_far(place.reference) ? std::numeric_limits<double>::infinity() : place.size_mm / cells;
}

}  // namespace endowire::vessel

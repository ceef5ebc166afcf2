#include "endowire/vessel/mesh_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Four numbers at a time, in one instruction where there is one; the same bits where there is none.
using Row [[gnu::vector_size(16)]] = float;

/// Weights of four neighbouring nodes as cubics of the fraction f in a cell: row k is the factor of fᵏ.
using Cubics = std::array<Row, 4>;
constexpr Cubics inner_cell = {{{0.0F, 1.0F, 0.0F, 0.0F},
                                {-0.5F, 0.0F, 0.5F, 0.0F},
                                {1.0F, -2.5F, 2.0F, -0.5F},
                                {-0.5F, 1.5F, -1.5F, 0.5F}}};
/// In the first and the last cell of a brick, whose missing neighbour is 3 n₀ − 3 n₁ + n₂.
constexpr Cubics first_cell = {
    {{1.0F, 0.0F, 0.0F, 0.0F}, {-1.5F, 2.0F, -0.5F, 0.0F}, {0.5F, -1.0F, 0.5F, 0.0F}, {}}};
constexpr Cubics last_cell = {
    {{0.0F, 0.0F, 1.0F, 0.0F}, {0.0F, -0.5F, 0.0F, 0.5F}, {0.0F, 0.5F, -1.0F, 0.5F}, {}}};
constexpr std::array<Cubics, MeshField::cells> cubics_of_cell = {first_cell, inner_cell, inner_cell,
                                                                 last_cell};

/// Weights of the four nodes from `start` on for value and slope [per cell] of the Catmull–Rom interpolant, u cells into a brick.
struct Stencil {
  int start;
  Row value;
  Row slope;
};

[[gnu::always_inline]] inline Stencil stencil_at(double u) {
  const int cell = u > 0.0 ? static_cast<int>(std::min(u, MeshField::cells - 1.0)) : 0;
  const auto f = static_cast<float>(std::clamp(u - cell, 0.0, 1.0));
  const Cubics& cubics = cubics_of_cell[static_cast<std::size_t>(cell)];
  return {std::clamp(cell - 1, 0, MeshField::nodes - 4),
          cubics[0] + f * (cubics[1] + f * (cubics[2] + f * cubics[3])),
          cubics[1] + f * (2.0F * cubics[2] + 3.0F * f * cubics[3])};
}

Row row_at(const std::uint16_t* nodes) {
  using Codes [[gnu::vector_size(8)]] = std::uint16_t;
  using Integers [[gnu::vector_size(16)]] = std::int32_t;
  Codes codes;
  std::memcpy(&codes, nodes, sizeof(codes));
  return __builtin_convertvector(__builtin_convertvector(codes, Integers), Row);
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

[[gnu::always_inline]] inline MeshField::Place MeshField::find(const Vector3d& point_mm) const {
  const double finest_per_mm = static_cast<double>(1 << levels_) / root_mm_;
  const Vector3d finest = finest_per_mm * (point_mm - origin_mm_);
  std::array<std::int32_t, 3> at{};
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t end = roots_along_[k] << levels_;
    const double cell = finest[static_cast<Eigen::Index>(k)];
    inside = inside && cell >= 0.0 && cell <= end;
    at[k] = cell > 0.0 ? static_cast<std::int32_t>(std::min(cell, static_cast<double>(end - 1))) : 0;
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
  const double per_finest = 1.0 / static_cast<double>(1 << level);  // exact
  const Vector3d corner(static_cast<double>((at[0] >> level) << level),
                        static_cast<double>((at[1] >> level) << level),
                        static_cast<double>((at[2] >> level) << level));
  return {reference, inside, per_finest * (finest - corner), per_finest * finest_per_mm};
}

WallDistance MeshField::interpolate(std::size_t brick, const Place& place) const {
  const Stencil sx = stencil_at(cells * place.fraction.x());
  const Stencil sy = stencil_at(cells * place.fraction.y());
  const Stencil sz = stencil_at(cells * place.fraction.z());
  const std::uint16_t* corner =
      samples_.data() + brick * samples_per_brick + (sx.start * nodes + sy.start) * nodes + sz.start;
  // Four nodes along z at a time; what is summed over y and x first costs nothing along z.
  Row value{};
  Row by_x{};
  Row by_y{};
  for (int i = 0; i < 4; ++i) {
    Row v{};
    Row dy{};
    for (int j = 0; j < 4; ++j) {
      const Row nodes_along_z = row_at(corner + (i * nodes + j) * nodes);
      v += sy.value[j] * nodes_along_z;
      dy += sy.slope[j] * nodes_along_z;
    }
    value += sx.value[i] * v;
    by_x += sx.slope[i] * v;
    by_y += sx.value[i] * dy;
  }
  const Brick& b = bricks_[brick];
  const auto step = static_cast<double>(b.step_mm);
  const double slope_unit = step * cells * place.per_mm;
  return {static_cast<double>(b.low_mm) + step * static_cast<double>(sum(value * sz.value)),
          slope_unit * Vector3d(static_cast<double>(sum(by_x * sz.value)),
                                static_cast<double>(sum(by_y * sz.value)),
                                static_cast<double>(sum(value * sz.slope)))};
}

WallDistance MeshField::at(const Vector3d& point_mm) const {
  const Place place = find(point_mm);
  const std::size_t index = index_of(place.reference);
  if (!is_far(place.reference) && place.inside) return interpolate(index, place);
  // Deep in the wall, or off the box: never nearer than the band, pointing back.
  const Eigen::AlignedBox3d box = box_mm();
  const Vector3d inside = point_mm.cwiseMax(box.min()).cwiseMin(box.max());
  const Vector3d back = inside - point_mm;
  WallDistance result;
  if (is_far(place.reference)) {
    const FarCell& cell = far_[index];
    result.gradient = Vector3d(static_cast<double>(cell.gradient[0]), static_cast<double>(cell.gradient[1]),
                               static_cast<double>(cell.gradient[2]));
    const Vector3d from_centre = (place.fraction - Vector3d::Constant(0.5)) / place.per_mm + back;
    result.distance_mm = static_cast<double>(cell.distance_mm) + result.gradient.dot(from_centre);
  } else {
    result = interpolate(index, place);
  }
  result.distance_mm = std::min(result.distance_mm, -band_mm_) - back.norm();
  if (!back.isZero()) result.gradient = back.stableNormalized();
  return result;
}

MeshField::Reference MeshField::reference_at(const Vector3d& point_mm) const {
  return find(point_mm).reference;
}

double MeshField::lumen_radius_mm(const Vector3d& point_mm) const {
  const Place place = find(point_mm);
  if (is_far(place.reference)) return static_cast<double>(far_[index_of(place.reference)].radius_mm);
  const Vector3d f = place.fraction.cwiseMax(Vector3d::Zero()).cwiseMin(Vector3d::Ones());
  return decode_radius_mm(trilinear(bricks_[index_of(place.reference)].radius_code, f));
}

double MeshField::tissue_to_next_lumen_mm(const Vector3d& point_mm) const {
  const Reference reference = reference_at(point_mm);
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
  return is_far(place.reference) ? std::numeric_limits<double>::infinity() : 1.0 / (cells * place.per_mm);
}

}  // namespace endowire::vessel

#include "endowire/vessel/anatomy/lumen_shape.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

constexpr double chunk_mm = 4.0;  // of arc: shorter than the radius of curvature of every vessel here
constexpr double cell_mm = 8.0;   // of the grid that finds the chunks near a point

/// That a facet feels: of the cross-section; where the wall is curved lengthwise, too, two thirds of both curvatures,
/// which is what moves the middle of an equilateral triangle as an edge moves in a cylinder.
double curvature_radius_mm(double around_per_mm, double along_per_mm) {
  return 1.0 / std::max(around_per_mm, (around_per_mm + std::abs(along_per_mm)) / 1.5);
}

}  // namespace

LumenShape::LumenShape(std::vector<Tube> tubes, double reach_mm)
    : tubes_(std::move(tubes)), reach_mm_(reach_mm) {
  for (std::uint32_t i = 0; i < tubes_.size(); ++i) add_chunks(i);
  for (const Chunk& chunk : chunks_) {
    bounds_mm_.extend(chunk.centre_mm - Vector3d::Constant(chunk.radius_mm));
    bounds_mm_.extend(chunk.centre_mm + Vector3d::Constant(chunk.radius_mm));
  }
  sort_into_cells();
}

void LumenShape::add_chunks(std::uint32_t tube) {
  const Tube& t = tubes_[tube];
  const double from = -t.before_mm;
  const double to = t.axis.length_mm() + t.beyond_mm;
  const double count = std::ceil((to - from) / chunk_mm);
  for (double k = 0.0; k < count; k += 1.0) {
    const double begin_arc = from + (to - from) * k / count;
    const double end_arc = from + (to - from) * (k + 1.0) / count;
    const AxisPoint begin = t.axis.at(begin_arc);
    const AxisPoint middle = t.axis.at(0.5 * (begin_arc + end_arc));
    const AxisPoint end = t.axis.at(end_arc);
    const double lumen = std::max({begin.radius_mm, middle.radius_mm, end.radius_mm});
    chunks_.push_back({tube, begin_arc, end_arc, begin.position_mm, begin.tangent, end.position_mm,
                       end.tangent, k == 0.0, k + 1.0 == count, middle.position_mm,
                       0.5 * (end_arc - begin_arc) + lumen});  // f ≥ |x − centre| − this
  }
}

LumenShape::Cell LumenShape::cell_of(const Vector3d& point_mm) const {
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    cell[k] = static_cast<std::int64_t>(
        std::floor((point_mm[axis] - bounds_mm_.min()[axis] + reach_mm_) / cell_mm));
  }
  return cell;
}

std::size_t LumenShape::index_of(const Cell& cell) const {
  return static_cast<std::size_t>((cell[0] * cells_[1] + cell[1]) * cells_[2] + cell[2]);
}

void LumenShape::sort_into_cells() {
  const Vector3d margin = Vector3d::Constant(reach_mm_);
  cells_ = cell_of(bounds_mm_.max() + margin);
  for (std::int64_t& count : cells_) ++count;
  const auto visit = [&](const auto& see) {
    for (std::uint32_t c = 0; c < chunks_.size(); ++c) {
      const Vector3d reach = Vector3d::Constant(chunks_[c].radius_mm + reach_mm_);
      Cell low = cell_of(chunks_[c].centre_mm - reach);
      Cell high = cell_of(chunks_[c].centre_mm + reach);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::max<std::int64_t>(low[k], 0);
        high[k] = std::min(high[k], cells_[k] - 1);
      }
      for (std::int64_t i = low[0]; i <= high[0]; ++i)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
          for (std::int64_t k = low[2]; k <= high[2]; ++k) see(index_of({i, j, k}), c);
    }
  };
  first_near_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]) + 1, 0);
  visit([&](std::size_t cell, std::uint32_t /*chunk*/) { ++first_near_[cell + 1]; });
  for (std::size_t i = 1; i < first_near_.size(); ++i) first_near_[i] += first_near_[i - 1];
  chunks_near_.resize(first_near_.back());
  std::vector<std::uint32_t> next(first_near_.begin(), first_near_.end() - 1);
  visit([&](std::size_t cell, std::uint32_t chunk) { chunks_near_[next[cell]++] = chunk; });
}

/// The distance to one chunk's tube, where its foot lies within the chunk and it is nearer than `sample` says.
void LumenShape::lower(const Chunk& chunk, const Vector3d& point_mm, WallSample& sample) const {
  const double within = sample.distance_mm + chunk.radius_mm;
  const Vector3d from_centre = point_mm - chunk.centre_mm;
  if (!(within > 0.0 && dot(from_centre, from_centre) < within * within)) return;
  const double behind = dot(point_mm - chunk.begin_mm, chunk.begin_tangent);
  const double ahead = dot(chunk.end_mm - point_mm, chunk.end_tangent);
  if ((behind < 0.0 && !chunk.first) || (ahead < 0.0 && !chunk.last)) return;
  const Axis& axis = tubes_[chunk.tube].axis;
  const double share = std::clamp(behind / (behind + ahead), 0.0, 1.0);
  const double guess = chunk.from_mm + share * (chunk.to_mm - chunk.from_mm);
  const AxisPoint at = axis.at(behind < 0.0  ? chunk.from_mm
                               : ahead < 0.0 ? chunk.to_mm
                                             : axis.foot_mm(point_mm, chunk.from_mm, chunk.to_mm, guess));
  const Vector3d away = point_mm - at.position_mm;
  const double d = length(away);
  if (d - at.radius_mm >= sample.distance_mm) return;
  const Vector3d radial = d > 0.0 ? Vector3d(away / d) : at.tangent;
  const double around = 1.0 / at.radius_mm;
  const bool ball = behind < 0.0 || ahead < 0.0;
  sample = {d - at.radius_mm, unit(radial - at.radius_slope * at.tangent),
            curvature_radius_mm(around, ball ? around : at.radius_bend_per_mm)};
}

WallSample LumenShape::at(const Vector3d& point_mm) const {
  WallSample total;
  total.distance_mm = reach_mm_;
  const Cell cell = cell_of(point_mm);
  for (std::size_t k = 0; k < 3; ++k)
    if (cell[k] < 0 || cell[k] >= cells_[k]) return total;
  const std::size_t end = first_near_[index_of(cell) + 1];
  for (std::size_t i = first_near_[index_of(cell)]; i < end;) {
    const std::uint32_t tube = chunks_[chunks_near_[i]].tube;
    WallSample one;
    one.distance_mm = reach_mm_;
    for (; i < end && chunks_[chunks_near_[i]].tube == tube; ++i)
      lower(chunks_[chunks_near_[i]], point_mm, one);
    if (one.distance_mm < reach_mm_)
      total = total.distance_mm < reach_mm_ ? tubes_[tube].fillet.join(total, one) : one;
  }
  return total;
}

Vector3d LumenShape::projected(Vector3d point_mm, double tolerance_mm, WallSample& sample) const {
  constexpr int iterations = 8;  // two are usual
  for (int i = 0; i < iterations; ++i) {
    sample = at(point_mm);
    point_mm -= sample.distance_mm * sample.gradient;
    if (std::abs(sample.distance_mm) < tolerance_mm) break;
  }
  return point_mm;
}

}  // namespace endowire::vessel::anatomy

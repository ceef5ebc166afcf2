#include "endowire/sim/resolution.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "endowire/rod/remesh.hpp"
#include "endowire/sim/grid.hpp"
#include "endowire/sim/vessel_ahead.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

constexpr double kLookAhead_mm = 8.0;
constexpr double kGrowth = 0.5;
constexpr double kJoin = 0.7;
/// A cell is one though its arcs are sums of halves.
constexpr double kSameArc_mm = 1e-9;

double turn_at(const rod::ChainShape& shape, int joint) {
  const Eigen::Vector3d& tip_side = shape.frames[at(joint - 1)].col(2);
  const Eigen::Vector3d& hand_side = shape.frames[at(joint)].col(2);
  return std::atan2(tip_side.cross(hand_side).norm(), tip_side.dot(hand_side));
}

}  // namespace

Resolution::Resolution(const ResolutionSpec& spec, const rod::ImmersedWire& wire, const vessel::Field& field)
    : spec_(spec), wire_(wire), field_(&field) {
  const rod::MaterialLine& line = *wire.line;
  if (spec_.adaptive) {
    for (smallest_mm_ = spec_.longest_mm; 0.5 * smallest_mm_ >= spec_.shortest_mm * (1.0 - 1e-9);)
      smallest_mm_ *= 0.5;
    most_rods_ = static_cast<int>(std::ceil(line.length_mm() / smallest_mm_)) + 2;
  } else {
    grid_ = uniform_grid(line, spec_.rod_length_mm, spec_.max_bias_rad);
    most_rods_ = static_cast<int>(grid_.size()) + 1;
  }
  wanted_mm_.reserve(at(most_rods_));
  window_mm_.reserve(at(most_rods_));
}

double Resolution::longest_cell_mm(double arc_mm, double wanted_mm) const {
  double cell = spec_.longest_mm;
  while (cell > smallest_mm_ && (cell > wanted_mm || std::abs(std::remainder(arc_mm, cell)) > kSameArc_mm))
    cell *= 0.5;
  return cell;
}

double Resolution::next_joint_mm(const rod::ChainShape& shape, double arc_mm) const {
  if (!spec_.adaptive) return *std::upper_bound(grid_.begin(), grid_.end() - 1, arc_mm + kSameArc_mm);
  const int sheath = shape.rods() - 1;
  double wanted = spec_.lumen_diameters * 2.0 * field_->lumen_radius_mm(shape.joints_mm[at(sheath)]);
  const double rod_mm = (shape.joints_mm[at(sheath - 1)] - shape.joints_mm[at(sheath)]).norm();
  const double curvature = turn_at(shape, sheath) / (0.5 * rod_mm);
  if (curvature > 0.0) {
    wanted = std::min(
        {wanted, std::sqrt(8.0 * spec_.shape_tolerance_mm / curvature), spec_.max_turn_rad / curvature});
  }
  double cell = longest_cell_mm(arc_mm, wanted);
  while (cell > smallest_mm_ && wire_.line->rest_bend_rad(arc_mm, arc_mm + cell).norm() > spec_.max_bias_rad)
    cell *= 0.5;
  return arc_mm + cell;
}

/// Wanted lengths of the rods in the lumen. The tip is about to follow the vessel ahead.
void Resolution::measure(const rod::ChainMaterial& material, const rod::ChainShape& shape) {
  const rod::MaterialLine& line = *wire_.line;
  const int rods = shape.rods() - 1;
  const std::vector<double>& arc = material.arc_mm;
  const auto length = [&](int i) { return arc[at(i + 1)] - arc[at(i)]; };
  const auto curvature_at = [&](int j) {
    if (j > rods) return 0.0;
    const double span = j == rods ? 0.5 * length(j - 1) : 0.5 * (length(j - 1) + length(j));
    return turn_at(shape, j) / span;
  };
  window_mm_.resize(at(rods));
  wanted_mm_.resize(at(rods));
  const Eigen::Vector3d& tip_direction = shape.frames[0].col(2);
  double before = vessel_curvature_ahead_per_mm(*field_, shape.joints_mm[0], tip_direction);
  for (int i = 0; i < rods; ++i) {
    const double after = curvature_at(i + 1);
    const double curvature = std::max({before, after, 1e-9});
    before = after;
    const Eigen::Vector3d middle = 0.5 * (shape.joints_mm[at(i)] + shape.joints_mm[at(i + 1)]);
    const double rest = std::max({line.rest_curvature_per_mm(arc[at(i)]).norm(),
                                  line.rest_curvature_per_mm(arc[at(i)] + 0.5 * length(i)).norm(), 1e-9});
    window_mm_[at(i)] =
        std::min({std::sqrt(8.0 * spec_.shape_tolerance_mm / curvature), spec_.max_turn_rad / curvature,
                  spec_.max_bias_rad / rest, spec_.lumen_diameters * 2.0 * field_->lumen_radius_mm(middle)});
  }
  for (int i = 0; i < rods; ++i) {
    double wanted = window_mm_[at(i)];
    for (int k = i - 1; k >= 0 && arc[at(i)] - arc[at(k + 1)] < kLookAhead_mm; --k)
      wanted = std::min(wanted, window_mm_[at(k)]);
    for (int k = i + 1; k < rods && arc[at(k)] - arc[at(i + 1)] < kLookAhead_mm; ++k)
      wanted = std::min(wanted, window_mm_[at(k)]);
    wanted_mm_[at(i)] = std::clamp(wanted, spec_.shortest_mm, spec_.longest_mm);
  }
  for (int i = 1; i < rods; ++i)
    wanted_mm_[at(i)] = std::min(wanted_mm_[at(i)], wanted_mm_[at(i - 1)] + kGrowth * length(i - 1));
  for (int i = rods - 2; i >= 0; --i)
    wanted_mm_[at(i)] = std::min(wanted_mm_[at(i)], wanted_mm_[at(i + 1)] + kGrowth * length(i + 1));
}

/// Whether the rods on both sides of a joint are the two halves of a cell.
bool Resolution::cell_of_two(const rod::ChainMaterial& material, int joint) const {
  const std::vector<double>& arc = material.arc_mm;
  const double tip_side = arc[at(joint)] - arc[at(joint - 1)];
  const double hand_side = arc[at(joint + 1)] - arc[at(joint)];
  const double cell = tip_side + hand_side;
  return std::abs(tip_side - hand_side) < kSameArc_mm && cell <= spec_.longest_mm * (1.0 + 1e-9) &&
         std::abs(std::remainder(arc[at(joint - 1)], cell)) < kSameArc_mm;
}

RodChanges Resolution::adapt(rod::ChainMaterial& material, rod::ChainShape& shape) {
  RodChanges changes;
  if (!spec_.adaptive) return changes;
  measure(material, shape);
  double energy_mj = -1.0;  // not known until something changes: in most steps nothing does
  // From the hand to the tip: what is still to come keeps its number. The rod that enters is not touched, nor the joint before it.
  for (int i = shape.rods() - 3; i >= 0 && changes.energy_mj <= spec_.budget_mj; --i) {
    const double length = material.arc_mm[at(i + 1)] - material.arc_mm[at(i)];
    const bool divide = length > wanted_mm_[at(i)] && length > 1.5 * smallest_mm_;
    const bool join = !divide && i > 0 && cell_of_two(material, i) &&
                      2.0 * length < kJoin * std::min(wanted_mm_[at(i)], wanted_mm_[at(i - 1)]);
    if (!divide && !join) continue;
    if (energy_mj < 0.0) energy_mj = rod::chain_energy(material, shape);
    if (divide) {
      rod::divide_rod(material, shape, i, material.arc_mm[at(i)] + 0.5 * length);
      wire_.fill(i, i + 2, material);
      ++changes.divided;
    } else {
      rod::join_rods(material, shape, i);
      wire_.fill(i - 1, i, material);
      ++changes.joined;
    }
    const double now_mj = rod::chain_energy(material, shape);
    changes.energy_mj += std::abs(now_mj - energy_mj);
    energy_mj = now_mj;
    --i;  // its neighbour waits for the next step
  }
  return changes;
}

}  // namespace endowire::sim

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <span>

#include "endowire/base/contract.hpp"
#include "endowire/vessel/brick_signs.hpp"
#include "endowire/vessel/field_probes.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/lumen.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/near_triangles.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t algorithm_version = 3;   // part of the key: old caches die with a change of results
constexpr double max_spacing_mm = 3.2;           // in the middle of wide lumens
constexpr double base_spacing_limit_mm = 1.6;    // near walls; what error_target_mm needs comes on top
constexpr double base_cells_per_radius = 2.5;    // so that every lumen is seen at all
constexpr double radius_floor_spacing_mm = 0.2;  // finer only where the error asks for it
constexpr double screen_fraction = 1.0;  // cells straighter than this part of the tolerance are not tested
constexpr double deep_mm = 3.0;          // from the wall: no instrument touches it from there
constexpr std::size_t max_roots = 2'000'000;   // 8 MB of references; a longer vessel gets larger root cells
constexpr std::size_t report_points = 50'000;  // of the final error measurement
constexpr std::size_t scout_points = 50'000;   // random points that look for cells the test points missed
constexpr std::uint64_t scout_seed = 11;
constexpr std::uint64_t report_seed = 12;

}  // namespace

/// Builds the octree of a MeshField: cells that need it are sampled, then the worst are split until all meet
/// the tolerance or memory is spent. Single-threaded; every decision depends on coordinates only.
class MeshFieldBuilder {
 public:
  MeshFieldBuilder(const RepairedMesh& repaired, const FieldParameters& parameters)
      : parameters_(parameters),
        closed_(close_surface(repaired, parameters.virtual_tube_mm)),
        surface_(closed_.mesh),
        lumen_(measure_lumen(surface_, closed_.wall_triangles)) {
    radius_code_.reserve(lumen_.radius_mm.size());
    for (double radius_mm : lumen_.radius_mm) radius_code_.push_back(MeshField::encode_radius(radius_mm));
  }

  MeshField build(std::uint64_t key) {
    field_.key_ = key;
    field_.band_mm_ = parameters_.band_outside_mm;
    field_.tubes_ = closed_.tubes;
    max_bricks_ = parameters_.max_bytes /
                  (MeshField::samples_per_brick * sizeof(std::uint16_t) + sizeof(MeshField::Brick));
    lay_roots();
    choose_base_scale();
    field_.samples_.reserve(max_bricks_ * MeshField::samples_per_brick);
    const std::size_t roots = field_.roots_.size();
    for (std::size_t i = 0; i < roots; ++i) prepare(root_cell(i));
    refine_worst_first();
    scout();
    refine_worst_first();
    compact();
    fill_facts();
    return std::move(field_);
  }

 private:
  struct Cell {
    std::array<std::int32_t, 3> at;  ///< lowest corner in finest bricks
    std::int32_t level;              ///< log₂ of the edge in finest bricks
    std::size_t slot;                ///< where its reference is: root, or roots + 8 · group + octant
  };
  struct Worst {
    double excess;  ///< error over tolerance
    std::size_t brick;
    bool operator<(const Worst& o) const {
      return excess < o.excess || (excess == o.excess && brick > o.brick);
    }
  };

  // --- geometry of cells

  double size_mm(const Cell& cell) const { return finest_mm_ * static_cast<double>(1 << cell.level); }
  Vector3d origin_mm(const Cell& cell) const {
    return field_.origin_mm_ + finest_mm_ * Vector3d(cell.at[0], cell.at[1], cell.at[2]);
  }
  Vector3d middle_mm(const Cell& cell) const {
    return origin_mm(cell) + Vector3d::Constant(0.5 * size_mm(cell));
  }
  /// From the middle of a cell to its corners.
  double reach_mm(const Cell& cell) const { return 0.5 * std::sqrt(3.0) * size_mm(cell); }
  Cell root_cell(std::size_t i) const {
    const auto ny = static_cast<std::size_t>(field_.roots_along_[1]);
    const auto nz = static_cast<std::size_t>(field_.roots_along_[2]);
    const std::int32_t unit = 1 << field_.levels_;
    return {{static_cast<std::int32_t>(i / (ny * nz)) * unit, static_cast<std::int32_t>(i / nz % ny) * unit,
             static_cast<std::int32_t>(i % nz) * unit},
            field_.levels_,
            i};
  }
  MeshField::Reference& reference(std::size_t slot) {
    const std::size_t roots = field_.roots_.size();
    return slot < roots ? field_.roots_[slot] : field_.children_[(slot - roots) / 8][(slot - roots) % 8];
  }

  void lay_roots() {
    Eigen::AlignedBox3d box = bounds_mm(closed_.mesh);
    const Vector3d margin = Vector3d::Constant(2.0 * parameters_.band_outside_mm);
    box.min() -= margin;
    box.max() += margin;
    double root = MeshField::cells * max_spacing_mm;
    std::array<std::size_t, 3> along{};
    for (;; root *= 2.0) {
      for (std::size_t k = 0; k < 3; ++k)
        along[k] = static_cast<std::size_t>(std::ceil(box.sizes()[static_cast<Eigen::Index>(k)] / root));
      if (along[0] * along[1] * along[2] <= max_roots) break;
    }
    field_.root_mm_ = root;
    field_.levels_ = 0;
    for (double h = root / MeshField::cells; 0.5 * h >= parameters_.min_spacing_mm * (1.0 - 1e-9); h *= 0.5)
      ++field_.levels_;
    finest_mm_ = root / static_cast<double>(1 << field_.levels_);
    const Vector3d used = root * Vector3d(static_cast<double>(along[0]), static_cast<double>(along[1]),
                                          static_cast<double>(along[2]));
    field_.origin_mm_ = box.center() - 0.5 * used;
    for (std::size_t k = 0; k < 3; ++k) field_.roots_along_[k] = static_cast<std::int32_t>(along[k]);
    field_.roots_.assign(along[0] * along[1] * along[2], 0);
  }

  /// Spacing that the radius of a lumen asks for, before any error is known.
  double base_spacing_mm(double radius_mm) const {
    return base_scale_ *
           std::clamp(radius_mm / base_cells_per_radius, radius_floor_spacing_mm, base_spacing_limit_mm);
  }

  /// Coarser everywhere when the first cells alone would fill the memory (a huge or hostile vessel).
  void choose_base_scale() {
    for (;; base_scale_ *= 2.0) {
      double bricks = 0.0;
      for (std::size_t t = 0; t < closed_.mesh.triangles.size(); ++t) {
        const double edge = MeshField::cells * base_spacing_mm(lumen_.radius_mm[t]);
        bricks += 0.5 * closed_.mesh.area_normal(t).norm() / (edge * edge) *
                  (2.0 + (parameters_.near_mm + parameters_.band_outside_mm) / edge);
      }
      if (bricks < 0.5 * static_cast<double>(max_bricks_) || base_scale_ > 1e3) return;
    }
  }

  // --- the octree

  /// The cell before this one mostly lies near by: it tells how far the surface can be.
  ExactSurface::Sample nearest_to_middle(const Cell& cell) {
    const Vector3d middle = middle_mm(cell);
    const double within_mm = last_distance_mm_ + (middle - last_middle_mm_).norm();
    const ExactSurface::Sample s = surface_.at(middle, within_mm * (1.0 + 1e-9) + 1e-9);
    last_middle_mm_ = middle;
    last_distance_mm_ = std::abs(s.distance_mm);
    return s;
  }

  void prepare(const Cell& cell) {
    const ExactSurface::Sample s = nearest_to_middle(cell);
    if (s.distance_mm < -(parameters_.band_outside_mm + reach_mm(cell))) {
      add_far(cell, middle_mm(cell), s);
      return;
    }
    const auto t = static_cast<std::size_t>(s.triangle);
    const bool near = std::abs(s.distance_mm) < reach_mm(cell);
    const double spacing = size_mm(cell) / MeshField::cells;
    if (cell.level > 0 && near && spacing > base_spacing_mm(lumen_.radius_mm[t]) * (1.0 + 1e-9)) {
      split(cell);
      return;
    }
    add_brick(cell, s);
  }

  void split(const Cell& cell) {
    const std::size_t group = field_.children_.size();
    field_.children_.push_back({});
    reference(cell.slot) = static_cast<MeshField::Reference>(group);
    const std::int32_t half = 1 << (cell.level - 1);
    for (std::size_t o = 0; o < 8; ++o) {
      Cell child{cell.at, cell.level - 1, field_.roots_.size() + 8 * group + o};
      for (std::size_t k = 0; k < 3; ++k) child.at[k] += ((o >> k) & 1U) != 0 ? half : 0;
      prepare(child);
    }
  }

  void add_far(const Cell& cell, const Vector3d& centre, const ExactSurface::Sample& s) {
    const Vector3d g = (s.nearest_mm - centre).stableNormalized();
    const auto t = static_cast<std::size_t>(s.triangle);
    reference(cell.slot) =
        static_cast<MeshField::Reference>(-2 - 2 * static_cast<std::int64_t>(field_.far_.size()));
    field_.far_.push_back({static_cast<float>(s.distance_mm),
                           {static_cast<float>(g.x()), static_cast<float>(g.y()), static_cast<float>(g.z())},
                           static_cast<float>(lumen_.radius_mm[t]),
                           static_cast<float>(lumen_.tissue_mm[t])});
  }

  double tolerance_mm(double distance_mm) const {
    const double depth = std::abs(distance_mm);
    if (depth <= (distance_mm > 0.0 ? parameters_.near_mm : parameters_.near_outside_mm))
      return parameters_.error_target_mm;
    const double slope = distance_mm > 0.0 ? parameters_.error_slope : 2.0 * parameters_.error_slope;
    return std::max(parameters_.error_target_mm, slope * depth);
  }

  /// Samples a brick and, where its test points miss, notes it for splitting.
  /// @param middle  the surface nearest to its middle
  void add_brick(const Cell& cell, const ExactSurface::Sample& middle) {
    std::size_t index = 0;
    if (!unused_.empty()) {
      index = unused_.back();
      unused_.pop_back();
    } else {
      index = field_.bricks_.size();
      field_.bricks_.push_back({});
      cells_.push_back({});
      field_.samples_.resize(field_.samples_.size() + MeshField::samples_per_brick);
    }
    cells_[index] = cell;
    reference(cell.slot) = static_cast<MeshField::Reference>(-1 - 2 * static_cast<std::int64_t>(index));
    near_.turn_to({middle_mm(cell), 0.5 * size_mm(cell)}, middle);
    sample(cell);
    settle_signs(nodes_, size_mm(cell) / MeshField::cells, closed_.mesh);
    store(index);
    if (cell.level == 0) return;
    const double excess = excess_of_tests(index, cell);
    if (excess > 1.0) worst_.push({excess, index});
  }

  std::span<const double> distances() const {
    return std::span(nodes_.distance_mm).first(MeshField::samples_per_brick);
  }

  /// Exact distances at the nodes.
  void sample(const Cell& cell) {
    const double spacing = size_mm(cell) / MeshField::cells;
    const Vector3d origin = origin_mm(cell);
    nodes_.count = MeshField::samples_per_brick;
    for (int i = 0; i < MeshField::nodes; ++i)
      for (int j = 0; j < MeshField::nodes; ++j)
        for (int k = 0; k < MeshField::nodes; ++k) {
          const Vector3d p = origin + spacing * Vector3d(i, j, k);
          const std::size_t n = brick_node(i, j, k);
          nodes_.x[n] = p.x();
          nodes_.y[n] = p.y();
          nodes_.z[n] = p.z();
        }
    near_.nearest(nodes_);
  }

  void store(std::size_t index) {
    const auto [low, high] = std::minmax_element(distances().begin(), distances().end());
    MeshField::Brick& brick = field_.bricks_[index];
    brick.low_mm = static_cast<float>(*low);
    brick.step_mm = static_cast<float>((*high - *low) / 65535.0);
    const double start = static_cast<double>(brick.low_mm);
    const double per_step = brick.step_mm > 0.0F ? 1.0 / static_cast<double>(brick.step_mm) : 0.0;
    std::uint16_t* samples = field_.samples_.data() + index * MeshField::samples_per_brick;
    double tissue = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    for (double d : distances()) nearest = std::min(nearest, std::abs(d));
    const double reach = std::max(2.0, nearest + 1e-6);  // walls that something in this brick may press on
    for (std::size_t n = 0; n < MeshField::samples_per_brick; ++n) {
      samples[n] = static_cast<std::uint16_t>(
          std::clamp(std::round((nodes_.distance_mm[n] - start) * per_step), 0.0, 65535.0));
      if (std::abs(nodes_.distance_mm[n]) <= reach)
        tissue = std::min(tissue, lumen_.tissue_mm[static_cast<std::size_t>(nodes_.triangle[n])]);
    }
    brick.tissue_mm = static_cast<float>(tissue);
    for (unsigned c = 0; c < 8; ++c) {
      const auto end = [&](unsigned bit) { return (c & bit) != 0 ? MeshField::cells : 0; };
      const auto t = static_cast<std::size_t>(nodes_.triangle[brick_node(end(1), end(2), end(4))]);
      brick.radius_code[c] = radius_code_[t];
    }
  }

  /// Largest error over tolerance at test points in the cells of the brick at hand. Only cells in which the
  /// tangent planes of the corners disagree are tested: elsewhere the distance is as good as linear.
  double excess_of_tests(std::size_t index, const Cell& cell) {
    const Vector3d origin = origin_mm(cell);
    const double per_mm = 1.0 / size_mm(cell);
    const double spacing = size_mm(cell) / MeshField::cells;
    const Vector3d half = Vector3d::Constant(0.5 * spacing);
    slopes_of(nodes_, slopes_);
    for (std::size_t n = 0; n < MeshField::samples_per_brick; ++n) {
      if (std::abs(nodes_.distance_mm[n]) > 1e-9) continue;
      const Vector3d inward = -surface_.normal(static_cast<std::size_t>(nodes_.triangle[n]));
      slopes_.x[n] = inward.x();
      slopes_.y[n] = inward.y();
      slopes_.z[n] = inward.z();
    }
    TangentRange tangents;
    tangent_range(nodes_, slopes_, half.x(), tangents);
    SplitMix random((static_cast<std::uint64_t>(cell.at[0]) << 42) ^
                    (static_cast<std::uint64_t>(cell.at[1]) << 21) ^ static_cast<std::uint64_t>(cell.at[2]) ^
                    (static_cast<std::uint64_t>(cell.level) << 60));
    double excess = 0.0;
    const auto run_tests = [&] {
      near_.nearest(tests_);
      for (std::size_t n = 0; n < tests_.count; ++n) {
        const double truth = tests_.distance_mm[n];
        if (truth < -parameters_.band_outside_mm) continue;
        const Vector3d p(tests_.x[n], tests_.y[n], tests_.z[n]);
        const double found = field_.interpolate(index, {-1, true, per_mm * (p - origin), per_mm}).distance_mm;
        const double error = std::abs(std::abs(found) - std::abs(truth));
        excess = std::max(excess, error / tolerance_mm(truth));
      }
      tests_.count = 0;
    };
    const auto test = [&](const Vector3d& p) {
      const std::size_t n = tests_.count++;
      tests_.x[n] = p.x();
      tests_.y[n] = p.y();
      tests_.z[n] = p.z();
      if (tests_.count == PointBlock::size) run_tests();
    };
    for (int i = 0; i < MeshField::cells; ++i)
      for (int j = 0; j < MeshField::cells; ++j)
        for (int k = 0; k < MeshField::cells; ++k) {
          const auto cell_index = static_cast<std::size_t>((i * MeshField::cells + j) * MeshField::cells + k);
          const double low = tangents.low_mm[cell_index];
          const double high = tangents.high_mm[cell_index];
          const double middle = 0.5 * (low + high);
          if (high - low <= screen_fraction * tolerance_mm(middle) ||
              high < -parameters_.band_outside_mm - spacing)
            continue;
          const Vector3d corner = origin + spacing * Vector3d(i, j, k);
          test(corner + half);
          // A crease in a large cell is easily missed; deep in the lumen little depends on it.
          const int random_tests = std::abs(middle) > deep_mm ? 0
                                   : spacing > 0.5            ? 12
                                   : spacing > 0.3            ? 4
                                                              : 1;
          for (int n = 0; n < random_tests; ++n)
            test(corner + spacing * Vector3d(random.uniform(), random.uniform(), random.uniform()));
        }
    run_tests();
    return excess;
  }

  void refine_worst_first() {
    while (!worst_.empty()) {
      if (field_.bricks_.size() - unused_.size() + 7 > max_bricks_) {
        out_of_memory_ = true;
        return;
      }
      const std::size_t brick = worst_.top().brick;
      worst_.pop();
      split_brick(brick);
    }
  }

  void split_brick(std::size_t brick) {
    const Cell cell = cells_[brick];
    unused_.push_back(brick);
    split(cell);
  }

  // --- measurement

  std::vector<FieldProbe> probes(std::size_t count, std::uint64_t seed) const {
    return probe_near_wall(field_, closed_, surface_, parameters_, count, seed);
  }

  /// Finds bricks whose own test points were lucky.
  void scout() {
    if (out_of_memory_) return;
    std::vector<std::pair<std::size_t, double>> missed;
    for (const FieldProbe& probe : probes(scout_points, scout_seed)) {
      const double excess = probe.error_mm / parameters_.error_target_mm;
      const MeshField::Reference r = field_.reference_at(probe.point_mm);
      if (excess > 1.0 && !MeshField::is_far(r)) missed.emplace_back(MeshField::index_of(r), excess);
    }
    std::sort(missed.begin(), missed.end(), [](const auto& a, const auto& b) {
      return a.first < b.first || (a.first == b.first && a.second > b.second);
    });
    std::size_t last = std::numeric_limits<std::size_t>::max();
    for (const auto& [brick, excess] : missed) {
      if (brick != last && cells_[brick].level > 0) worst_.push({excess, brick});
      last = brick;
    }
  }

  /// Fills the gaps that splitting left.
  void compact() {
    std::sort(unused_.begin(), unused_.end());
    while (!unused_.empty()) {
      const std::size_t last = field_.bricks_.size() - 1;
      if (unused_.back() == last) {
        unused_.pop_back();
      } else {
        const std::size_t gap = unused_.front();
        unused_.erase(unused_.begin());
        field_.bricks_[gap] = field_.bricks_[last];
        cells_[gap] = cells_[last];
        const auto from =
            field_.samples_.begin() + static_cast<std::ptrdiff_t>(last * MeshField::samples_per_brick);
        std::copy(from, from + static_cast<std::ptrdiff_t>(MeshField::samples_per_brick),
                  field_.samples_.begin() + static_cast<std::ptrdiff_t>(gap * MeshField::samples_per_brick));
        reference(cells_[gap].slot) =
            static_cast<MeshField::Reference>(-1 - 2 * static_cast<std::int64_t>(gap));
      }
      field_.bricks_.pop_back();
      cells_.pop_back();
      field_.samples_.resize(field_.bricks_.size() * MeshField::samples_per_brick);
    }
  }

  void fill_facts() {
    FieldFacts& facts = field_.facts_;
    facts.bricks = field_.bricks_.size();
    facts.bytes = field_.samples_.size() * sizeof(std::uint16_t) +
                  field_.bricks_.size() * sizeof(MeshField::Brick) +
                  field_.far_.size() * sizeof(MeshField::FarCell) +
                  field_.children_.size() * sizeof(field_.children_[0]) +
                  field_.roots_.size() * sizeof(MeshField::Reference);
    facts.finest_spacing_mm = std::numeric_limits<double>::infinity();
    for (const Cell& cell : cells_) {
      const double spacing = size_mm(cell) / MeshField::cells;
      facts.finest_spacing_mm = std::min(facts.finest_spacing_mm, spacing);
      facts.coarsest_spacing_mm = std::max(facts.coarsest_spacing_mm, spacing);
    }
    std::vector<double> errors;
    errors.reserve(report_points);
    for (const FieldProbe& probe : probes(report_points, report_seed)) errors.push_back(probe.error_mm);
    std::sort(errors.begin(), errors.end());
    facts.error_points = errors.size();
    facts.error_p50_mm = errors[errors.size() / 2];
    facts.error_p99_mm = errors[errors.size() * 99 / 100];
    facts.error_max_mm = errors.back();
    facts.refinement_complete = !out_of_memory_ && facts.error_max_mm <= 2.0 * parameters_.error_target_mm;
    facts.lumen_diameter_percentiles_mm = diameter_percentiles_mm(closed_, lumen_);
  }

  FieldParameters parameters_;
  ClosedSurface closed_;
  ExactSurface surface_;
  LumenOfTriangles lumen_;
  std::vector<std::uint16_t> radius_code_;  // of lumen_
  MeshField field_;
  double finest_mm_ = 0.0;
  double base_scale_ = 1.0;
  std::size_t max_bricks_ = 0;
  bool out_of_memory_ = false;
  std::vector<Cell> cells_;          // of each brick
  std::vector<std::size_t> unused_;  // bricks that were split
  std::priority_queue<Worst> worst_;
  // of the brick at hand
  NearTriangles near_{surface_};
  PointBlock nodes_;
  PointBlock tests_;
  Slopes slopes_;
  Vector3d last_middle_mm_ = Vector3d::Zero();
  double last_distance_mm_ = std::numeric_limits<double>::infinity();
};

MeshField MeshField::build(const RepairedMesh& repaired, const FieldParameters& parameters) {
  return MeshFieldBuilder(repaired, parameters).build(key(repaired, parameters));
}

std::uint64_t MeshField::key(const RepairedMesh& repaired, const FieldParameters& parameters) {
  ContentHash hash;
  hash.add(algorithm_version);
  hash.add(content_hash(repaired.mesh));
  for (double value : {parameters.band_outside_mm, parameters.near_mm, parameters.error_target_mm,
                       parameters.error_slope, parameters.min_spacing_mm, parameters.virtual_tube_mm})
    hash.add(value);
  hash.add(parameters.near_outside_mm);
  hash.add(static_cast<std::uint64_t>(parameters.max_bytes));
  return hash.value();
}

}  // namespace endowire::vessel

#include "endowire/vessel/lumen_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr std::int32_t max_levels = 20;  // halvings of the root cell: 3 m down to 3 µm

/// Narrower than the finest wire (0.014 inch, 0.178 mm): no instrument enters, and thinner chords are mostly
/// flaws of the mesh. Smaller values let such flaws fill the memory.
constexpr double narrowest_lumen_mm = 0.2;

/// Half the chord along the inward normal; infinity where there is none.
double half_chord_mm(const ExactSurface& surface, std::size_t triangle) {
  const TriangleMesh& mesh = surface.mesh();
  const Vector3d& normal = surface.normal(triangle);
  if (normal.isZero()) return std::numeric_limits<double>::infinity();
  const Vector3d centre =
      (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0;
  return 0.5 * surface.bvh().cast(centre, -normal, 1e-6, std::numeric_limits<double>::infinity()).distance_mm;
}

/// The median, by area, over each triangle and those it shares a vertex with.
std::vector<double> median_of_neighbours(const TriangleMesh& mesh,
                                         const std::vector<std::vector<std::int32_t>>& around,
                                         const std::vector<double>& values) {
  std::vector<double> medians(values.size());
  std::vector<std::pair<double, double>> ring;  // value, area
  for (std::size_t t = 0; t < values.size(); ++t) {
    ring.clear();
    double area = 0.0;
    for (std::int32_t v : mesh.triangles[t])
      for (std::int32_t n : around[static_cast<std::size_t>(v)]) {
        const auto neighbour = static_cast<std::size_t>(n);
        ring.emplace_back(values[neighbour], mesh.area_normal(neighbour).norm());
        area += ring.back().second;
      }
    std::sort(ring.begin(), ring.end());
    double below = 0.0;
    for (const auto& [value, weight] : ring) {
      medians[t] = value;
      below += weight;
      if (below >= 0.5 * area) break;
    }
  }
  return medians;
}

/// Half chords without outliers. Two medians: what a hole that was filled leaves around it is a ring wide.
std::vector<double> lumen_radii_mm(const ExactSurface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  const std::size_t count = mesh.triangles.size();
  std::vector<double> chords(count);
  for (std::size_t t = 0; t < count; ++t) chords[t] = half_chord_mm(surface, t);
  std::vector<std::vector<std::int32_t>> around(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < count; ++t)
    for (std::int32_t v : mesh.triangles[t])
      around[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(t));
  return median_of_neighbours(mesh, around, median_of_neighbours(mesh, around, chords));
}

}  // namespace

class LumenGraphBuilder {
 public:
  LumenGraphBuilder(const LumenSpace& lumen, double cells_per_radius, std::size_t max_nodes,
                    LumenGraph& graph)
      : lumen_(lumen), graph_(graph), max_nodes_(max_nodes), part_(1.0 / cells_per_radius) {
    const TriangleMesh& mesh = lumen.surface().mesh();
    radii_ = lumen_radii_mm(lumen.surface());
    for (double& r : radii_) r = std::max(r, narrowest_lumen_mm);
    boxes_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < boxes_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) boxes_[t].extend(mesh.corner(t, k));
    const Eigen::AlignedBox3d box = bounds_mm(mesh);
    root_mm_ = 1.001 * box.sizes().maxCoeff();
    origin_mm_ = box.center() - Vector3d::Constant(0.5 * root_mm_);
  }

  void build() {
    while (expected_nodes() > static_cast<double>(max_nodes_)) part_ *= 1.2;
    while (!divide()) part_ *= 1.6;
    join();
  }

 private:
  struct Cell {
    std::array<std::int32_t, 3> at;  ///< lowest corner, in cells of this level
    std::int32_t level;              ///< halvings from the root
  };
  using Reference = std::int32_t;  ///< ≥ 0: eight children; -1: not in the lumen; ≤ -2: node -2 - r

  double size_mm(std::int32_t level) const { return root_mm_ / static_cast<double>(1 << level); }
  Vector3d centre_mm(const Cell& cell) const {
    return origin_mm_ +
           size_mm(cell.level) * (Vector3d(cell.at[0], cell.at[1], cell.at[2]) + Vector3d::Constant(0.5));
  }
  double target_mm(double radius_mm) const { return part_ * radius_mm; }

  /// The volume before each triangle, area · R / 2, over that of the cells it asks for, at most part · R and half
  /// that at least.
  double expected_nodes() const {
    double nodes = 0.0;
    for (std::size_t t = 0; t < radii_.size(); ++t) {
      const double cell = 0.75 * target_mm(radii_[t]);
      const double depth = std::isfinite(radii_[t]) ? 0.5 * radii_[t] : 0.0;
      nodes += 0.5 * lumen_.surface().mesh().area_normal(t).norm() * depth / (cell * cell * cell);
    }
    return nodes;
  }

  /// False when there would be too many nodes.
  bool divide() {
    graph_.nodes_.clear();
    cells_.clear();
    children_.clear();
    full_ = false;
    std::vector<std::int32_t> all(radii_.size());
    for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<std::int32_t>(t);
    root_ = divide({{0, 0, 0}, 0}, all);
    return !full_;
  }

  Reference divide(const Cell& cell, const std::vector<std::int32_t>& candidates) {
    if (full_) return -1;
    const double size = size_mm(cell.level);
    const Vector3d centre = centre_mm(cell);
    const Eigen::AlignedBox3d box(Vector3d(centre - Vector3d::Constant(0.5 * size)),
                                  Vector3d(centre + Vector3d::Constant(0.5 * size)));
    std::vector<std::int32_t> touching;
    double narrowest_mm = std::numeric_limits<double>::infinity();
    for (std::int32_t t : candidates) {
      if (!box.intersects(boxes_[static_cast<std::size_t>(t)])) continue;
      touching.push_back(t);
      narrowest_mm = std::min(narrowest_mm, radii_[static_cast<std::size_t>(t)]);
    }
    if (!touching.empty() && size > target_mm(narrowest_mm) && cell.level < max_levels)
      return split(cell, touching);
    const LumenSpace::Sample s = sample(centre, touching, 0.5 * size);
    if (touching.empty() && s.reach_mm > 0.0 && cell.level < max_levels &&
        size > target_mm(radii_[static_cast<std::size_t>(s.triangle)]))
      return split(cell, touching);
    if (s.reach_mm <= 0.0 || lumen_.beyond_opening(centre)) return -1;
    if (graph_.nodes_.size() >= max_nodes_) full_ = true;
    graph_.nodes_.push_back({centre, s.radius_mm, s.reach_mm, size});
    cells_.push_back(cell);
    return -1 - static_cast<Reference>(graph_.nodes_.size());
  }

  /// @param touching  all triangles that may be nearer than half_mm
  LumenSpace::Sample sample(const Vector3d& centre, const std::vector<std::int32_t>& touching,
                            double half_mm) {
    constexpr std::size_t few = 12;  // more take longer to try than the tree to search
    LumenSpace::Sample s;
    if (!touching.empty() && touching.size() <= few) {
      s = lumen_.at(centre, touching, half_mm);
    } else {  // the cell before this one lies near by: it tells how far the surface can be
      const double within = last_mm_ + (centre - last_centre_mm_).norm();
      s = lumen_.at(centre, within * (1.0 + 1e-9) + 1e-9);
    }
    last_mm_ = std::abs(s.reach_mm);
    last_centre_mm_ = centre;
    return s;
  }

  Reference split(const Cell& cell, const std::vector<std::int32_t>& candidates) {
    const std::size_t group = children_.size();
    children_.emplace_back();
    for (std::int32_t o = 0; o < 8; ++o) {
      const Cell child{{2 * cell.at[0] + (o & 1), 2 * cell.at[1] + ((o >> 1) & 1), 2 * cell.at[2] + (o >> 2)},
                       cell.level + 1};
      const Reference reference = divide(child, candidates);
      children_[group][static_cast<std::size_t>(o)] = reference;
    }
    return static_cast<Reference>(group);
  }

  /// The node whose cell holds that of `cell`; -1 when there is none, or only smaller ones.
  std::int32_t node_around(const Cell& cell) const {
    Reference reference = root_;
    for (std::int32_t level = cell.level - 1; reference >= 0; --level) {
      if (level < 0) return -1;
      const auto octant =
          static_cast<std::size_t>(((cell.at[0] >> level) & 1) | (((cell.at[1] >> level) & 1) << 1) |
                                   (((cell.at[2] >> level) & 1) << 2));
      reference = children_[static_cast<std::size_t>(reference)][octant];
    }
    return reference == -1 ? -1 : -2 - reference;
  }

  /// Every cell looks for neighbours of its own size or larger; each pair is found by its smaller one.
  void join() {
    struct Link {
      std::int32_t from, to;
    };
    std::vector<Link> links;
    std::vector<std::int32_t> found;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      found.clear();
      const std::int32_t end = 1 << cells_[n].level;
      for (std::int32_t d = 0; d < 27; ++d) {
        Cell beside = cells_[n];
        beside.at = {beside.at[0] + d % 3 - 1, beside.at[1] + d / 3 % 3 - 1, beside.at[2] + d / 9 - 1};
        if (d == 13 || *std::min_element(beside.at.begin(), beside.at.end()) < 0 ||
            *std::max_element(beside.at.begin(), beside.at.end()) >= end)
          continue;
        const std::int32_t other = node_around(beside);
        if (other >= 0 && overlap(static_cast<std::int32_t>(n), other)) found.push_back(other);
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      for (std::int32_t other : found) {
        const bool same_size = cells_[static_cast<std::size_t>(other)].level == cells_[n].level;
        links.push_back({static_cast<std::int32_t>(n), other});
        if (!same_size) links.push_back({other, static_cast<std::int32_t>(n)});
      }
    }
    graph_.first_link_.assign(cells_.size() + 1, 0);
    for (const Link& link : links) ++graph_.first_link_[static_cast<std::size_t>(link.from) + 1];
    for (std::size_t n = 0; n < cells_.size(); ++n) graph_.first_link_[n + 1] += graph_.first_link_[n];
    graph_.links_.resize(links.size());
    std::vector<std::size_t> next(graph_.first_link_.begin(), graph_.first_link_.end() - 1);
    for (const Link& link : links) graph_.links_[next[static_cast<std::size_t>(link.from)]++] = link.to;
  }

  bool overlap(std::int32_t a, std::int32_t b) const {
    const double reach_mm = graph_[a].reach_mm + graph_[b].reach_mm;
    return (graph_[a].position_mm - graph_[b].position_mm).squaredNorm() <= reach_mm * reach_mm;
  }

  const LumenSpace& lumen_;
  LumenGraph& graph_;
  std::size_t max_nodes_;
  double part_;  ///< of the lumen's radius that a cell may measure
  std::vector<double> radii_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  double root_mm_ = 0.0;
  Vector3d origin_mm_ = Vector3d::Zero();
  Reference root_ = -1;
  std::vector<std::array<Reference, 8>> children_;
  std::vector<Cell> cells_;
  Vector3d last_centre_mm_ = Vector3d::Zero();
  double last_mm_ = std::numeric_limits<double>::infinity();
  bool full_ = false;
};

LumenGraph::LumenGraph(const LumenSpace& lumen, double cells_per_radius, std::size_t max_nodes) {
  LumenGraphBuilder(lumen, cells_per_radius, max_nodes, *this).build();
}

}  // namespace endowire::vessel

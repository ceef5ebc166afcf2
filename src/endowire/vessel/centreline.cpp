#include "endowire/vessel/centreline.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "endowire/vessel/centreline_assembly.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/ridge.hpp"
#include "endowire/vessel/tree_growth.hpp"
#include "endowire/vessel/vessel_lines.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

constexpr std::uint64_t algorithm_version = 2;  // part of the key: old caches die with a change of results

/// A piece of lumen counts when it has an opening, or this part of the largest piece's volume: less is debris
/// of the mesh, or a corner the graph does not reach.
constexpr double min_volume_part = 1e-3;
/// More pieces than that are a shattered mesh; the largest are followed.
constexpr std::size_t max_pieces = 64;
/// Two pieces behind one surface mean a narrow place that the graph missed: it is looked at again this much finer.
constexpr double finer = 1.6;
constexpr int finer_attempts = 1;
/// Vessels that leave within this part of the radius of each other leave at one bifurcation.
constexpr double same_place_part = 0.5;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// A connected part of the lumen.
struct Piece {
  Index deepest = -1;  ///< node of the largest inscribed ball
  double volume_mm3 = 0.0;
  std::vector<TreeGrowth::End> openings;
};

/// The node nearest to an opening.
Index node_at(const LumenGraph& graph, const Opening& opening) {
  Index best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Index n = 0; at(n) < graph.size(); ++n) {
    const double distance = (graph[n].position_mm - opening.centre_mm).squaredNorm();
    if (distance >= least || graph.neighbours(n).empty()) continue;
    least = distance;
    best = n;
  }
  return best;
}

/// Middle and radius of the lumen in the plane of an opening.
RidgePoint opening_ridge(const LumenSpace& lumen, const Opening& opening) {
  const Vector3d just_inside = opening.centre_mm - 1e-6 * opening.diameter_mm * opening.direction;
  RidgePoint ridge = climb_to_ridge(lumen, just_inside, opening.direction, 0.25 * opening.diameter_mm);
  if (ridge.radius_mm <= 0.0) ridge.radius_mm = 0.5 * opening.diameter_mm;
  return ridge;
}

/// The parts of the lumen that count, largest first.
std::vector<Piece> pieces_of(const LumenSpace& lumen, const LumenGraph& graph,
                             const std::vector<Opening>& openings) {
  std::vector<Index> piece_of(graph.size(), -1);
  std::vector<Piece> all;
  std::vector<Index> open;
  for (Index seed = 0; at(seed) < graph.size(); ++seed) {
    if (piece_of[at(seed)] >= 0) continue;
    const auto number = static_cast<Index>(all.size());
    Piece& piece = all.emplace_back();
    piece.deepest = seed;
    piece_of[at(seed)] = number;
    open.assign(1, seed);
    while (!open.empty()) {
      const Index n = open.back();
      open.pop_back();
      piece.volume_mm3 += std::pow(graph[n].cell_mm, 3);
      const double gain = graph[n].radius_mm - graph[piece.deepest].radius_mm;
      if (gain > 0.0 || (gain == 0.0 && n < piece.deepest)) piece.deepest = n;
      for (Index next : graph.neighbours(n)) {
        if (piece_of[at(next)] >= 0) continue;
        piece_of[at(next)] = number;
        open.push_back(next);
      }
    }
  }
  for (const Opening& opening : openings) {
    const Index node = node_at(graph, opening);
    if (node < 0) continue;
    const RidgePoint ridge = opening_ridge(lumen, opening);
    all[at(piece_of[at(node)])].openings.push_back(
        {node, opening.number, ridge.position_mm, ridge.radius_mm});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Piece& a, const Piece& b) { return a.volume_mm3 > b.volume_mm3; });
  std::vector<Piece> counting;
  for (const Piece& piece : all) {
    const double least = counting.empty() ? 0.0 : min_volume_part * counting.front().volume_mm3;
    if (piece.openings.empty() && (piece.volume_mm3 < least || graph.neighbours(piece.deepest).empty()))
      continue;
    // Where a mesh is flawed its normals may call the outside inside.
    if (winding_number(lumen.surface().mesh(), graph[piece.deepest].position_mm) <= 0.5) continue;
    counting.push_back(piece);
    if (counting.size() == max_pieces) break;
  }
  return counting;
}

/// True when two pieces are bounded by one connected surface: they are one lumen, then, and the graph missed a
/// narrow place between them.
bool share_a_surface(const LumenSpace& lumen, const LumenGraph& graph, const std::vector<Piece>& pieces) {
  if (pieces.size() < 2) return false;
  const TriangleMesh& mesh = lumen.surface().mesh();
  std::vector<Index> parent(mesh.vertices_mm.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 1; k < 3; ++k) parent[at(root(t[k]))] = root(t[0]);
  std::vector<Index> surfaces;
  surfaces.reserve(pieces.size());
  for (const Piece& piece : pieces)
    surfaces.push_back(root(mesh.triangles[at(lumen.at(graph[piece.deepest].position_mm).triangle)][0]));
  std::sort(surfaces.begin(), surfaces.end());
  return std::adjacent_find(surfaces.begin(), surfaces.end()) != surfaces.end();
}

/// One piece of lumen becomes vessels.
class Extraction {
 public:
  Extraction(const CentrelineParameters& parameters, const LumenSpace& lumen, const LumenGraph& graph)
      : parameters_(parameters), lumen_(lumen), graph_(graph) {}

  /// Appends the vessels of a piece, its root vessel first.
  void add(const Piece& piece, std::vector<PlacedLine>& placed) {
    // The search begins at the widest opening, else at the deepest point; then again at the root.
    const auto wider = [](const TreeGrowth::End& a, const TreeGrowth::End& b) {
      return a.radius_mm < b.radius_mm;
    };
    const auto& [place_mm, radius_mm, reach_mm, cell_mm] = graph_[piece.deepest];
    const TreeGrowth::End source =
        piece.openings.empty() ? TreeGrowth::End{piece.deepest, 0, place_mm, radius_mm}
                               : *std::max_element(piece.openings.begin(), piece.openings.end(), wider);
    const TreeGrowth first = grown(piece, source);
    const std::vector<TreeGrowth::End> ends = ends_of(first, piece);
    const TreeGrowth::End root = ends.empty() ? source : ends[root_of(ends)];
    if (root.node == source.node)
      place(vessel_lines(first), piece.openings, root, ends.empty(), placed);
    else
      place(vessel_lines(grown(piece, root)), piece.openings, root, false, placed);
  }

 private:
  [[nodiscard]] TreeGrowth grown(const Piece& piece, const TreeGrowth::End& root) const {
    TreeGrowth growth(lumen_, graph_, root);
    for (const TreeGrowth::End& end : piece.openings)
      if (end.node != root.node) growth.add(end);
    growth.search();
    growth.close_loops();
    return growth;
  }

  /// The ends of the lumen; places where loops were cut are none.
  [[nodiscard]] static std::vector<TreeGrowth::End> ends_of(const TreeGrowth& growth, const Piece& piece) {
    std::vector<TreeGrowth::End> ends = piece.openings;
    std::vector<bool> leaf(growth.points().size(), true);
    for (const TreeGrowth::Point& p : growth.points())
      if (p.parent >= 0) leaf[at(p.parent)] = false;
    for (const TreeGrowth::Tip& tip : growth.tips()) {
      const TreeGrowth::Point& p = growth.points()[at(tip.point)];
      if (tip.opening == 0 && leaf[at(tip.point)] && tip.rejoins < 0)
        ends.push_back({p.node, 0, p.centre_mm, p.radius_mm});
    }
    return ends;
  }

  [[nodiscard]] std::size_t root_of(const std::vector<TreeGrowth::End>& ends) const {
    std::size_t root = 0;
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const double score = parameters_.root_near_mm ? -(ends[i].centre_mm - *parameters_.root_near_mm).norm()
                                                    : ends[i].radius_mm;
      if (score <= best) continue;
      best = score;
      root = i;
    }
    return root;
  }

  void place(std::vector<VesselLine> lines, const std::vector<TreeGrowth::End>& openings,
             const TreeGrowth::End& root, bool inner_root, std::vector<PlacedLine>& placed) const {
    const auto offset = static_cast<Index>(placed.size());
    std::vector<std::vector<std::size_t>> children(lines.size());
    for (std::size_t l = 0; l < lines.size(); ++l)
      if (lines[l].parent >= 0) children[at(lines[l].parent)].push_back(l);
    for (std::size_t l = 0; l < lines.size(); ++l) {
      VesselLine& line = lines[l];
      PlacedLine& out = placed.emplace_back();
      out.parent = line.parent < 0 ? -1 : line.parent + offset;
      out.leaves_at = line.leaves_at;
      out.opening = line.opening;
      out.end = line.cut           ? CentrelineEndKind::cut
                : line.opening > 0 ? CentrelineEndKind::opening
                                   : CentrelineEndKind::cap;
      if (line.cut && line.rejoins >= 0) {
        out.rejoins = line.rejoins + offset;
        out.rejoins_mm = line.path_mm.back();
      }
      for (const TreeGrowth::End& end : openings)
        if (end.opening == line.opening) line.path_mm.push_back(end.centre_mm);
      LineEnd start = LineEnd::fixed;
      if (line.parent < 0 && !inner_root) {
        out.root_is_end = true;
        out.root_opening = root.opening;
        if (root.opening == 0) start = LineEnd::closed;
      }
      const LineEnd end = out.end == CentrelineEndKind::cap ? LineEnd::closed : LineEnd::fixed;
      const FittedLine* parent = line.parent < 0 ? nullptr : &placed[at(out.parent)].fit;
      out.fit = fit_line(lumen_, line.path_mm, start, end, parent, parameters_.points_per_radius);
      attach(placed.back(), children[l], offset, lines);
    }
  }

  /// The point of a fitted vessel where a place of its raw path is now.
  static std::size_t point_near(const std::vector<CentrelinePoint>& points, const Vector3d& place_mm) {
    std::size_t nearest = 0;
    std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      // Among points whose balls hold the place, the nearest; else the ball that nearly does.
      const double distance = (points[i].position_mm - place_mm).norm();
      const bool outside = distance > points[i].radius_mm;
      const std::pair<bool, double> score{outside, outside ? distance - points[i].radius_mm : distance};
      if (score >= least) continue;
      least = score;
      nearest = i;
    }
    return nearest;
  }

  /// Gives the vessels that leave a fitted one their place on it.
  static void attach(const PlacedLine& line, const std::vector<std::size_t>& children, Index offset,
                     std::vector<VesselLine>& lines) {
    const std::vector<CentrelinePoint>& points = line.fit.points;
    std::vector<std::pair<std::size_t, std::size_t>> leaving;  // place, line
    for (std::size_t child : children) {
      const std::size_t place = point_near(points, lines[child].path_mm.front());
      leaving.emplace_back(line.parent < 0 ? std::max<std::size_t>(1, place) : place, child);
    }
    std::stable_sort(leaving.begin(), leaving.end());
    for (std::size_t k = 0; k < leaving.size(); ++k) {
      auto& [place, child] = leaving[k];
      if (k > 0) {
        const CentrelinePoint& before = points[leaving[k - 1].first];
        if (points[place].arc_mm - before.arc_mm < same_place_part * before.radius_mm)
          place = leaving[k - 1].first;
      }
      lines[child].leaves_at = place;
      lines[child].path_mm.front() = points[place].position_mm;
      if (place > 0) continue;
      // It leaves where this vessel begins: from the same parent, then.
      lines[child].parent = line.parent - offset;
      lines[child].leaves_at = line.leaves_at;
    }
  }

  const CentrelineParameters& parameters_;
  const LumenSpace& lumen_;
  const LumenGraph& graph_;
};

}  // namespace

CentrelineTree extract_centrelines(const RepairedMesh& repaired, const CentrelineParameters& parameters) {
  const LumenSpace lumen(repaired);
  double cells_per_radius = parameters.cells_per_radius;
  auto graph = std::make_unique<LumenGraph>(lumen, cells_per_radius, parameters.max_nodes);
  std::vector<Piece> pieces = pieces_of(lumen, *graph, repaired.openings);
  for (int attempt = 0; attempt < finer_attempts && share_a_surface(lumen, *graph, pieces); ++attempt) {
    cells_per_radius *= finer;
    auto next = std::make_unique<LumenGraph>(lumen, cells_per_radius, parameters.max_nodes);
    std::vector<Piece> fewer = pieces_of(lumen, *next, repaired.openings);
    if (fewer.size() >= pieces.size()) break;
    pieces = std::move(fewer);
    graph = std::move(next);
  }
  std::vector<PlacedLine> lines;
  Extraction extraction(parameters, lumen, *graph);
  for (const Piece& piece : pieces) extraction.add(piece, lines);
  return assemble_tree(lines);
}

std::uint64_t centreline_key(const RepairedMesh& repaired, const CentrelineParameters& parameters) {
  ContentHash hash;
  hash.add(algorithm_version);
  hash.add(content_hash(repaired.mesh));
  hash.add(parameters.cells_per_radius);
  hash.add(parameters.points_per_radius);
  hash.add(static_cast<std::uint64_t>(parameters.max_nodes));
  hash.add(static_cast<std::uint64_t>(parameters.root_near_mm ? 1 : 0));
  if (parameters.root_near_mm)
    for (int k = 0; k < 3; ++k) hash.add((*parameters.root_near_mm)[k]);
  return hash.value();
}

}  // namespace endowire::vessel

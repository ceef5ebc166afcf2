#include "endowire/vessel/repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "endowire/base/error.hpp"
#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

bool lexicographic(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void check_extent(double extent_mm, const std::string& file, LengthUnit unit) {
  if (extent_mm >= min_extent_mm && extent_mm <= max_extent_mm) return;
  std::string message = file + ": extent is " + rounded(extent_mm) + " mm; must be " +
                        rounded(min_extent_mm) + " … " + rounded(max_extent_mm) + " mm";
  for (LengthUnit other : {LengthUnit::millimetre, LengthUnit::metre, LengthUnit::centimetre}) {
    const double guess = extent_mm / millimetres_in(unit) * millimetres_in(other);
    if (other == unit || guess < 10.0 * min_extent_mm || guess > max_extent_mm) continue;
    const char* saved = other == LengthUnit::metre        ? "metres"
                        : other == LengthUnit::centimetre ? "centimetres"
                                                          : "millimetres";
    message +=
        std::string("; was it saved in ") + saved + "? then unit = \"" + std::string(name_of(other)) + "\"";
    break;
  }
  throw base::InputError(message);
}

/// Vertices sorted by coordinates, each corner of the soup mapped to one; depends on no order.
TriangleMesh merge_points(const TriangleMesh& soup, double tolerance_mm) {
  const std::size_t corners = 3 * soup.triangles.size();
  std::vector<Index> by_place(corners);
  std::iota(by_place.begin(), by_place.end(), 0);
  const auto corner = [&](Index i) -> const Vector3d& { return soup.corner(at(i) / 3, at(i) % 3); };
  std::sort(by_place.begin(), by_place.end(),
            [&](Index a, Index b) { return lexicographic(corner(a), corner(b)); });

  struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      auto h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ULL;
      h = (h ^ static_cast<std::uint64_t>(c.y)) * 0xC2B2AE3D27D4EB4FULL;
      h = (h ^ static_cast<std::uint64_t>(c.z)) * 0x165667B19E3779F9ULL;
      return static_cast<std::size_t>(h ^ (h >> 32));
    }
  };
  std::unordered_map<Cell, Index, CellHash> grid;
  const auto cell_of = [&](const Vector3d& p) {
    return Cell{static_cast<std::int64_t>(std::floor(p.x() / tolerance_mm)),
                static_cast<std::int64_t>(std::floor(p.y() / tolerance_mm)),
                static_cast<std::int64_t>(std::floor(p.z() / tolerance_mm))};
  };
  TriangleMesh mesh;
  mesh.triangles.resize(soup.triangles.size());
  const Vector3d* previous = nullptr;
  Index vertex = -1;
  for (Index c : by_place) {
    const Vector3d& p = corner(c);
    if (previous == nullptr || *previous != p) {
      const Cell home = cell_of(p);
      vertex = -1;
      for (std::int64_t dx = -1; dx <= 1 && vertex < 0; ++dx)
        for (std::int64_t dy = -1; dy <= 1 && vertex < 0; ++dy)
          for (std::int64_t dz = -1; dz <= 1 && vertex < 0; ++dz) {
            const auto found = grid.find({home.x + dx, home.y + dy, home.z + dz});
            if (found != grid.end() && (mesh.vertices_mm[at(found->second)] - p).norm() <= tolerance_mm)
              vertex = found->second;
          }
      if (vertex < 0) {
        vertex = static_cast<Index>(mesh.vertices_mm.size());
        mesh.vertices_mm.push_back(p);
        grid.emplace(home, vertex);
      }
      previous = &p;
    }
    mesh.triangles[at(c) / 3][at(c) % 3] = vertex;
  }
  return mesh;
}

std::array<Index, 3> sorted(std::array<Index, 3> t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Smallest index first, cyclic order kept.
void rotate_smallest_first(std::array<Index, 3>& t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
}

void drop_bad_triangles(TriangleMesh& mesh, MeshReport& report) {
  std::vector<std::array<Index, 3>> kept;
  kept.reserve(mesh.triangles.size());
  for (std::array<Index, 3> t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++report.degenerate_triangles;
      continue;
    }
    rotate_smallest_first(t);
    kept.push_back(t);
  }
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    const auto sa = sorted(a);
    const auto sb = sorted(b);
    return sa < sb || (sa == sb && a < b);
  });
  const auto last = std::unique(kept.begin(), kept.end(),
                                [](const auto& a, const auto& b) { return sorted(a) == sorted(b); });
  report.duplicate_triangles = static_cast<std::size_t>(kept.end() - last);
  kept.erase(last, kept.end());
  mesh.triangles = std::move(kept);

  std::vector<Index> new_index(mesh.vertices_mm.size(), -1);  // vertices of dropped triangles only go too
  for (const auto& t : mesh.triangles)
    for (Index v : t) new_index[at(v)] = 0;
  std::vector<Vector3d> used;
  for (std::size_t v = 0; v < new_index.size(); ++v)
    if (new_index[v] == 0) {
      new_index[v] = static_cast<Index>(used.size());
      used.push_back(mesh.vertices_mm[v]);
    }
  for (auto& t : mesh.triangles)
    for (Index& v : t) v = new_index[at(v)];
  mesh.vertices_mm = std::move(used);
}

struct HalfEdge {
  Index low, high;  ///< vertices
  Index triangle;
  bool forward;  ///< runs from low to high in its triangle
};

/// All half-edges, those of one edge side by side.
std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k];
      const Index b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  return edges;
}

template <typename Visit>  // visit(first, last) for every edge
void for_each_edge(const std::vector<HalfEdge>& edges, Visit visit) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    visit(&edges[i], &edges[i] + (j - i));
    i = j;
  }
}

void flip(TriangleMesh& mesh, std::size_t t) {
  std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

/// Makes neighbours over manifold edges agree, each patch after the larger area of the file's orientation,
/// and numbers the components (connected over any edge). Returns the component of each triangle.
std::vector<Index> orient_patches(TriangleMesh& mesh, MeshReport& report) {
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  struct Link {
    Index other;
    bool agree;
  };
  const std::size_t count = mesh.triangles.size();
  std::vector<std::array<Link, 3>> links(count);
  std::vector<std::uint8_t> degree(count, 0);
  std::vector<Index> parent(count);  // union-find over any shared edge
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index t) {
    while (parent[at(t)] != t) t = parent[at(t)] = parent[at(parent[at(t)])];
    return t;
  };
  for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first > 2) ++report.non_manifold_edges;
    for (const HalfEdge* e = first + 1; e < last; ++e) {
      const Index a = root(first->triangle);
      const Index b = root(e->triangle);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
    if (last - first != 2) return;
    const bool agree = first[0].forward != first[1].forward;
    const auto add = [&](Index t, Index other) {
      std::uint8_t& n = degree[at(t)];
      if (n < 3) links[at(t)][n++] = {other, agree};
    };
    add(first[0].triangle, first[1].triangle);
    add(first[1].triangle, first[0].triangle);
  });

  std::vector<std::int8_t> turn(count, 0);  // +1 as in the file, -1 against it
  std::vector<Index> patch;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (turn[seed] != 0) continue;
    patch.assign(1, static_cast<Index>(seed));
    turn[seed] = 1;
    double balance = 0.0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::size_t t = at(patch[i]);
      balance += turn[t] * mesh.area_normal(t).norm();
      for (std::uint8_t k = 0; k < degree[t]; ++k) {
        const Link& link = links[t][k];
        if (turn[at(link.other)] != 0) continue;
        turn[at(link.other)] = static_cast<std::int8_t>(link.agree ? turn[t] : -turn[t]);
        patch.push_back(link.other);
      }
    }
    if (balance < 0.0)
      for (Index t : patch) turn[at(t)] = static_cast<std::int8_t>(-turn[at(t)]);
  }
  for (std::size_t t = 0; t < count; ++t)
    if (turn[t] < 0) {
      flip(mesh, t);
      ++report.flipped_triangles;
    }
  std::vector<Index> component(count);
  std::vector<Index> number(count, -1);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t r = at(root(static_cast<Index>(t)));
    if (number[r] < 0) number[r] = static_cast<Index>(report.components++);
    component[t] = number[r];
  }
  return component;
}

struct Loop {
  std::vector<Index>
      vertices;    ///< along the boundary half-edges: the mesh lies to the left seen from outside
  Index triangle;  ///< one at the boundary
};

/// Boundary loops in the order of their smallest vertex, each beginning with it.
std::vector<Loop> boundary_loops(const TriangleMesh& mesh) {
  struct Border {
    Index to;
    Index triangle;
  };
  std::unordered_map<Index, std::vector<Border>> leaving;
  std::vector<Index> starts;
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    // What neighbours do not balance is border: also at edges of three triangles, so that loops always close.
    std::ptrdiff_t balance = 0;
    for (const HalfEdge* e = first; e < last; ++e) balance += e->forward ? 1 : -1;
    const Index from = balance > 0 ? first->low : first->high;
    const Index to = balance > 0 ? first->high : first->low;
    for (std::ptrdiff_t k = 0; k < std::abs(balance); ++k) {
      leaving[from].push_back({to, first->triangle});
      starts.push_back(from);
    }
  });
  std::sort(starts.begin(), starts.end());
  std::vector<Loop> loops;
  for (Index start : starts) {
    while (!leaving[start].empty()) {
      // A walk that comes back to a vertex it has passed closes a loop there: pinched loops fall apart.
      std::vector<Index> walk{start};
      Index triangle = leaving[start].front().triangle;
      while (!walk.empty()) {
        std::vector<Border>& out = leaving[walk.back()];
        if (out.empty()) {  // an open end at a non-manifold edge: no loop
          walk.clear();
          break;
        }
        const Border next = out.front();
        out.erase(out.begin());
        triangle = next.triangle;
        const auto seen = std::find(walk.begin(), walk.end(), next.to);
        if (seen == walk.end()) {
          walk.push_back(next.to);
          continue;
        }
        Loop loop{{seen, walk.end()}, triangle};
        std::rotate(loop.vertices.begin(), std::min_element(loop.vertices.begin(), loop.vertices.end()),
                    loop.vertices.end());
        const Index again = *seen;
        walk.erase(seen, walk.end());
        if (loop.vertices.size() >= 3) loops.push_back(std::move(loop));
        if (!walk.empty()) walk.push_back(again);
      }
    }
  }
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.vertices < b.vertices; });
  return loops;
}

Vector3d loop_centre(const TriangleMesh& mesh, const std::vector<Index>& loop) {
  Vector3d sum = Vector3d::Zero();
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {  // weighted by length: uneven points do not shift it
    const Vector3d& a = mesh.vertices_mm[at(loop[i])];
    const Vector3d& b = mesh.vertices_mm[at(loop[(i + 1) % loop.size()])];
    sum += (b - a).norm() * 0.5 * (a + b);
    length += (b - a).norm();
  }
  return length > 0.0 ? Vector3d(sum / length) : mesh.vertices_mm[at(loop[0])];
}

/// Vector area of the loop's fan; with the mesh facing outward it points into the vessel.
Vector3d loop_area(const TriangleMesh& mesh, const std::vector<Index>& loop, const Vector3d& centre) {
  Vector3d twice = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    twice += (mesh.vertices_mm[at(loop[i])] - centre)
                 .cross(mesh.vertices_mm[at(loop[(i + 1) % loop.size()])] - centre);
  return 0.5 * twice;
}

/// The components, each closed by fans over its loops, face outward, or inward where they lie in another one.
void orient_components(TriangleMesh& mesh, const std::vector<Index>& component, MeshReport& report) {
  const std::size_t components = report.components;
  std::vector<TriangleMesh> closed(components);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    TriangleMesh& part = closed[at(component[t])];
    for (std::size_t k = 0; k < 3; ++k) part.vertices_mm.push_back(mesh.corner(t, k));
  }
  for (const Loop& loop : boundary_loops(mesh)) {
    TriangleMesh& part = closed[at(component[at(loop.triangle)])];
    const Vector3d centre = loop_centre(mesh, loop.vertices);
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      part.vertices_mm.push_back(mesh.vertices_mm[at(loop.vertices[(i + 1) % loop.vertices.size()])]);
      part.vertices_mm.push_back(mesh.vertices_mm[at(loop.vertices[i])]);
      part.vertices_mm.push_back(centre);
    }
  }
  std::vector<Eigen::AlignedBox3d> boxes(components);
  std::vector<double> volumes(components);
  for (std::size_t c = 0; c < components; ++c) {
    TriangleMesh& part = closed[c];
    for (std::size_t i = 0; i + 2 < part.vertices_mm.size(); i += 3)
      part.triangles.push_back({static_cast<Index>(i), static_cast<Index>(i + 1), static_cast<Index>(i + 2)});
    boxes[c] = bounds_mm(part);
    volumes[c] = signed_volume_mm3(part);
  }
  const double largest = std::abs(*std::max_element(
      volumes.begin(), volumes.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  std::vector<bool> turn(components, false);
  double file_volume = 0.0;
  constexpr std::size_t max_nested = 64;  // more pieces than that are debris: each simply faces outward
  for (std::size_t c = 0; c < components; ++c) {
    int depth = 0;
    for (std::size_t other = 0; other < components && components <= max_nested; ++other) {
      if (other == c || !boxes[other].contains(boxes[c])) continue;
      if (std::abs(winding_number(closed[other], closed[c].vertices_mm[0])) > 0.5) ++depth;
    }
    const double wanted = depth % 2 == 0 ? 1.0 : -1.0;
    turn[c] = volumes[c] * wanted < 0.0;
    if (depth > 0 && std::abs(volumes[c]) > 0.01 * largest) report.wall_with_thickness = true;
    file_volume += wanted * volumes[c];
  }
  report.inward_in_file = file_volume < 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (turn[at(component[t])]) {
      flip(mesh, t);
      ++report.flipped_triangles;
    }
}

/// Diameter of the lumen beside a loop: the median of rays across it from the triangles that touch the loop.
double lumen_beside_mm(const TriangleMesh& mesh, const TriangleBvh& bvh, const std::vector<Index>& loop,
                       const std::vector<std::vector<Index>>& around) {
  std::vector<Index> near;
  for (Index v : loop)
    for (Index t : around[at(v)])
      for (Index w : mesh.triangles[at(t)])
        near.insert(near.end(), around[at(w)].begin(), around[at(w)].end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<double> across;
  for (Index t : near) {
    const Vector3d normal = mesh.area_normal(at(t)).stableNormalized();
    if (normal.squaredNorm() < 0.5) continue;
    const Vector3d centre = (mesh.corner(at(t), 0) + mesh.corner(at(t), 1) + mesh.corner(at(t), 2)) / 3.0;
    const TriangleBvh::Hit hit = bvh.cast(centre, -normal, 1e-6, 2.0 * max_extent_mm);
    if (hit.triangle >= 0) across.push_back(hit.distance_mm);
  }
  if (across.empty()) return 0.0;
  std::nth_element(across.begin(), across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2),
                   across.end());
  return across[across.size() / 2];
}

void find_openings(RepairedMesh& repaired) {
  const TriangleMesh& mesh = repaired.mesh;
  const std::vector<Loop> loops = boundary_loops(mesh);
  if (loops.empty()) return;
  const TriangleBvh bvh(mesh);
  std::vector<std::vector<Index>> around(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (Index v : mesh.triangles[t]) around[at(v)].push_back(static_cast<Index>(t));
  for (const Loop& loop : loops) {
    const Vector3d centre = loop_centre(mesh, loop.vertices);
    const Vector3d area = loop_area(mesh, loop.vertices, centre);
    const double diameter = 2.0 * std::sqrt(area.norm() / std::numbers::pi);
    const double lumen = lumen_beside_mm(mesh, bvh, loop.vertices, around);
    const bool ring = loop.vertices.size() >= opening_min_vertices && diameter >= opening_min_diameter_mm;
    if (ring && diameter >= opening_min_lumen_fraction * lumen) {
      Opening opening;
      opening.number = static_cast<int>(repaired.openings.size()) + 1;
      opening.centre_mm = centre;
      opening.direction = -area.normalized();
      opening.diameter_mm = diameter;
      opening.loop = loop.vertices;
      repaired.openings.push_back(std::move(opening));
    } else {
      repaired.pin_holes.push_back({centre, diameter, loop.vertices});
    }
  }
}

}  // namespace

RepairedMesh repair(const TriangleMesh& soup, const std::string& file_label, LengthUnit unit) {
  if (soup.triangles.empty()) throw base::InputError(file_label + ": triangle count is 0; must be > 0");
  const double extent_mm = bounds_mm(soup).diagonal().norm();
  check_extent(extent_mm, file_label, unit);
  RepairedMesh repaired;
  MeshReport& report = repaired.report;
  report.triangles_in_file = soup.triangles.size();
  repaired.mesh = merge_points(soup, 1e-6 * extent_mm);
  report.merged_points = 3 * soup.triangles.size() - repaired.mesh.vertices_mm.size();
  drop_bad_triangles(repaired.mesh, report);
  if (repaired.mesh.triangles.empty())
    throw base::InputError(file_label + ": all " + std::to_string(report.triangles_in_file) +
                           " triangles are degenerate; at least one must have an area");
  const std::vector<Index> component = orient_patches(repaired.mesh, report);
  orient_components(repaired.mesh, component, report);
  for (auto& t : repaired.mesh.triangles) rotate_smallest_first(t);
  for (std::size_t t = 0; t < repaired.mesh.triangles.size(); ++t) {
    double longest2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest2 = std::max(longest2,
                          (repaired.mesh.corner(t, k) - repaired.mesh.corner(t, (k + 1) % 3)).squaredNorm());
    if (repaired.mesh.area_normal(t).norm() <= 1e-9 * longest2) ++report.sliver_triangles;
  }
  find_openings(repaired);
  report.triangles = repaired.mesh.triangles.size();
  report.vertices = repaired.mesh.vertices_mm.size();
  report.bounds_mm = bounds_mm(repaired.mesh);
  report.area_mm2 = area_mm2(repaired.mesh);
  report.volume_mm3 = std::abs(signed_volume_mm3(repaired.mesh));
  return repaired;
}

}  // namespace endowire::vessel

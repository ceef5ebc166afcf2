#include "endowire/vessel/orientation.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "endowire/base/error.hpp"
#include "endowire/vessel/mesh_text.hpp"
#include "endowire/vessel/mesh_topology.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

struct Link {
  Index other;
  bool agree;  ///< both triangles run along the edge in opposite directions
};

/// The neighbours of each triangle over edges of two triangles.
struct Links {
  explicit Links(const TriangleMesh& mesh) : of(mesh.triangles.size()), degree(mesh.triangles.size(), 0) {
    for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
      if (last - first != 2) return;
      const bool agree = first[0].forward != first[1].forward;
      add(first[0].triangle, first[1].triangle, agree);
      add(first[1].triangle, first[0].triangle, agree);
    });
  }
  void add(Index t, Index other, bool agree) {
    std::uint8_t& n = degree[at(t)];
    if (n < 3) of[at(t)][n++] = {other, agree};
  }

  std::vector<std::array<Link, 3>> of;
  std::vector<std::uint8_t> degree;
};

/// A piece as triangles of its own, closed by fans.
std::vector<TriangleMesh> closed_pieces(const TriangleMesh& mesh, const Pieces& pieces) {
  std::vector<TriangleMesh> closed(pieces.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    TriangleMesh& part = closed[at(pieces.of_triangle[t])];
    for (std::size_t k = 0; k < 3; ++k) part.vertices_mm.push_back(mesh.corner(t, k));
  }
  for (const BoundaryLoop& loop : boundary_loops(mesh)) {
    TriangleMesh& part = closed[at(pieces.of_triangle[at(loop.triangle)])];
    const Vector3d centre = loop_centre(mesh, loop.vertices);
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      part.vertices_mm.push_back(mesh.vertices_mm[at(loop.vertices[(i + 1) % loop.vertices.size()])]);
      part.vertices_mm.push_back(mesh.vertices_mm[at(loop.vertices[i])]);
      part.vertices_mm.push_back(centre);
    }
  }
  for (TriangleMesh& part : closed)
    for (std::size_t i = 0; i + 2 < part.vertices_mm.size(); i += 3)
      part.triangles.push_back({static_cast<Index>(i), static_cast<Index>(i + 1), static_cast<Index>(i + 2)});
  return closed;
}

}  // namespace

void flip(TriangleMesh& mesh, std::size_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
}

Pieces pieces_of(const TriangleMesh& mesh) {
  UnionFind joined(mesh.triangles.size());
  for_each_edge(sorted_half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* e = first + 1; e < last; ++e) joined.join(first->triangle, e->triangle);
  });
  Pieces pieces;
  pieces.of_triangle = joined.groups(pieces.count);
  return pieces;
}

void orient_patches(TriangleMesh& mesh, MeshReport& report, const std::string& file_label) {
  const Links links(mesh);
  const std::size_t count = mesh.triangles.size();
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
      for (std::uint8_t k = 0; k < links.degree[t]; ++k) {
        const Link& link = links.of[t][k];
        const auto wanted = static_cast<std::int8_t>(link.agree ? turn[t] : -turn[t]);
        if (turn[at(link.other)] == -wanted)
          throw base::InputError(file_label + ": the surface has one side only (a Möbius strip) near " +
                                 place_text(mesh.corner(t, 0)) + "; must have an inside and an outside");
        if (turn[at(link.other)] != 0) continue;
        turn[at(link.other)] = wanted;
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
}

std::vector<int> orient_pieces(TriangleMesh& mesh, const Pieces& pieces, MeshReport& report) {
  const std::vector<TriangleMesh> closed = closed_pieces(mesh, pieces);
  std::vector<Eigen::AlignedBox3d> boxes(pieces.count);
  std::vector<double> volumes(pieces.count);
  for (std::size_t c = 0; c < pieces.count; ++c) {
    boxes[c] = bounds_mm(closed[c]);
    volumes[c] = signed_volume_mm3(closed[c]);
  }
  std::vector<int> depth(pieces.count, 0);
  std::vector<bool> turn(pieces.count, false);
  double file_volume = 0.0;
  constexpr std::size_t max_nested = 64;  // more pieces than that are debris: each simply faces outward
  for (std::size_t c = 0; c < pieces.count; ++c) {
    for (std::size_t other = 0; other < pieces.count && pieces.count <= max_nested; ++other) {
      if (other == c || !boxes[other].contains(boxes[c])) continue;
      if (std::abs(winding_number(closed[other], closed[c].vertices_mm[0])) > 0.5) ++depth[c];
    }
    const double wanted = depth[c] % 2 == 0 ? 1.0 : -1.0;
    turn[c] = volumes[c] * wanted < 0.0;
    file_volume += wanted * volumes[c];
  }
  report.inward_in_file = file_volume < 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (turn[at(pieces.of_triangle[t])]) {
      flip(mesh, t);
      ++report.flipped_triangles;
    }
  return depth;
}

}  // namespace endowire::vessel

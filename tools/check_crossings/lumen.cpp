#include "lumen.hpp"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <utility>

#include "input_error.hpp"
#include "quiet_errors.hpp"

namespace crossings {

using Eigen::Vector3d;

namespace {

// Hole radius over lumen radius: up to 0.34 in pin holes of real meshes, 0.95 to 1.4 in vessel ends.
constexpr double opening_ratio = 0.4;
constexpr double narrowest_opening_mm =
    0.5;  // narrower holes are cracks in the mesh, whatever lies behind them

using Corners = std::array<int, 3>;
using Edge = std::pair<int, int>;

struct Mesh {
  std::vector<Vector3d> points;
  std::vector<Corners> triangles;
};

struct LexicographicLess {
  bool operator()(const Vector3d& a, const Vector3d& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

/// Points with equal coordinates become one; triangles that lose a corner by it go.
Mesh index_points(const std::vector<Triangle>& soup) {
  Mesh mesh;
  std::map<Vector3d, int, LexicographicLess> known;
  for (const Triangle& triangle : soup) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [place, fresh] = known.try_emplace(triangle[k], static_cast<int>(mesh.points.size()));
      if (fresh) mesh.points.push_back(triangle[k]);
      corners[k] = place->second;
    }
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
      mesh.triangles.push_back(corners);
    }
  }
  return mesh;
}

Edge edge_of(const Corners& corners, int k) {
  return {corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>((k + 1) % 3)]};
}

Edge undirected(Edge edge) {
  return {std::min(edge.first, edge.second), std::max(edge.first, edge.second)};
}

/// Turns triangles so that two which share an edge with nobody else agree; each patch keeps its majority.
void agree_orientation(Mesh& mesh) {
  std::map<Edge, std::vector<int>> users;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k)
      users[undirected(edge_of(mesh.triangles[t], k))].push_back(static_cast<int>(t));
  }
  std::vector<int> turn(mesh.triangles.size(), 0);  // 0 unseen, +1 as in the file, −1 turned
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (turn[seed] != 0) continue;
    std::vector<std::size_t> patch{seed};
    turn[seed] = 1;
    std::ptrdiff_t kept = 1;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const std::size_t here = patch[next];
      for (int k = 0; k < 3; ++k) {
        const Edge edge = edge_of(mesh.triangles[here], k);
        const std::vector<int>& both = users[undirected(edge)];
        if (both.size() != 2) continue;
        const auto other = static_cast<std::size_t>(both[0] == static_cast<int>(here) ? both[1] : both[0]);
        if (turn[other] != 0) continue;
        bool same_direction = false;
        for (int j = 0; j < 3; ++j) same_direction |= edge_of(mesh.triangles[other], j) == edge;
        turn[other] = same_direction ? -turn[here] : turn[here];
        kept += turn[other];
        patch.push_back(other);
      }
    }
    for (const std::size_t t : patch) {
      if (turn[t] * (kept >= 0 ? 1 : -1) < 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
  }
}

/// Closed loops of directed edges that close the surface: every edge used once more in one direction than in
/// the other, reversed, traced and cut at repeated points into simple loops.
std::vector<std::vector<int>> boundary_loops(const Mesh& mesh) {
  std::map<Edge, int> surplus;
  for (const Corners& corners : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Edge edge = edge_of(corners, k);
      surplus[undirected(edge)] += edge.first < edge.second ? 1 : -1;
    }
  }
  std::map<int, std::vector<int>> successors;
  for (const auto& [edge, count] : surplus) {
    for (int i = 0; i < std::abs(count); ++i) {
      const auto [from, to] = count > 0 ? Edge{edge.second, edge.first} : edge;
      successors[from].push_back(to);
    }
  }
  std::vector<std::vector<int>> loops;
  for (auto& [start, unused] : successors) {
    while (!unused.empty()) {
      std::vector<int> path{start};
      int here = start;
      while (true) {
        std::vector<int>& ways = successors[here];
        if (ways.empty()) break;  // back at the start of a circuit whose loops are all cut off
        here = ways.back();
        ways.pop_back();
        const auto seen = std::find(path.begin(), path.end(), here);
        if (seen != path.end()) {
          loops.emplace_back(seen, path.end());
          path.erase(seen + 1, path.end());
        } else {
          path.push_back(here);
        }
      }
    }
  }
  std::erase_if(loops, [](const auto& loop) { return loop.size() < 3; });
  return loops;
}

struct Cover {
  Hole hole;
  Vector3d area_vector = Vector3d::Zero();
  std::vector<Triangle> triangles;
};

Cover cover_of(const std::vector<int>& loop, const Mesh& mesh) {
  Cover cover;
  double rim = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& a = mesh.points[static_cast<std::size_t>(loop[i])];
    const Vector3d& b = mesh.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
    cover.hole.centre_mm += (b - a).norm() * 0.5 * (a + b);
    rim += (b - a).norm();
  }
  cover.hole.centre_mm /= rim;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& a = mesh.points[static_cast<std::size_t>(loop[i])];
    const Vector3d& b = mesh.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
    cover.area_vector += 0.5 * (a - cover.hole.centre_mm).cross(b - cover.hole.centre_mm);
    cover.triangles.push_back({a, b, cover.hole.centre_mm});
  }
  cover.hole.diameter_mm = 2.0 * std::sqrt(cover.area_vector.norm() / std::numbers::pi);
  return cover;
}

/// Radius of the vessel behind a hole: the first maximum, at least a diameter deep, of the distance to the
/// wall on the way inwards.
double lumen_radius_behind(const Cover& cover, const TriangleTree& surface, const Vector3d& inward) {
  const double pace = std::max(cover.hole.diameter_mm / 8.0, 1e-3);
  double radius = surface.nearest(cover.hole.centre_mm).distance_mm;
  for (int i = 1; i < 10000; ++i) {
    const double next = surface.nearest(cover.hole.centre_mm + i * pace * inward).distance_mm;
    if (next < radius && i > 8) break;
    radius = std::max(radius, next);
  }
  return radius;
}

/// VTK reads a binary file to its end whatever its header promises; a vessel that is cut off would be judged
/// without the rest of its walls.
void refuse_cut_off_file(const std::string& path, std::size_t triangles_read) {
  constexpr std::uintmax_t header_bytes = 84;
  constexpr std::uintmax_t triangle_bytes = 50;
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size < header_bytes || (size - header_bytes) / triangle_bytes != triangles_read) return;  // text
  std::ifstream file(path, std::ios::binary);
  file.seekg(80);
  std::array<unsigned char, 4> bytes{};
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(file.get());
  const std::uint32_t promised =
      bytes[0] | bytes[1] << 8U | bytes[2] << 16U | static_cast<std::uint32_t>(bytes[3]) << 24U;
  if (promised != triangles_read) {
    throw InputError(path + ": says " + std::to_string(promised) + " triangles but holds " +
                     std::to_string(triangles_read));
  }
}

}  // namespace

Lumen::Lumen(const std::vector<Triangle>& surface) : triangles_(static_cast<int>(surface.size())) {
  Mesh mesh = index_points(surface);
  agree_orientation(mesh);
  std::vector<Triangle> wall;
  for (const Corners& c : mesh.triangles) {
    wall.push_back({mesh.points[static_cast<std::size_t>(c[0])], mesh.points[static_cast<std::size_t>(c[1])],
                    mesh.points[static_cast<std::size_t>(c[2])]});
  }
  std::vector<Cover> covers;
  for (const std::vector<int>& loop : boundary_loops(mesh)) covers.push_back(cover_of(loop, mesh));
  std::vector<Triangle> closed = wall;
  for (const Cover& cover : covers)
    closed.insert(closed.end(), cover.triangles.begin(), cover.triangles.end());
  const TriangleTree closed_surface(std::move(closed));
  const TriangleTree open_surface(wall);
  std::vector<Triangle> gates;
  for (Cover& cover : covers) {
    const double area = cover.area_vector.norm();
    if (area > 0.0) {
      // The side that more of the surface winds around is the lumen.
      Vector3d inward = cover.area_vector / area;
      const Vector3d pace = 0.125 * cover.hole.diameter_mm * inward;
      if (std::abs(closed_surface.winding(cover.hole.centre_mm + pace)) <
          std::abs(closed_surface.winding(cover.hole.centre_mm - pace))) {
        inward = -inward;
      }
      cover.hole.lumen_radius_mm = lumen_radius_behind(cover, open_surface, inward);
      cover.hole.opening = cover.hole.diameter_mm >= narrowest_opening_mm &&
                           0.5 * cover.hole.diameter_mm >= opening_ratio * cover.hole.lumen_radius_mm;
    }
    std::vector<Triangle>& target = cover.hole.opening ? gates : wall;
    target.insert(target.end(), cover.triangles.begin(), cover.triangles.end());
    holes_.push_back(cover.hole);
  }
  wall_ = TriangleTree(std::move(wall));
  gates_ = TriangleTree(std::move(gates));
}

Lumen Lumen::read(const std::string& path, double mm_per_unit) {
  if (!std::filesystem::is_regular_file(path)) throw InputError(path + ": no such file");
  vtkNew<vtkSTLReader> reader;
  reader->MergingOff();
  const QuietErrors errors(*reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!errors.text().empty()) throw InputError(path + ": not a readable STL file (" + errors.text() + ")");
  vtkPolyData& data = *reader->GetOutput();
  std::vector<Triangle> surface;
  surface.reserve(static_cast<std::size_t>(data.GetNumberOfPolys()));
  vtkNew<vtkIdList> corners;
  vtkCellArray* cells = data.GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(corners) != 0;) {
    if (corners->GetNumberOfIds() != 3) continue;
    Triangle triangle;
    for (int k = 0; k < 3; ++k) {
      data.GetPoint(corners->GetId(k), triangle[static_cast<std::size_t>(k)].data());
      triangle[static_cast<std::size_t>(k)] *= mm_per_unit;
      if (!triangle[static_cast<std::size_t>(k)].allFinite()) {
        throw InputError(path + ": triangle " + std::to_string(surface.size() + 1) +
                         " has a coordinate that is not finite");
      }
    }
    surface.push_back(triangle);
  }
  refuse_cut_off_file(path, surface.size());
  if (surface.empty()) throw InputError(path + ": holds no triangles; a vessel needs at least 4");
  Lumen lumen(surface);
  if (lumen.wall().empty()) throw InputError(path + ": none of its triangles has three different corners");
  return lumen;
}

bool Lumen::inside(const Vector3d& point_mm) const {
  return std::abs(wall_.winding(point_mm) + gates_.winding(point_mm)) > 0.5;
}

bool Lumen::before_opening(const Vector3d& point_mm) const {
  return std::any_of(holes_.begin(), holes_.end(), [&](const Hole& hole) {
    return hole.opening && (point_mm - hole.centre_mm).norm() <= 2.0 * hole.diameter_mm &&
           !wall_.hits(point_mm, hole.centre_mm).any();
  });
}

}  // namespace crossings

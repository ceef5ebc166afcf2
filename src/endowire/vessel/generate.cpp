#include "endowire/vessel/generate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr double grid_mm = 2.0;       // 5 samples across the narrowest vessel
constexpr double smoothing_mm = 0.6;  // rounds carinas to about this radius
constexpr double segment_mm = 4.0;    // of curved centrelines

/// A capsule whose radius changes linearly along it.
struct Segment {
  Vector3d a, b;
  double radius_a, radius_b;
};

struct Node {
  Vector3d position;
  double radius;
};

/// Catmull–Rom through the nodes, cut into short segments. Returns the length.
double add_vessel(std::vector<std::vector<Segment>>& vessels, const std::vector<Node>& nodes) {
  std::vector<Segment>& segments = vessels.emplace_back();
  double length = 0.0;
  Vector3d last = nodes[0].position;
  double last_radius = nodes[0].radius;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Node& p0 = nodes[i == 0 ? 0 : i - 1];
    const Node& p1 = nodes[i];
    const Node& p2 = nodes[i + 1];
    const Node& p3 = nodes[std::min(i + 2, nodes.size() - 1)];
    const int pieces =
        std::max(1, static_cast<int>(std::ceil((p2.position - p1.position).norm() / segment_mm)));
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const Vector3d next =
          0.5 * (2.0 * p1.position + t * (p2.position - p0.position) +
                 t * t * (2.0 * p0.position - 5.0 * p1.position + 4.0 * p2.position - p3.position) +
                 t * t * t * (3.0 * p1.position - p0.position - 3.0 * p2.position + p3.position));
      const double radius = p1.radius + t * (p2.radius - p1.radius);
      segments.push_back({last, next, last_radius, radius});
      length += (next - last).norm();
      last = next;
      last_radius = radius;
    }
  }
  return length;
}

/// Values on a grid; only segments near a node contribute.
class Grid {
 public:
  explicit Grid(const std::vector<std::vector<Segment>>& vessels) {
    Eigen::AlignedBox3d box;
    for (const auto& vessel : vessels)
      for (const Segment& s : vessel) {
        box.extend(s.a - Vector3d::Constant(s.radius_a));
        box.extend(s.a + Vector3d::Constant(s.radius_a));
        box.extend(s.b - Vector3d::Constant(s.radius_b));
        box.extend(s.b + Vector3d::Constant(s.radius_b));
      }
    origin_ = box.min() - Vector3d::Constant(reach_mm + grid_mm);
    const Vector3d size = box.sizes() + Vector3d::Constant(2.0 * (reach_mm + grid_mm));
    for (std::size_t k = 0; k < 3; ++k)
      count_[k] = static_cast<int>(std::ceil(size[static_cast<Eigen::Index>(k)] / grid_mm)) + 1;
    sum_.assign(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                    static_cast<std::size_t>(count_[2]),
                0.0);
    for (const auto& vessel : vessels) {
      std::vector<double> nearest(sum_.size(), reach_mm);
      for (const Segment& s : vessel) lower(s, nearest);
      for (std::size_t n = 0; n < sum_.size(); ++n)
        if (nearest[n] < reach_mm) sum_[n] += std::exp(-nearest[n] / smoothing_mm);
    }
  }

  [[nodiscard]] int count(std::size_t axis) const { return count_[axis]; }
  [[nodiscard]] std::int64_t index(int i, int j, int k) const {
    return (static_cast<std::int64_t>(i) * count_[1] + j) * count_[2] + k;
  }
  [[nodiscard]] Vector3d position(int i, int j, int k) const { return origin_ + grid_mm * Vector3d(i, j, k); }
  /// Negative inside the vessel.
  [[nodiscard]] double value(std::int64_t index) const {
    const double s = sum_[static_cast<std::size_t>(index)];
    return s > 0.0 ? -smoothing_mm * std::log(s) : reach_mm;
  }

 private:
  static constexpr double reach_mm = 6.0;  // beyond it exp(−d/k) is below 5e-5

  /// Distance to one segment, where it is the nearest of its vessel.
  void lower(const Segment& s, std::vector<double>& nearest) const {
    const double radius = std::max(s.radius_a, s.radius_b) + reach_mm;
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<Eigen::Index>(axis);
      low[axis] = std::max(
          0, static_cast<int>(std::floor((std::min(s.a[x], s.b[x]) - radius - origin_[x]) / grid_mm)));
      high[axis] =
          std::min(count_[axis] - 1,
                   static_cast<int>(std::ceil((std::max(s.a[x], s.b[x]) + radius - origin_[x]) / grid_mm)));
    }
    const Vector3d along = s.b - s.a;
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k) {
          const Vector3d p = position(i, j, k);
          const double t = std::clamp((p - s.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
          const double d = (p - s.a - t * along).norm() - (s.radius_a + t * (s.radius_b - s.radius_a));
          double& value = nearest[static_cast<std::size_t>(index(i, j, k))];
          value = std::min(value, d);
        }
  }

  Vector3d origin_;
  std::array<int, 3> count_{};
  std::vector<double> sum_;
};

/// Marching tetrahedra over six tetrahedra a cell that share the cell's diagonal.
/// Source  A. Doi & A. Koide, IEICE Trans. E74-D:214, 1991.
TriangleMesh extract(const Grid& grid) {
  TriangleMesh mesh;
  std::unordered_map<std::uint64_t, std::int32_t> cut;  // vertex on the grid edge low → high
  struct Corner {
    std::int64_t index;
    Vector3d position;
    double value;
  };
  const auto vertex = [&](const Corner& p, const Corner& q) {
    const Corner& low = p.index < q.index ? p : q;
    const Corner& high = p.index < q.index ? q : p;
    // The seven edge directions from a node are told apart by their index difference.
    const std::uint64_t key =
        (static_cast<std::uint64_t>(low.index) << 32) | static_cast<std::uint64_t>(high.index);
    const auto [at, fresh] = cut.try_emplace(key, static_cast<std::int32_t>(mesh.vertices_mm.size()));
    if (fresh) {
      const double t = std::clamp(low.value / (low.value - high.value), 0.02, 0.98);  // no slivers
      mesh.vertices_mm.emplace_back(low.position + t * (high.position - low.position));
    }
    return at->second;
  };
  const auto emit = [&](std::int32_t a, std::int32_t b, std::int32_t c, const Vector3d& outward) {
    const Vector3d& va = mesh.vertices_mm[static_cast<std::size_t>(a)];
    const Vector3d normal = (mesh.vertices_mm[static_cast<std::size_t>(b)] - va)
                                .cross(mesh.vertices_mm[static_cast<std::size_t>(c)] - va);
    if (normal.dot(outward) > 0.0)
      mesh.triangles.push_back({a, b, c});
    else
      mesh.triangles.push_back({a, c, b});
  };
  constexpr std::array<std::array<int, 4>, 6> tetrahedra{
      {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
  std::array<Corner, 8> corner;
  for (int i = 0; i + 1 < grid.count(0); ++i)
    for (int j = 0; j + 1 < grid.count(1); ++j)
      for (int k = 0; k + 1 < grid.count(2); ++k) {
        int inside_cell = 0;
        for (int o = 0; o < 8; ++o) {
          const int x = i + (o & 1);
          const int y = j + ((o >> 1) & 1);
          const int z = k + ((o >> 2) & 1);
          Corner& c = corner[static_cast<std::size_t>(o)];
          c.index = grid.index(x, y, z);
          c.value = grid.value(c.index);
          c.position = grid.position(x, y, z);
          inside_cell += c.value < 0.0 ? 1 : 0;
        }
        if (inside_cell == 0 || inside_cell == 8) continue;
        for (const auto& tetrahedron : tetrahedra) {
          std::array<Corner, 4> in;
          std::array<Corner, 4> out;
          std::size_t ins = 0;
          std::size_t outs = 0;
          for (int o : tetrahedron) {
            const Corner& c = corner[static_cast<std::size_t>(o)];
            if (c.value < 0.0)
              in[ins++] = c;
            else
              out[outs++] = c;
          }
          if (ins == 0 || outs == 0) continue;
          Vector3d outward = Vector3d::Zero();
          for (std::size_t n = 0; n < outs; ++n) outward += out[n].position / static_cast<double>(outs);
          for (std::size_t n = 0; n < ins; ++n) outward -= in[n].position / static_cast<double>(ins);
          if (ins == 1) {
            emit(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]), outward);
          } else if (outs == 1) {
            emit(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]), outward);
          } else {
            const std::int32_t a = vertex(in[0], out[0]);
            const std::int32_t b = vertex(in[0], out[1]);
            const std::int32_t c = vertex(in[1], out[1]);
            const std::int32_t d = vertex(in[1], out[0]);
            emit(a, b, c, outward);
            emit(a, c, d, outward);
          }
        }
      }
  return mesh;
}

}  // namespace

GeneratedVessel tube_tree() {
  std::vector<std::vector<Segment>> vessels;
  const std::vector<Node> main_route{
      {{60.0, -8.0, 0.0}, 4.9},     {{52.0, -16.0, 22.0}, 5.0},   {{34.0, -14.0, 48.0}, 5.4},
      {{14.0, -4.0, 70.0}, 6.5},    {{4.0, 0.0, 95.0}, 9.0},      {{0.0, 4.0, 150.0}, 9.5},
      {{4.0, 8.0, 220.0}, 10.5},    {{8.0, 12.0, 290.0}, 11.5},   {{8.0, 14.0, 340.0}, 12.0},
      {{-2.0, 8.0, 372.0}, 12.5},   {{-28.0, -6.0, 388.0}, 13.0}, {{-54.0, -20.0, 370.0}, 13.5},
      {{-60.0, -24.0, 340.0}, 14.0}};
  GeneratedVessel vessel;
  vessel.route_mm = add_vessel(vessels, main_route);
  const std::vector<Node> other_iliac{{{4.0, 0.0, 95.0}, 8.0},
                                      {{-6.0, -2.0, 72.0}, 6.4},
                                      {{-28.0, -12.0, 46.0}, 5.2},
                                      {{-44.0, -14.0, 20.0}, 5.0}};
  const std::vector<Node> left_carotid{{{-14.0, 2.0, 382.0}, 5.0},
                                       {{-8.0, -2.0, 408.0}, 4.0},
                                       {{-2.0, -6.0, 440.0}, 3.6},
                                       {{2.0, -2.0, 480.0}, 3.4}};
  const std::vector<Node> right_trunk{{{-38.0, -10.0, 386.0}, 6.5},
                                      {{-46.0, -10.0, 410.0}, 5.5},
                                      {{-56.0, -6.0, 435.0}, 4.6},
                                      {{-60.0, -8.0, 470.0}, 4.0}};
  add_vessel(vessels, other_iliac);
  add_vessel(vessels, left_carotid);
  add_vessel(vessels, right_trunk);
  vessel.mesh = extract(Grid(vessels));
  const Vector3d tangent = (vessels[0][1].b - vessels[0][0].a).normalized();
  vessel.access_position_mm = vessels[0][0].a + 3.0 * tangent;
  vessel.access_direction = tangent;
  const auto name = [&](const char* text, const Node& node) {
    vessel.landmarks.push_back({text, node.position, node.radius});
  };
  name("access", main_route[0]);
  name("aortic bifurcation", main_route[4]);
  name("descending aorta", main_route[7]);
  name("arch", main_route[10]);
  name("ascending aorta", main_route[12]);
  name("other iliac end", other_iliac.back());
  name("left carotid end", left_carotid.back());
  name("right trunk end", right_trunk.back());
  return vessel;
}

}  // namespace endowire::vessel

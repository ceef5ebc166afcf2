#include "endowire/vessel/anatomy/contour.hpp"

#include <array>
#include <cmath>
#include <unordered_map>

#include "endowire/base/contract.hpp"
#include "endowire/vessel/anatomy/cell_pattern.hpp"
#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

using Index3 = std::array<std::int64_t, 3>;

std::uint64_t key_of(const Index3& at) {
  constexpr std::int64_t half = std::int64_t{1} << 20;
  return static_cast<std::uint64_t>(at[0] + half) << 42 | static_cast<std::uint64_t>(at[1] + half) << 21 |
         static_cast<std::uint64_t>(at[2] + half);
}

class Contour {
 public:
  Contour(const LumenShape& shape, double spacing_mm) : shape_(shape), spacing_mm_(spacing_mm) {
    for (int i = 0; i < 256; ++i) patterns_[static_cast<std::size_t>(i)] = cell_pattern(i, 0);
    ENDOWIRE_EXPECTS(shape.bounds_mm().sizes().maxCoeff() < 1e5 * spacing_mm,
                     "cells are numbered with 21 bits along each axis");
    values_.reserve(1 << 16);
    cells_.reserve(1 << 15);
  }

  TriangleMesh run() {
    for (const Tube& tube : shape_.tubes()) begin_at(tube);
    for (std::size_t i = 0; i < order_.size(); ++i) {  // grows while it is walked
      fill(i);
    }
    for (const Cell& cell : order_) join(cell);
    return std::move(mesh_);
  }

 private:
  struct Cell {
    Index3 at;
    int inside;
    std::int32_t first_vertex = -1;
    std::array<std::int8_t, 12> sheet{};
  };

  [[nodiscard]] Vector3d place(const Index3& at) const {
    return spacing_mm_ *
           Vector3d(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
  }

  double value(const Index3& at) {
    const auto [entry, fresh] = values_.try_emplace(key_of(at), 0.0);
    if (fresh) entry->second = shape_.at(place(at)).distance_mm;
    return entry->second;
  }

  static Index3 corner(const Index3& cell, int c) {
    return {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
  }

  void visit(const Index3& at) {
    const auto [entry, fresh] = cells_.try_emplace(key_of(at), static_cast<std::int32_t>(order_.size()));
    if (!fresh) return;
    const int inside = inside_of(at);
    if (inside == 0 || inside == 255) {
      entry->second = -1;
      return;
    }
    order_.push_back({at, inside, -1, {}});
  }

  int inside_of(const Index3& cell) {
    int inside = 0;
    for (int c = 0; c < 8; ++c)
      if (value(corner(cell, c)) < 0.0) inside |= 1 << c;
    return inside;
  }

  static Index3 beyond(const Index3& cell, int face) {
    Index3 next = cell;
    next[static_cast<std::size_t>(face / 2)] += face % 2 == 0 ? -1 : 1;
    return next;
  }

  /// Where one sheet passes a face twice, seen from both of its cells, both vertices would share four triangles at
  /// one edge. There the inside corners are joined across the face, which makes two sheets of each.
  CellPattern pattern_at(const Index3& at, int inside) {
    const CellPattern& usual = patterns_[static_cast<std::size_t>(inside)];
    int together = 0;
    for (int face = 0; face < 6; ++face)
      if (usual.pinchable[static_cast<std::size_t>(face)] &&
          patterns_[static_cast<std::size_t>(inside_of(beyond(at, face)))]
              .pinchable[static_cast<std::size_t>(face ^ 1)])
        together |= 1 << face;
    return together == 0 ? usual : cell_pattern(inside, together);
  }

  /// From the middle of the tube's axis straight out to where the surface is.
  void begin_at(const Tube& tube) {
    const AxisPoint middle = tube.axis.at(0.5 * tube.axis.length_mm());
    int thin = 0;
    middle.tangent.cwiseAbs().minCoeff(&thin);
    const Vector3d out = unit(cross(middle.tangent, Vector3d::Unit(thin)));
    Index3 at{};
    for (double d = 0.0; d < 100.0; d += 0.5 * spacing_mm_) {
      const Vector3d p = middle.position_mm + d * out;
      for (std::size_t k = 0; k < 3; ++k)
        at[k] = static_cast<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / spacing_mm_));
      const std::size_t before = order_.size();
      visit(at);
      if (order_.size() > before || shape_.at(p).distance_mm > 0.0) return;
    }
  }

  void fill(std::size_t self) {
    const Cell cell = order_[self];  // a copy: `order_` grows below
    const CellPattern pattern = pattern_at(cell.at, cell.inside);
    order_[self].first_vertex = static_cast<std::int32_t>(mesh_.vertices_mm.size());
    for (std::size_t e = 0; e < 12; ++e) order_[self].sheet[e] = static_cast<std::int8_t>(pattern.sheet[e]);
    for (int sheet = 0; sheet < pattern.sheets; ++sheet) {
      Vector3d sum = Vector3d::Zero();
      double count = 0.0;
      for (int e = 0; e < 12; ++e) {
        if (pattern.sheet[static_cast<std::size_t>(e)] != sheet) continue;
        const EdgeEnds ends = ends_of_edge(e);
        const Index3 a = corner(cell.at, ends.from);
        const Index3 b = corner(cell.at, ends.to);
        const double t = value(a) / (value(a) - value(b));
        sum += place(a) + t * (place(b) - place(a));
        count += 1.0;
      }
      mesh_.vertices_mm.emplace_back(sum / count);
    }
    for (int face = 0; face < 6; ++face) {
      int corners = 0;
      for (const int c : corners_of_face(face)) corners |= 1 << c;
      const int inside = cell.inside & corners;
      if (inside != 0 && inside != corners) visit(beyond(cell.at, face));
    }
  }

  /// The quadrilaterals of the three edges at the cell's lowest corner.
  void join(const Cell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool from_inside = (cell.inside & 1) != 0;
      const bool to_inside = (cell.inside >> (1 << axis) & 1) != 0;
      if (from_inside == to_inside) continue;
      std::array<std::int32_t, 4> ring{};
      for (int k = 0; k < 4; ++k) {  // the cells around the edge, counter-clockwise seen against the axis
        const int back_u = k == 1 || k == 2 ? 1 : 0;
        const int back_v = k >= 2 ? 1 : 0;
        Index3 at = cell.at;
        at[static_cast<std::size_t>(other_axis(axis, 1))] -= back_u;
        at[static_cast<std::size_t>(other_axis(axis, 2))] -= back_v;
        const Cell& around = order_[static_cast<std::size_t>(cells_.at(key_of(at)))];
        const int edge = 4 * axis + back_u + 2 * back_v;
        ring[static_cast<std::size_t>(k)] =
            around.first_vertex + around.sheet[static_cast<std::size_t>(edge)];
      }
      if (!from_inside) std::swap(ring[1], ring[3]);
      add_quadrilateral(ring);
    }
  }

  void add_quadrilateral(const std::array<std::int32_t, 4>& q) {
    const auto apart = [&](std::size_t a, std::size_t b) {
      return length(mesh_.vertices_mm[static_cast<std::size_t>(q[a])] -
                    mesh_.vertices_mm[static_cast<std::size_t>(q[b])]);
    };
    if (apart(0, 2) <= apart(1, 3)) {
      mesh_.triangles.push_back({q[0], q[1], q[2]});
      mesh_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh_.triangles.push_back({q[0], q[1], q[3]});
      mesh_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  const LumenShape& shape_;
  double spacing_mm_;
  std::array<CellPattern, 256> patterns_;
  std::unordered_map<std::uint64_t, double> values_;
  std::unordered_map<std::uint64_t, std::int32_t> cells_;
  std::vector<Cell> order_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh contour(const LumenShape& shape, double spacing_mm) {
  return Contour(shape, spacing_mm).run();
}

}  // namespace endowire::vessel::anatomy

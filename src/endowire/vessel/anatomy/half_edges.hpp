#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel::anatomy {

/// A manifold triangle mesh whose edges can be split, collapsed and flipped.
///
/// Half-edge h = 3 t + k runs from corner k of triangle t to the next corner; its opposite runs the other way in
/// the neighbour, -1 at a border. A vertex knows one half-edge that leaves it: at a border the one along it.
/// Removed triangles and vertices stay as holes until `compact`.
class HalfEdges {
 public:
  using Index = std::int32_t;
  static constexpr Index none = -1;

  /// @param mesh  every edge has one or two triangles, which agree in orientation
  explicit HalfEdges(const TriangleMesh& mesh);

  [[nodiscard]] static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] Index from(Index h) const { return corner_[at(h)]; }
  [[nodiscard]] Index to(Index h) const { return corner_[at(next(h))]; }
  /// The corner of the triangle that the half-edge does not touch.
  [[nodiscard]] Index apex(Index h) const { return corner_[at(previous(h))]; }
  [[nodiscard]] Index opposite(Index h) const { return opposite_[at(h)]; }
  [[nodiscard]] Index count() const { return static_cast<Index>(corner_.size()); }
  [[nodiscard]] Index vertices() const { return static_cast<Index>(leaving_.size()); }
  [[nodiscard]] bool alive(Index h) const { return corner_[at(h)] != none; }
  [[nodiscard]] bool vertex_alive(Index v) const { return leaving_[at(v)] != none; }
  [[nodiscard]] bool on_border(Index v) const { return opposite_[at(leaving_[at(v)])] == none; }

  /// Calls see(h) for every half-edge that leaves a vertex.
  template <class See>
  void around(Index v, See see) const {
    const Index first = leaving_[at(v)];
    Index h = first;
    do {
      see(h);
      h = opposite_[at(previous(h))];
    } while (h != first && h != none);
  }
  [[nodiscard]] int triangles_at(Index v) const;
  [[nodiscard]] bool joined(Index a, Index b) const;

  /// Puts a new vertex on the edge of `h` and returns it.
  Index split(Index h);
  /// May `to(h)` be moved into `from(h)`? False where the mesh would lose a handle, a border or manifoldness.
  [[nodiscard]] bool may_collapse(Index h) const;
  /// Moves `to(h)` into `from(h)`; two triangles disappear, one at a border.
  void collapse(Index h);
  /// Turns the edge of `h` within its two triangles; the caller makes sure that the other diagonal is free.
  void flip(Index h);

  /// The triangles that are left, vertices numbered anew in their old order; `kept` lists their old numbers.
  [[nodiscard]] std::vector<std::array<Index, 3>> compact(std::vector<Index>& kept) const;

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  void glue(Index a, Index b);
  void set_leaving(Index v, Index h);

  std::vector<Index> corner_;
  std::vector<Index> opposite_;
  std::vector<Index> leaving_;
};

}  // namespace endowire::vessel::anatomy

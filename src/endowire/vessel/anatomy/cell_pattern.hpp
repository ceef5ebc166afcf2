#pragma once

#include <array>

namespace endowire::vessel::anatomy {

// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). Edge e runs along axis e / 4 from the corner whose two
// other coordinates are the bits of e % 4, the next axis in cyclic order first. Face f lies across axis f / 2, at
// coordinate f % 2.

[[nodiscard]] constexpr int other_axis(int axis, int step) {
  return (axis + step) % 3;
}

struct EdgeEnds {
  int from, to;
};

[[nodiscard]] constexpr EdgeEnds ends_of_edge(int edge) {
  const int axis = edge / 4;
  const int from = (edge & 1) << other_axis(axis, 1) | (edge >> 1 & 1) << other_axis(axis, 2);
  return {from, from | 1 << axis};
}

/// The corners of a face in a ring.
[[nodiscard]] std::array<int, 4> corners_of_face(int face);

/// How a surface passes through a cell, from which of its corners lie inside.
struct CellPattern {
  std::array<int, 12> sheet{};      ///< that each edge belongs to, -1 where the surface does not cross it
  int sheets = 0;                   ///< pieces of the surface within the cell
  std::array<bool, 6> pinchable{};  ///< a face which one sheet passes twice
};

/// @param inside    a bit per corner
/// @param together  a bit per face: where a face has two inside corners at opposite ends of a diagonal, they are
///                  joined across it; else kept apart
[[nodiscard]] CellPattern cell_pattern(int inside, int together);

}  // namespace endowire::vessel::anatomy

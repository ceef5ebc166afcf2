#include "endowire/vessel/anatomy/cell_pattern.hpp"

namespace endowire::vessel::anatomy {
namespace {

int edge_between(int a, int b) {
  const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  return 4 * axis + (a >> other_axis(axis, 1) & 1) + 2 * (a >> other_axis(axis, 2) & 1);
}

/// Crossed edges that belong together.
class Groups {
 public:
  Groups() {
    for (int e = 0; e < 12; ++e) parent_[static_cast<std::size_t>(e)] = e;
  }

  [[nodiscard]] int of(int edge) const {
    while (parent_[static_cast<std::size_t>(edge)] != edge) edge = parent_[static_cast<std::size_t>(edge)];
    return edge;
  }

  void join(int a, int b) { parent_[static_cast<std::size_t>(of(a))] = of(b); }

 private:
  std::array<int, 12> parent_{};
};

/// The edges of a face in a ring: edge k lies between corners k and k + 1.
std::array<int, 4> edges_of_face(int face) {
  const std::array<int, 4> corner = corners_of_face(face);
  std::array<int, 4> edge{};
  for (std::size_t k = 0; k < 4; ++k) edge[k] = edge_between(corner[k], corner[(k + 1) % 4]);
  return edge;
}

bool crossed(int inside, int edge) {
  const EdgeEnds ends = ends_of_edge(edge);
  return (inside >> ends.from & 1) != (inside >> ends.to & 1);
}

bool has_four_crossings(int inside, int face) {
  for (const int edge : edges_of_face(face))
    if (!crossed(inside, edge)) return false;
  return true;
}

void join_across(int inside, int face, bool together, Groups& groups) {
  const std::array<int, 4> edge = edges_of_face(face);
  if (has_four_crossings(inside, face)) {
    // Both edges at a corner belong to the line around that corner: the inside ones where they are kept apart.
    const std::array<int, 4> corner = corners_of_face(face);
    for (std::size_t k = 0; k < 4; ++k)
      if (((inside >> corner[k] & 1) == 0) == together) groups.join(edge[(k + 3) % 4], edge[k]);
    return;
  }
  int first = -1;
  for (const int e : edge) {
    if (!crossed(inside, e)) continue;
    if (first >= 0) groups.join(first, e);
    first = e;
  }
}

}  // namespace

std::array<int, 4> corners_of_face(int face) {
  const int axis = face / 2;
  const int u = 1 << other_axis(axis, 1);
  const int v = 1 << other_axis(axis, 2);
  const int origin = (face % 2) << axis;
  return {origin, origin | u, origin | u | v, origin | v};
}

CellPattern cell_pattern(int inside, int together) {
  Groups groups;
  for (int face = 0; face < 6; ++face) join_across(inside, face, (together >> face & 1) != 0, groups);
  CellPattern pattern;
  std::array<int, 12> number{};
  number.fill(-1);
  for (int e = 0; e < 12; ++e) {
    pattern.sheet[static_cast<std::size_t>(e)] = -1;
    if (!crossed(inside, e)) continue;
    int& n = number[static_cast<std::size_t>(groups.of(e))];
    if (n < 0) n = pattern.sheets++;
    pattern.sheet[static_cast<std::size_t>(e)] = n;
  }
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> edge = edges_of_face(face);
    pattern.pinchable[static_cast<std::size_t>(face)] = has_four_crossings(inside, face) &&
                                                        groups.of(edge[0]) == groups.of(edge[2]) &&
                                                        groups.of(edge[0]) == groups.of(edge[1]);
  }
  return pattern;
}

}  // namespace endowire::vessel::anatomy

#include "endowire/vessel/brick_signs.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {

void settle_signs(PointBlock& nodes, double spacing_mm, const TriangleMesh& closed) {
  const auto distance_mm = [&](std::size_t n) { return std::abs(nodes.distance_mm[n]); };
  const auto inside = [&](std::size_t n) { return nodes.distance_mm[n] > 0.0; };
  const auto joined = [&](std::size_t a, std::size_t b) {
    return distance_mm(a) + distance_mm(b) > spacing_mm * (1.0 + 1e-6);
  };
  const auto each_link = [&](const auto& visit) {
    for (int i = 0; i < MeshField::nodes; ++i)
      for (int j = 0; j < MeshField::nodes; ++j)
        for (int k = 0; k < MeshField::nodes; ++k) {
          if (i > 0) visit(brick_node(i, j, k), brick_node(i - 1, j, k));
          if (j > 0) visit(brick_node(i, j, k), brick_node(i, j - 1, k));
          if (k > 0) visit(brick_node(i, j, k), brick_node(i, j, k - 1));
        }
  };
  bool suspicious = false;
  each_link([&](std::size_t a, std::size_t b) {
    suspicious = suspicious || (inside(a) != inside(b) && joined(a, b));
  });
  if (!suspicious) return;

  std::array<std::size_t, MeshField::samples_per_brick> parent{};
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  each_link([&](std::size_t a, std::size_t b) {
    if (joined(a, b)) parent[root(a)] = root(b);
  });
  std::array<int, MeshField::samples_per_brick> signs{};  // bit 1: an inside node, bit 2: an outside one
  std::array<std::size_t, MeshField::samples_per_brick> deepest{};
  for (std::size_t n = 0; n < parent.size(); ++n) {
    const std::size_t r = root(n);
    if (signs[r] == 0 || distance_mm(n) > distance_mm(deepest[r])) deepest[r] = n;
    signs[r] |= inside(n) ? 1 : 2;
  }
  for (std::size_t r = 0; r < parent.size(); ++r) {
    if (signs[r] != 3) continue;
    const std::size_t n = deepest[r];
    const double sign = winding_number(closed, {nodes.x[n], nodes.y[n], nodes.z[n]}) > 0.5 ? 1.0 : -1.0;
    for (std::size_t m = 0; m < parent.size(); ++m)
      if (root(m) == r) nodes.distance_mm[m] = sign * distance_mm(m);
  }
}

}  // namespace endowire::vessel

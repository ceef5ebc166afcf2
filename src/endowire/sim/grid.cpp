#include "endowire/sim/grid.hpp"

#include <algorithm>

namespace endowire::sim {

std::vector<double> uniform_grid(const rod::MaterialLine& line, double rod_length_mm, double max_bias_rad) {
  constexpr double kShortest_mm = 0.2;
  std::vector<double> arcs{0.0};
  while (arcs.back() < line.length_mm()) {
    const double from = arcs.back();
    double length = rod_length_mm;
    // The curvature ahead may begin within the rod: halve until the turn of this rod is small enough.
    while (length > kShortest_mm && line.rest_bend_rad(from, from + length).norm() > max_bias_rad)
      length *= 0.5;
    arcs.push_back(from + std::max(length, kShortest_mm));
  }
  return arcs;
}

}  // namespace endowire::sim

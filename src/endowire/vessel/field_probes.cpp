#include "endowire/vessel/field_probes.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/vessel/random.hpp"
#include "endowire/vessel/winding.hpp"

namespace endowire::vessel {

using Eigen::Vector3d;

std::vector<FieldProbe> probe_near_wall(const MeshField& field, const ClosedSurface& closed,
                                        const ExactSurface& surface, const FieldParameters& parameters,
                                        std::size_t count, std::uint64_t seed) {
  std::vector<double> cumulative(closed.wall_triangles);
  double sum = 0.0;
  for (std::size_t t = 0; t < closed.wall_triangles; ++t)
    cumulative[t] = sum += 0.5 * closed.mesh.area_normal(t).norm();
  std::vector<FieldProbe> probes;
  probes.reserve(count);
  SplitMix random(seed);
  for (std::size_t n = 0; n < count; ++n) {
    const auto hit = std::upper_bound(cumulative.begin(), cumulative.end(), random.uniform() * sum);
    const auto t = static_cast<std::size_t>(std::min(hit, cumulative.end() - 1) - cumulative.begin());
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d on_wall = closed.mesh.corner(t, 0) +
                             u * (closed.mesh.corner(t, 1) - closed.mesh.corner(t, 0)) +
                             v * (closed.mesh.corner(t, 2) - closed.mesh.corner(t, 0));
    const double offset = random.uniform(-parameters.near_mm, parameters.near_outside_mm);
    const Vector3d p = on_wall + offset * surface.normal(t);
    double exact = surface.at(p, std::abs(offset) + 1e-6).distance_mm;
    const double found = field.at(p).distance_mm;
    // Where the pseudonormal of a flawed mesh disagrees with the field, the winding number says who is right.
    if (exact * found < 0.0 && std::abs(exact - found) > 4.0 * parameters.error_target_mm)
      exact = std::copysign(exact, winding_number(closed.mesh, p) - 0.5);
    probes.push_back({p, std::abs(found - exact)});
  }
  return probes;
}

std::array<double, 5> diameter_percentiles_mm(const ClosedSurface& closed, const LumenOfTriangles& lumen) {
  std::vector<std::pair<double, double>> diameters;  // and the area of wall that has it
  double area = 0.0;
  for (std::size_t t = 0; t < closed.wall_triangles; ++t) {
    diameters.emplace_back(2.0 * lumen.radius_mm[t], 0.5 * closed.mesh.area_normal(t).norm());
    area += diameters.back().second;
  }
  std::sort(diameters.begin(), diameters.end());
  constexpr std::array<double, 5> parts{0.05, 0.25, 0.5, 0.75, 0.95};
  std::array<double, 5> percentiles{};
  double below = 0.0;
  std::size_t next = 0;
  for (const auto& [diameter, weight] : diameters) {
    below += weight;
    while (next < parts.size() && below >= parts[next] * area) percentiles[next++] = diameter;
  }
  return percentiles;
}

}  // namespace endowire::vessel

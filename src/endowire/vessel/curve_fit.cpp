#include "endowire/vessel/curve_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/math/band_ldlt.hpp"

namespace endowire::vessel {

using Eigen::Vector3d;

std::vector<Vector3d> smooth_row(const std::vector<Vector3d>& points, const std::vector<double>& weights,
                                 double stiffness) {
  constexpr std::array<double, 4> difference{-1.0, 3.0, -3.0, 1.0};
  ENDOWIRE_EXPECTS(points.size() >= 4 && weights.size() == points.size(), "a row has third differences");
  const int count = static_cast<int>(points.size());
  math::BandMatrix matrix;
  matrix.resize(count);
  matrix.set_zero();
  for (int i = 0; i < count; ++i) matrix.add(i, i, weights[static_cast<std::size_t>(i)]);
  for (int i = 0; i + 3 < count; ++i)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b <= a; ++b)
        matrix.add(
            i + a, i + b,
            stiffness * difference[static_cast<std::size_t>(a)] * difference[static_cast<std::size_t>(b)]);
  if (matrix.factorise({}) != 0) return points;  // too few weights to hold the row: leave it
  std::vector<Vector3d> row(points.size());
  std::vector<double> x(points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) x[i] = weights[i] * points[i][axis];
    matrix.solve(x);
    for (std::size_t i = 0; i < points.size(); ++i) row[i][axis] = x[i];
  }
  return row;
}

std::vector<Vector3d> resample_by_radius(const std::vector<Vector3d>& line,
                                         const std::vector<double>& radii_mm, double step,
                                         std::size_t min_pieces) {
  std::vector<double> sum(line.size(), 0.0);  // ∫ ds/r, the radius linear between points
  for (std::size_t i = 1; i < line.size(); ++i)
    sum[i] = sum[i - 1] + (line[i] - line[i - 1]).norm() * 2.0 / (radii_mm[i] + radii_mm[i - 1]);
  const auto pieces = std::max(min_pieces, static_cast<std::size_t>(std::ceil(sum.back() / step)));
  std::vector<Vector3d> out;
  out.reserve(pieces + 1);
  std::size_t i = 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const double wanted = sum.back() * static_cast<double>(k) / static_cast<double>(pieces);
    while (i + 1 < line.size() && sum[i] < wanted) ++i;
    const double span = sum[i] - sum[i - 1];
    const double f = span > 0.0 ? (wanted - sum[i - 1]) / span : 0.0;
    out.emplace_back((1.0 - f) * line[i - 1] + f * line[i]);
  }
  out.push_back(line.back());
  return out;
}

}  // namespace endowire::vessel

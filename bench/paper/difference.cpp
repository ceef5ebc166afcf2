#include "difference.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/io/statistics.hpp"

namespace endowire::paper {

namespace {

constexpr std::size_t kWindow = 50;  // steps over which the push is averaged
constexpr std::size_t kEvery = 5;    // steps between two shapes that are compared
constexpr double kSpacing_mm = 1.0;  // of the points of a rod
constexpr double kSameLength_mm = 0.5;
constexpr double kLeastPush_n = 1e-3;

double squared_distance(const Line& line, const Eigen::Vector3d& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d d = line[i + 1] - line[i];
    const Eigen::Vector3d to = p - line[i];
    const double t = std::clamp(to.dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to - t * d).squaredNorm());
  }
  return nearest;
}

bool comparable(const Step& a, const Step& b) {
  return a.calm && b.calm && a.joints_mm.size() > 2 && b.joints_mm.size() > 2 &&
         std::abs(a.inserted_mm - b.inserted_mm) < kSameLength_mm;
}

}  // namespace

double beside_mm(const Line& wire, const Line& reference) {
  double worst = 0.0;
  for (std::size_t i = 0; i + 2 < wire.size(); ++i) {
    const Eigen::Vector3d rod = wire[i + 1] - wire[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil(rod.norm() / kSpacing_mm)));
    for (int k = 0; k < pieces; ++k)
      worst = std::max(worst, squared_distance(reference, wire[i] + static_cast<double>(k) / pieces * rod));
  }
  return std::sqrt(worst);
}

Difference difference(const Run& run, const Run& reference) {
  Difference result;
  std::vector<double> shapes_mm;
  std::vector<double> pushes;
  const std::size_t steps = std::min(run.steps.size(), reference.steps.size());
  std::size_t compared = 0;
  for (std::size_t from = 0; from < steps; from += kWindow) {
    double sum_n = 0.0;
    double expected_n = 0.0;
    double count = 0.0;
    for (std::size_t i = from; i < std::min(steps, from + kWindow); ++i) {
      if (!comparable(run.steps[i], reference.steps[i])) continue;
      ++compared;
      count += 1.0;
      sum_n += run.steps[i].push_n;
      expected_n += reference.steps[i].push_n;
      if (i % kEvery != 0 && i + 1 != steps) continue;
      result.beside_end_mm = beside_mm(run.steps[i].joints_mm, reference.steps[i].joints_mm);
      shapes_mm.push_back(result.beside_end_mm);
    }
    if (std::abs(expected_n) > kLeastPush_n * count) pushes.push_back(std::abs(sum_n / expected_n - 1.0));
  }
  result.share = static_cast<double>(compared) / static_cast<double>(reference.commands);
  result.beside_median_mm = io::percentile(shapes_mm, 0.5);
  result.beside_p90_mm = io::percentile(shapes_mm, 0.9);
  result.push_median = io::percentile(pushes, 0.5);
  result.push_max = io::percentile(pushes, 1.0);
  return result;
}

}  // namespace endowire::paper

// From a staircase of graph nodes to a smooth line in the middle of the lumen.
//
//   1  the raw path, resampled and smoothed: its direction becomes usable
//   2  each point climbs in the plane across the line to the ridge of the inscribed radius
//   3  the row of those points is smoothed by its third differences; where that would leave the ridge by more
//      than a small part of the radius, the ridge counts more, and the row is smoothed again
//   2 and 3 three times: an oval lumen is wider than one climb reaches.
// Where a branch still runs in its parent's lumen, the ridge there is the parent's: the raw path counts instead,
// little, so that the line bends smoothly from the parent's into its own ostium.
#include <algorithm>
#include <cmath>

#include "endowire/vessel/curve_fit.hpp"
#include "endowire/vessel/ridge.hpp"
#include "endowire/vessel/vessel_lines.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr double stiffness = 60.0;  // λ: waves shorter than 12 points, 4 radii, go; see smooth_row
constexpr int passes = 3;
constexpr double climb_part = 0.5;        // of the radius: how far the raw path may be off the ridge
constexpr double fixed_weight = 1e6;      // of a point that stays
constexpr double end_weight = 100.0;      // of a closed end: smoothing would draw it in
constexpr double borrowed_weight = 0.02;  // of a point in the parent's lumen
constexpr double unsettled_weight = 0.1;  // of a point whose ridge lies beyond the climb, as beside an ostium
constexpr double kept_radius = 0.93;      // of the ridge's radius that smoothing must leave
constexpr int stiffening_rounds = 6;
constexpr int return_rounds = 16;          // what is not inside by then takes the raw path
constexpr double more_weight = 4.0;        // per round
constexpr double cap_clearance = 0.05;     // of the radius: the last point's distance from a cap
constexpr std::size_t tangent_points = 2;  // to either side; twice that at an end, whose last pieces may lean
constexpr std::size_t min_pieces = 6;
constexpr std::size_t end_direction_points = 10;  // three radii: the last pieces alone may lean
constexpr double max_cap_radii = 4.0;             // straight on to the cap
constexpr double narrowest_mm = 0.1;              // points stand no closer than in a lumen of this radius
constexpr double repeat_mm = 1e-6;                // points nearer than this are one

/// Distance of a point out of another line's lumen: min |x − c| − r over it; negative inside.
double outside_mm(const std::vector<CentrelinePoint>& line, const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector3d chord = line[i + 1].position_mm - line[i].position_mm;
    const double f = std::clamp((x - line[i].position_mm).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    const double radius = (1.0 - f) * line[i].radius_mm + f * line[i + 1].radius_mm;
    least = std::min(least, (x - line[i].position_mm - f * chord).norm() - radius);
  }
  return least;
}

class Fit {
 public:
  Fit(const LumenSpace& lumen, LineEnd start, LineEnd end, const FittedLine* parent)
      : lumen_(lumen), start_(start), end_(end), parent_(parent) {}

  std::vector<Vector3d> run(const std::vector<Vector3d>& path, double step) {
    row_ = resample_by_radius(path, radii(path), step, min_pieces);
    target_ = row_;
    weight_.assign(row_.size(), 1.0);
    wanted_radius_.assign(row_.size(), 0.0);
    hold_ends();
    smooth();
    stay_inside();
    for (int pass = 0; pass < passes; ++pass) {
      row_ = resample_by_radius(row_, radii(row_), step, min_pieces);
      climb();
      smooth_on_ridge();
    }
    return row_;
  }

 private:
  [[nodiscard]] std::vector<double> radii(const std::vector<Vector3d>& line) const {
    std::vector<double> r;
    r.reserve(line.size());
    for (const Vector3d& p : line) r.push_back(std::max(narrowest_mm, lumen_.at(p).radius_mm));
    return r;
  }

  void hold_ends() {
    weight_.front() = start_ == LineEnd::fixed ? fixed_weight : end_weight;
    weight_.back() = end_ == LineEnd::fixed ? fixed_weight : end_weight;
  }

  [[nodiscard]] Vector3d tangent(std::size_t i) const {
    const std::size_t last = row_.size() - 1;
    const std::size_t reach =
        i < tangent_points || i + tangent_points > last ? 2 * tangent_points : tangent_points;
    return (row_[std::min(i + reach, last)] - row_[i < reach ? 0 : i - reach]).stableNormalized();
  }

  void climb() {
    const std::size_t count = row_.size();
    target_ = row_;
    weight_.assign(count, 1.0);
    wanted_radius_.assign(count, 0.0);
    bool borrowed = parent_ != nullptr;  // still in the parent's lumen
    for (std::size_t i = 0; i < count; ++i) {
      if ((i == 0 && start_ == LineEnd::fixed) || (i + 1 == count && end_ == LineEnd::fixed)) continue;
      const double radius = lumen_.at(row_[i]).radius_mm;
      if (borrowed) {
        const double outside = outside_mm(parent_->points, row_[i]);
        borrowed = outside < radius;
        weight_[i] = std::max(borrowed_weight, std::min(1.0, outside / radius));
        if (outside <= 0.0) {
          wanted_radius_[i] = 0.5 * radius;
          continue;
        }
      }
      const RidgePoint ridge = climb_to_ridge(lumen_, row_[i], tangent(i), climb_part * radius);
      target_[i] = ridge.position_mm;
      wanted_radius_[i] = ridge.settled ? ridge.radius_mm : radius;
      if (!ridge.settled) weight_[i] *= unsettled_weight;
    }
    hold_ends();
  }

  void smooth() {
    row_ = smooth_row(target_, weight_, stiffness);
    for (std::size_t i : {std::size_t{0}, row_.size() - 1})
      if (weight_[i] >= fixed_weight) row_[i] = target_[i];
  }

  void smooth_on_ridge() {
    for (int round = 0; round < stiffening_rounds; ++round) {
      smooth();
      bool kept = true;
      for (std::size_t i = 0; i < row_.size(); ++i) {
        if (weight_[i] >= fixed_weight || lumen_.at(row_[i]).radius_mm >= kept_radius * wanted_radius_[i])
          continue;
        weight_[i] *= more_weight;
        kept = false;
      }
      if (kept) break;
    }
    stay_inside();
  }

  /// What smoothing put across a wall goes back to where it came from, until every piece lies in the lumen.
  void stay_inside() {
    std::vector<bool> back(row_.size(), false);
    for (int round = 0; round < return_rounds; ++round) {
      bool inside = true;
      for (std::size_t i = 0; i < row_.size(); ++i) {
        const bool bad = lumen_.at(row_[i]).reach_mm <= 0.0 || (i > 0 && !lumen_.sees(row_[i - 1], row_[i]));
        if (!bad) continue;
        for (std::size_t k = i == 0 ? 0 : i - 1; k <= i; ++k) {
          if (back[k]) continue;
          back[k] = true;
          row_[k] = target_[k];
          inside = false;
        }
      }
      if (inside) return;
    }
  }

  const LumenSpace& lumen_;
  LineEnd start_;
  LineEnd end_;
  const FittedLine* parent_;
  std::vector<Vector3d> row_;
  std::vector<Vector3d> target_;
  std::vector<double> weight_;
  std::vector<double> wanted_radius_;
};

/// Straight on to the cap. Returns the length of arc added.
double reach_cap(const LumenSpace& lumen, std::vector<Vector3d>& row) {
  const std::size_t n = row.size();
  const Vector3d direction = (row[n - 1] - row[n - std::min(n, end_direction_points)]).stableNormalized();
  const double radius = lumen.at(row[n - 1]).radius_mm;
  const double way = lumen.free_way_mm(row[n - 1], direction) - cap_clearance * radius;
  // Much further than the ball's radius is no cap: the end was found beside a wall that closes slowly.
  if (!(way > 0.1 * radius) || way > max_cap_radii * radius) return 0.0;
  const double step = (row[n - 1] - row[n - 2]).norm();
  const auto pieces = static_cast<std::size_t>(std::ceil(way / step));
  const Vector3d from = row[n - 1];
  double added = 0.0;
  for (std::size_t k = 1; k <= pieces; ++k) {
    const double along = way * static_cast<double>(k) / static_cast<double>(pieces);
    const Vector3d p = from + along * direction;
    if (lumen.at(p).reach_mm < 0.5 * cap_clearance * radius) break;
    row.push_back(p);
    added = along;
  }
  return added;
}

void add_geometry(const LumenSpace& lumen, const std::vector<Vector3d>& row,
                  std::vector<CentrelinePoint>& points) {
  points.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, row.size() - 1);
    CentrelinePoint& p = points[i];
    p.position_mm = row[i];
    p.radius_mm = lumen.at(row[i]).radius_mm;
    p.arc_mm = i == 0 ? 0.0 : points[i - 1].arc_mm + (row[i] - row[i - 1]).norm();
    p.tangent = (row[after] - row[before]).stableNormalized();
    if (before == i || after == i) continue;
    // κ = (c″ (c′·c′) − c′ (c′·c″)) / |c′|⁴, differences per point
    const Vector3d first = 0.5 * (row[after] - row[before]);
    const Vector3d second = row[after] - 2.0 * row[i] + row[before];
    const double square = first.squaredNorm();
    p.curvature_per_mm = (second * square - first * first.dot(second)) / (square * square);
  }
  points.front().curvature_per_mm = points[1].curvature_per_mm;
  points.back().curvature_per_mm = points[points.size() - 2].curvature_per_mm;
}

double ostium_arc_mm(const std::vector<CentrelinePoint>& points, const FittedLine& parent) {
  double before = outside_mm(parent.points, points[0].position_mm);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double here = outside_mm(parent.points, points[i].position_mm);
    if (here > 0.0) {
      const double f = before < 0.0 ? before / (before - here) : 0.0;
      return points[i - 1].arc_mm + f * (points[i].arc_mm - points[i - 1].arc_mm);
    }
    before = here;
  }
  return points.back().arc_mm;
}

/// Points too close together to give a direction go; the first and the last stay.
void drop_repeats(std::vector<Vector3d>& row) {
  std::vector<Vector3d> kept{row.front()};
  for (std::size_t i = 1; i < row.size(); ++i) {
    const bool last = i + 1 == row.size();
    while (last && kept.size() > 1 && (row[i] - kept.back()).norm() < repeat_mm) kept.pop_back();
    if ((row[i] - kept.back()).norm() >= repeat_mm) kept.push_back(row[i]);
  }
  if (kept.size() == 1) kept.emplace_back(kept[0] + repeat_mm * Vector3d::UnitX());  // a line of no length
  row = std::move(kept);
}

bool lies_in_lumen(const LumenSpace& lumen, const std::vector<Vector3d>& row) {
  for (std::size_t i = 0; i + 1 < row.size(); ++i)
    if (!lumen.sees(row[i], row[i + 1])) return false;
  return true;
}

}  // namespace

FittedLine fit_line(const LumenSpace& lumen, const std::vector<Vector3d>& path_mm, LineEnd start, LineEnd end,
                    const FittedLine* parent, double points_per_radius) {
  FittedLine line;
  std::vector<Vector3d> row = Fit(lumen, start, end, parent).run(path_mm, 1.0 / points_per_radius);
  if (end == LineEnd::closed) line.end_cap_mm = reach_cap(lumen, row);
  if (start == LineEnd::closed) {
    std::reverse(row.begin(), row.end());
    line.start_cap_mm = reach_cap(lumen, row);
    std::reverse(row.begin(), row.end());
  }
  drop_repeats(row);
  if (!lies_in_lumen(lumen, row)) {  // the raw path does: its steps lie in inscribed balls
    row = path_mm;
    drop_repeats(row);
    line.start_cap_mm = line.end_cap_mm = 0.0;
  }
  add_geometry(lumen, row, line.points);
  if (parent != nullptr) line.ostium_arc_mm = ostium_arc_mm(line.points, *parent);
  return line;
}

}  // namespace endowire::vessel

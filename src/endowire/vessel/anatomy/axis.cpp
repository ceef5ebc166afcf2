#include "endowire/vessel/anatomy/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

/// Stations this far apart follow bends of 4 mm radius to 1e-6 mm; twice as far, to 1e-4 mm.
constexpr double station_mm = 0.5;
/// The distance to the axis errs by the square of this: nothing.
constexpr double foot_tolerance_mm = 1e-7;

/// Gaussian elimination with partial pivoting, rows in one order. The systems here have some 40 rows.
void solve_in_place(std::vector<std::vector<double>>& a, std::vector<Vector3d>& b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      if (factor == 0.0) continue;
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
}

/// The quintic spline: knots in chord length, each with derivatives by it.
struct Spline {
  std::vector<double> knots;
  std::vector<Jet<Vector3d>> jets;

  [[nodiscard]] Quintic<Vector3d> piece(std::size_t i) const {
    const double h = knots[i + 1] - knots[i];
    const auto scaled = [h](const Jet<Vector3d>& j) {
      return Jet<Vector3d>{j.value, h * j.first, h * h * j.second};
    };
    return {scaled(jets[i]), scaled(jets[i + 1])};
  }
};

/// First and second derivatives at the inner knots from the continuity of the third and fourth.
///
/// With p of one piece, h its length, Δ = p₁ − p₀:
///   h³ p‴(0) =  60 Δ − h (36 p′₀ + 24 p′₁) − h² (9 p″₀ − 3 p″₁)
///   h³ p‴(1) =  60 Δ − h (24 p′₀ + 36 p′₁) − h² (3 p″₀ − 9 p″₁)
///   h⁴ p⁗(0) = −360 Δ + h (192 p′₀ + 168 p′₁) + h² (36 p″₀ − 24 p″₁)
///   h⁴ p⁗(1) =  360 Δ − h (168 p′₀ + 192 p′₁) − h² (24 p″₀ − 36 p″₁)
void solve_inner_derivatives(Spline& spline) {
  const std::size_t inner = spline.jets.size() - 2;
  std::vector<std::vector<double>> a(2 * inner, std::vector<double>(2 * inner, 0.0));
  std::vector<Vector3d> b(2 * inner, Vector3d::Zero());
  const auto add = [&](std::size_t row, std::size_t knot, double first, double second) {
    const Jet<Vector3d>& jet = spline.jets[knot];
    if (knot == 0 || knot == inner + 1) {
      b[row] -= first * jet.first + second * jet.second;
    } else {
      a[row][2 * (knot - 1)] += first;
      a[row][2 * (knot - 1) + 1] += second;
    }
  };
  for (std::size_t k = 1; k <= inner; ++k) {
    const double l = spline.knots[k] - spline.knots[k - 1];
    const double r = spline.knots[k + 1] - spline.knots[k];
    const Vector3d left = spline.jets[k].value - spline.jets[k - 1].value;
    const Vector3d right = spline.jets[k + 1].value - spline.jets[k].value;
    const std::size_t third = 2 * (k - 1);
    add(third, k - 1, -24.0 / (l * l), -3.0 / l);
    add(third, k, -36.0 / (l * l) + 36.0 / (r * r), 9.0 / l + 9.0 / r);
    add(third, k + 1, 24.0 / (r * r), -3.0 / r);
    b[third] += 60.0 * right / (r * r * r) - 60.0 * left / (l * l * l);
    const std::size_t fourth = third + 1;
    add(fourth, k - 1, -168.0 / (l * l * l), -24.0 / (l * l));
    add(fourth, k, -192.0 / (l * l * l) - 192.0 / (r * r * r), 36.0 / (l * l) - 36.0 / (r * r));
    add(fourth, k + 1, -168.0 / (r * r * r), 24.0 / (r * r));
    b[fourth] += -360.0 * right / (r * r * r * r) - 360.0 * left / (l * l * l * l);
  }
  solve_in_place(a, b);
  for (std::size_t k = 1; k <= inner; ++k) {
    spline.jets[k].first = b[2 * (k - 1)];
    spline.jets[k].second = b[2 * (k - 1) + 1];
  }
}

/// Length of a piece from its beginning to t, by Gauss–Legendre with five points on each of `parts` parts.
double length_to(const Quintic<Vector3d>& piece, double t) {
  constexpr std::array<double, 5> nodes{-0.906179845938664, -0.5384693101056831, 0.0, 0.5384693101056831,
                                        0.906179845938664};
  constexpr std::array<double, 5> weights{0.23692688505618908, 0.47862867049936647, 0.5688888888888889,
                                          0.47862867049936647, 0.23692688505618908};
  constexpr int parts = 4;
  double sum = 0.0;
  for (int part = 0; part < parts; ++part)
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double at = t * (part + 0.5 * (1.0 + nodes[k])) / parts;
      sum += weights[k] * length(piece.at(at).first);
    }
  return 0.5 * t / parts * sum;
}

}  // namespace

Axis Axis::spline(const CurveEnd& begin, const std::vector<Vector3d>& through_mm, const CurveEnd& end) {
  Spline spline;
  // By chord length the speed is near one, so that curvature is the second derivative.
  spline.jets.push_back({begin.position_mm, begin.direction, begin.curvature_per_mm});
  for (const Vector3d& point : through_mm) spline.jets.push_back({point, Vector3d::Zero(), Vector3d::Zero()});
  spline.jets.push_back({end.position_mm, end.direction, end.curvature_per_mm});
  spline.knots.push_back(0.0);
  for (std::size_t i = 1; i < spline.jets.size(); ++i) {
    const double chord = length(spline.jets[i].value - spline.jets[i - 1].value);
    ENDOWIRE_EXPECTS(chord > 0.0, "two points of a curve differ");
    spline.knots.push_back(spline.knots.back() + chord);
  }
  if (!through_mm.empty()) solve_inner_derivatives(spline);

  std::vector<Quintic<Vector3d>> pieces;
  std::vector<double> starts{0.0};
  for (std::size_t i = 0; i + 1 < spline.knots.size(); ++i) {
    pieces.push_back(spline.piece(i));
    starts.push_back(starts.back() + length_to(pieces.back(), 1.0));
  }
  Axis axis;
  axis.length_mm_ = starts.back();
  const double count = std::ceil(axis.length_mm_ / station_mm);
  axis.step_mm_ = axis.length_mm_ / count;
  std::size_t i = 0;
  double t = 0.0;
  for (double k = 0.0; k <= count; k += 1.0) {
    const double arc = k * axis.step_mm_;
    while (i + 1 < pieces.size() && arc > starts[i + 1]) {
      ++i;
      t = 0.0;
    }
    for (int iteration = 0; iteration < 8; ++iteration) {
      const double miss = arc - starts[i] - length_to(pieces[i], t);
      t += miss / length(pieces[i].at(t).first);
      if (std::abs(miss) < 1e-12 * axis.length_mm_) break;
    }
    const Jet<Vector3d> jet = pieces[i].at(t);
    Station station;
    station.position_mm = jet.value;
    station.tangent = unit(jet.first);
    const double speed2 = dot(jet.first, jet.first);
    station.curvature_per_mm = (jet.second - dot(jet.second, station.tangent) * station.tangent) / speed2;
    axis.stations_.push_back(station);
  }
  const double h = axis.step_mm_;
  const auto jet = [h](const Station& s) {
    return Jet<Vector3d>{s.position_mm, h * s.tangent, h * h * s.curvature_per_mm};
  };
  for (std::size_t k = 0; k + 1 < axis.stations_.size(); ++k)
    axis.curves_.emplace_back(jet(axis.stations_[k]), jet(axis.stations_[k + 1]));
  axis.set_radius(RadiusProfile({{0.0, 0.0}}));
  return axis;
}

void Axis::set_radius(const RadiusProfile& profile) {
  double arc = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i, arc = static_cast<double>(i) * step_mm_) {
    const RadiusProfile::Value value = profile.at(arc);
    stations_[i].radius_mm = value.radius_mm;
    stations_[i].radius_slope = value.slope;
    stations_[i].radius_bend_per_mm = value.bend_per_mm;
  }
  radii_.clear();
  const double h = step_mm_;
  const auto jet = [h](const Station& s) {
    return Jet<double>{s.radius_mm, h * s.radius_slope, h * h * s.radius_bend_per_mm};
  };
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i)
    radii_.emplace_back(jet(stations_[i]), jet(stations_[i + 1]));
}

Axis::Place Axis::place(double arc_mm) const {
  const double along = arc_mm / step_mm_;
  const std::size_t last = curves_.size() - 1;
  const std::size_t station = along <= 0.0 ? 0 : std::min(last, static_cast<std::size_t>(along));
  return {station, along - static_cast<double>(station)};
}

AxisPoint Axis::at(double arc_mm) const {
  const double inside = std::clamp(arc_mm, 0.0, length_mm_);
  const auto [i, t] = place(inside);
  const Jet<Vector3d> c = curves_[i].at(t);
  const Jet<double> r = radii_[i].at(t);
  const double step2 = step_mm_ * step_mm_;
  AxisPoint point{c.value, unit(c.first), c.second / step2, r.value, r.first / step_mm_, r.second / step2};
  if (arc_mm != inside) {
    point.position_mm += (arc_mm - inside) * point.tangent;
    point.curvature_per_mm = Vector3d::Zero();
    point.radius_slope = point.radius_bend_per_mm = 0.0;
  }
  return point;
}

double Axis::foot_mm(const Vector3d& point_mm, double from_mm, double to_mm, double guess_mm) const {
  // The derivative of half the squared distance, negated, and its own derivative.
  const auto slope = [&](double arc, double& derivative) {
    const double inside = std::clamp(arc, 0.0, length_mm_);
    const auto [i, t] = place(inside);
    const Jet<Vector3d> c = curves_[i].at(t);
    const Vector3d away = point_mm - c.value;
    derivative = (arc == inside ? dot(away, c.second) - dot(c.first, c.first) : -dot(c.first, c.first)) /
                 (step_mm_ * step_mm_);
    return dot(away, c.first) / step_mm_ - (arc - inside);
  };
  double low = from_mm;
  double high = to_mm;
  double arc = guess_mm;
  for (int iteration = 0; iteration < 30; ++iteration) {
    double derivative = 0.0;
    const double value = slope(arc, derivative);
    (value > 0.0 ? low : high) = arc;
    double next = derivative < 0.0 ? arc - value / derivative : 0.5 * (low + high);
    if (next <= low) next = low > from_mm ? 0.5 * (low + arc) : low;
    if (next >= high) next = high < to_mm ? 0.5 * (high + arc) : high;
    const double change = std::abs(next - arc);
    arc = next;
    if (change < foot_tolerance_mm) break;
  }
  return arc;
}

double Axis::nearest_arc_mm(const Vector3d& point_mm) const {
  std::size_t best = 0;
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const Vector3d away = stations_[i].position_mm - point_mm;
    if (dot(away, away) >= nearest) continue;
    nearest = dot(away, away);
    best = i;
  }
  const double arc = static_cast<double>(best) * step_mm_;
  return foot_mm(point_mm, std::max(0.0, arc - step_mm_), std::min(length_mm_, arc + step_mm_), arc);
}

}  // namespace endowire::vessel::anatomy

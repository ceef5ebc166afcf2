#include "support/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace endowire::test {

namespace {

constexpr int kSteps = 4000;

/// State of a curve that is followed from the tip: angle, its derivative, and the two end coordinates.
struct Curve {
  double angle, slope, along, across;
};

Curve moved(const Curve& a, double h, const Curve& rate) {
  return {a.angle + h * rate.angle, a.slope + h * rate.slope, a.along + h * rate.along,
          a.across + h * rate.across};
}

/// Runge–Kutta over a unit length: angle'' = second(s, angle).
template <typename Second>
Curve follow(double tip_angle, Second second, std::vector<PlanePoint>* way = nullptr) {
  Curve y{tip_angle, 0.0, 0.0, 0.0};
  const double h = 1.0 / kSteps;
  const auto rate = [&](double s, const Curve& c) {
    return Curve{c.slope, second(s, c.angle), std::cos(c.angle), std::sin(c.angle)};
  };
  for (int i = 0; i < kSteps; ++i) {
    constexpr int kDrawn = 50;
    if (way != nullptr && i % kDrawn == 0) way->push_back({y.along, y.across});
    const double s = i * h;
    const Curve a = rate(s, y);
    const Curve b = rate(s + 0.5 * h, moved(y, 0.5 * h, a));
    const Curve c = rate(s + 0.5 * h, moved(y, 0.5 * h, b));
    const Curve d = rate(s + h, moved(y, h, c));
    for (const auto& [part, weight] : {std::pair{&a, 1.0}, {&b, 2.0}, {&c, 2.0}, {&d, 1.0}}) {
      y = moved(y, weight * h / 6.0, *part);
    }
  }
  return y;
}

/// The root of an increasing function.
template <typename Function>
double root(double low, double high, Function f) {
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <typename Load>
ElasticaEnd cantilever(Load load) {
  // Followed from the tip, the angle falls to that of the clamp; it grows with the tip's angle up to the first equilibrium.
  const auto second = [&](double s, double angle) { return -load(s) * std::cos(angle); };
  const double tip = root(0.0, 0.5 * std::numbers::pi, [&](double a) { return follow(a, second).angle; });
  const Curve end = follow(tip, second);
  return {tip, end.across, 1.0 - end.along};
}

template <typename Load>
std::vector<PlanePoint> cantilever_shape(double tip_angle_rad, Load load) {
  std::vector<PlanePoint> way;
  const Curve clamp = follow(
      tip_angle_rad, [&](double s, double angle) { return -load(s) * std::cos(angle); }, &way);
  way.push_back({clamp.along, clamp.across});
  for (PlanePoint& p : way) p = {clamp.along - p.x, clamp.across - p.y};
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

std::vector<PlanePoint> tip_loaded_shape(double alpha) {
  return cantilever_shape(tip_loaded_elastica(alpha).tip_angle_rad, [=](double) { return alpha; });
}

std::vector<PlanePoint> self_weight_shape(double gamma) {
  return cantilever_shape(self_weight_elastica(gamma).tip_angle_rad, [=](double s) { return gamma * s; });
}

ElasticaEnd tip_loaded_elastica(double alpha) {
  return cantilever([=](double) { return alpha; });
}

ElasticaEnd self_weight_elastica(double gamma) {
  return cantilever([=](double s) { return gamma * s; });
}

PostBuckling post_buckling(double end_angle_rad) {
  // K and E by the arithmetic–geometric mean.
  const double k = std::sin(0.5 * end_angle_rad);
  double a = 1.0;
  double b = std::sqrt(1.0 - k * k);
  double c = k;
  double sum = 0.5 * c * c;
  for (double weight = 1.0; std::abs(c) > 1e-15; weight *= 2.0) {
    const double mean = 0.5 * (a + b);
    c = 0.5 * (a - b);
    b = std::sqrt(a * b);
    a = mean;
    sum += weight * c * c;
  }
  const double first = std::numbers::pi / (2.0 * a);
  const double second = first * (1.0 - sum);
  const double ratio = 2.0 * first / std::numbers::pi;
  return {ratio * ratio, 2.0 * second / first - 1.0, k / first};
}

double michell_twist_rad(double bend_over_twist) {
  return 2.0 * std::numbers::pi * std::numbers::sqrt3 * bend_over_twist;
}

double twisted_rod_onset(double length) {
  const double h = 0.5 * length;
  const auto condition = [=](double q) {
    const double p = std::sqrt(1.0 + q * q);
    const auto even = [=](double k) { return k * std::sin(k * h); };
    const auto odd = [=](double k) { return std::sin(k * h) - k * h * std::cos(k * h); };
    return odd(p + q) * even(p - q) - odd(p - q) * even(p + q);
  };
  // q = 0 solves it without a deflection: the first root beyond.
  const double step = 1e-2 / h;
  double low = step;
  while (condition(low) * condition(low + step) > 0.0) low += step;
  const double sign = condition(low) < 0.0 ? 1.0 : -1.0;
  const double q = root(low, low + step, [&](double x) { return sign * condition(x); });
  return std::sqrt(1.0 + q * q);
}

LocalisedBuckling localised_buckling(double rigidity_n_mm2, double tension_n, double middle_rad) {
  const double c = std::cos(middle_rad);
  const double moment = std::sqrt(2.0 * rigidity_n_mm2 * tension_n * (1.0 + c));
  return {moment, 2.0 * rigidity_n_mm2 / moment * std::sqrt((1.0 + c) / (1.0 - c))};
}

double whip_hand_angle_rad(double lambda, double tip_angle_rad, double straight) {
  const Curve start =
      follow(tip_angle_rad, [=](double, double angle) { return lambda * lambda * std::sin(angle); });
  return start.angle + straight * start.slope;
}

double whip_snap_angle_rad(double lambda, double straight) {
  constexpr double kDifference = 1e-5;
  const double tip = root(0.0, std::numbers::pi, [=](double a) {
    return whip_hand_angle_rad(lambda, a - kDifference, straight) -
           whip_hand_angle_rad(lambda, a + kDifference, straight);
  });
  return whip_hand_angle_rad(lambda, tip, straight);
}

}  // namespace endowire::test

#include "endowire/vessel/anatomy/fillet.hpp"

#include <algorithm>

#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

// Walls that meet at less than 0.3° need no fillet, and 1 − c² would lose its digits.
constexpr double flat = 1e-5;
// A crease that turns so little that cutting it short misses the wall by less than this needs no small
// triangles [mm].
constexpr double unresolved_mm = 0.05;

double widening(double w) {
  return 1.0 + 3.0 * w * w;
}

}  // namespace

Fillet::Fillet(double carina_radius_mm, double angle_cosine)
    : carina_mm_(carina_radius_mm), base_mm_(carina_radius_mm / widening(0.5 * (1.0 - angle_cosine))) {}

WallSample Fillet::join(const WallSample& one, const WallSample& other) const {
  const WallSample& lesser = other.distance_mm < one.distance_mm ? other : one;
  if (lesser.distance_mm >= reach_mm()) return lesser;
  const double c = dot(one.gradient, other.gradient);
  if (1.0 - c < flat || 1.0 + c < flat) return lesser;
  const double rho = base_mm_ * widening(0.5 * (1.0 + c));
  const double a = rho - one.distance_mm;
  const double b = rho - other.distance_mm;
  const double lambda = (a - c * b) / (1.0 - c * c);
  const double mu = (b - c * a) / (1.0 - c * c);
  if (!(lambda > 0.0 && mu > 0.0)) return lesser;
  const Eigen::Vector3d q = lambda * one.gradient + mu * other.gradient;
  const double size = length(q);
  const double smooth = std::min(one.curvature_radius_mm, other.curvature_radius_mm);
  return {rho - size, q / size, std::min(smooth, std::max(rho, unresolved_mm / (1.0 - c)))};
}

}  // namespace endowire::vessel::anatomy

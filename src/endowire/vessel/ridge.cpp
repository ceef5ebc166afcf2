#include "endowire/vessel/ridge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace endowire::vessel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t max_planes = 14;  // four sides of the search and ten tangent planes
constexpr double side_part = 0.95;  // of the reach: a best place further out lies at the side of the search
constexpr double settled_fraction = 1e-4;  // of the radius: what more could be gained when the search ends

/// A bound on the radius: φ ≤ height + slope·x.
struct Plane {
  Vector2d slope;
  double height_mm;
};

/// Highest point under planes: at the corner of three of them that no other plane cuts off.
class Roof {
 public:
  explicit Roof(double reach_mm) : reach_mm_(reach_mm) {}
  void add(const Plane& plane) { planes_[count_++] = plane; }
  [[nodiscard]] bool full() const { return count_ == planes_.size(); }

  struct Top {
    Vector2d place_mm = Vector2d::Zero();
    double height_mm = -std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] Top top() const {
    Top best;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) try_corner(i, j, k, best);
        for (int side = 0; side < 4; ++side) try_side(i, j, side, best);
      }
      for (double x : {-reach_mm_, reach_mm_})
        for (double y : {-reach_mm_, reach_mm_}) keep(Vector2d(x, y), height(i, Vector2d(x, y)), best);
    }
    return best;
  }

 private:
  [[nodiscard]] double height(std::size_t i, const Vector2d& x) const {
    return planes_[i].height_mm + planes_[i].slope.dot(x);
  }
  void keep(const Vector2d& x, double height_mm, Top& best) const {
    if (!(x.cwiseAbs().maxCoeff() <= reach_mm_ * (1.0 + 1e-9)) || height_mm <= best.height_mm) return;
    for (std::size_t i = 0; i < count_; ++i)
      if (height(i, x) < height_mm - 1e-9 * (1.0 + std::abs(height_mm))) return;
    best = {x, height_mm};
  }
  void try_corner(std::size_t i, std::size_t j, std::size_t k, Top& best) const {
    const Vector2d u = planes_[i].slope - planes_[j].slope;
    const Vector2d v = planes_[i].slope - planes_[k].slope;
    const double determinant = u.x() * v.y() - u.y() * v.x();
    if (std::abs(determinant) < 1e-12) return;
    const double p = planes_[j].height_mm - planes_[i].height_mm;
    const double q = planes_[k].height_mm - planes_[i].height_mm;
    const Vector2d x((p * v.y() - q * u.y()) / determinant, (q * u.x() - p * v.x()) / determinant);
    keep(x, height(i, x), best);
  }
  void try_side(std::size_t i, std::size_t j, int side, Top& best) const {
    const int fixed = side / 2;
    const Vector2d u = planes_[i].slope - planes_[j].slope;
    if (std::abs(u[1 - fixed]) < 1e-12) return;
    Vector2d x;
    x[fixed] = side % 2 == 0 ? -reach_mm_ : reach_mm_;
    x[1 - fixed] = (planes_[j].height_mm - planes_[i].height_mm - u[fixed] * x[fixed]) / u[1 - fixed];
    keep(x, height(i, x), best);
  }

  double reach_mm_;
  std::array<Plane, max_planes> planes_;
  std::size_t count_ = 0;
};

}  // namespace

RidgePoint climb_to_ridge(const LumenSpace& lumen, const Vector3d& start_mm, const Vector3d& normal,
                          double reach_mm) {
  const Vector3d e1 = normal.unitOrthogonal();
  const Vector3d e2 = normal.cross(e1);
  Roof roof(reach_mm);
  RidgePoint best{start_mm, 0.0, false};
  Vector2d best_place = Vector2d::Zero();
  Vector2d place = Vector2d::Zero();
  Vector3d last = start_mm;  // where a distance is known: it bounds the next
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (int step = 0; !roof.full(); ++step) {
    const Vector3d p = start_mm + place.x() * e1 + place.y() * e2;
    const double within = nearest_mm + (p - last).norm();
    const LumenSpace::Sample s = lumen.at(p, within * (1.0 + 1e-9) + 1e-9);
    nearest_mm = std::abs(s.reach_mm);
    last = p;
    if (s.radius_mm <= 0.0 || lumen.beyond_opening(p)) {  // across a wall: half the way back
      if (step == 0 || (place - best_place).norm() < settled_fraction * reach_mm) break;
      place = 0.5 * (place + best_place);
      if (step > 20) break;
      continue;
    }
    const Vector3d away = (p - s.nearest_mm) / s.radius_mm;
    const Vector2d slope(away.dot(e1), away.dot(e2));
    roof.add({slope, s.radius_mm - slope.dot(place)});
    if (s.radius_mm > best.radius_mm) {
      best.position_mm = p;
      best.radius_mm = s.radius_mm;
      best_place = place;
    }
    const Roof::Top top = roof.top();
    if (top.height_mm - best.radius_mm <= settled_fraction * best.radius_mm) break;
    place = top.place_mm;
  }
  best.settled = best.radius_mm > 0.0 && best_place.cwiseAbs().maxCoeff() < side_part * reach_mm;
  return best;
}

}  // namespace endowire::vessel

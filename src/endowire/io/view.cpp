#include "endowire/io/view.hpp"

#include <cmath>

namespace endowire::io {

using Eigen::Vector3d;

Directions directions_of(const Eigen::AlignedBox3d& box, const Vector3d& access_mm, const Vector3d& gravity) {
  const Vector3d size = box.sizes();
  Directions directions;
  directions.forward = gravity;
  if (!(gravity.norm() > 0.0)) {
    Eigen::Index shortest = 0;
    size.minCoeff(&shortest);
    directions.forward = Vector3d::Unit(shortest);
  }
  directions.forward.normalize();
  Vector3d up = Vector3d::Zero();
  double longest = -1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vector3d unit = Vector3d::Unit(axis);
    if (std::abs(unit.dot(directions.forward)) > 0.7 || size[axis] <= longest) continue;
    longest = size[axis];
    up = unit.dot(box.center() - access_mm) < 0.0 ? Vector3d(-unit) : unit;
  }
  directions.up = (up - up.dot(directions.forward) * directions.forward).normalized();
  return directions;
}

}  // namespace endowire::io

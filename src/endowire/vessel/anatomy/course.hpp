#pragma once

#include <Eigen/Core>
#include <vector>

namespace endowire::vessel::anatomy {

/// Points of a vessel's axis, told as one would walk it: straight on, round a bend, straight on.
class Course {
 public:
  /// @param direction  length one
  Course(const Eigen::Vector3d& begin_mm, const Eigen::Vector3d& direction)
      : position_mm_(begin_mm), direction_(direction) {}

  Course& straight(double length_mm);
  /// Along a circle, turning towards a direction (its part normal to the way so far).
  Course& bend(const Eigen::Vector3d& towards, double radius_mm, double angle_rad);

  [[nodiscard]] const Eigen::Vector3d& position_mm() const { return position_mm_; }
  [[nodiscard]] const Eigen::Vector3d& direction() const { return direction_; }
  /// Where every step ended, at most 24° or 6 mm apart.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points_mm() const { return points_mm_; }

 private:
  Eigen::Vector3d position_mm_;
  Eigen::Vector3d direction_;
  std::vector<Eigen::Vector3d> points_mm_;
};

}  // namespace endowire::vessel::anatomy

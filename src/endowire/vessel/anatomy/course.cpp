#include "endowire/vessel/anatomy/course.hpp"

#include <cmath>

#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

constexpr double longest_mm = 6.0;
constexpr double widest_deg = 24.0;

}  // namespace

Course& Course::straight(double length_mm) {
  const double steps = std::ceil(length_mm / longest_mm);
  for (double i = 0.0; i < steps; i += 1.0) {
    position_mm_ += length_mm / steps * direction_;
    points_mm_.push_back(position_mm_);
  }
  return *this;
}

Course& Course::bend(const Eigen::Vector3d& towards, double radius_mm, double angle_rad) {
  const Eigen::Vector3d inward = unit(towards - dot(towards, direction_) * direction_);
  const Eigen::Vector3d centre = position_mm_ + radius_mm * inward;
  const Eigen::Vector3d along = direction_;
  const double steps = std::ceil(angle_rad / radians(widest_deg));
  for (double i = 1.0; i <= steps; i += 1.0) {
    const double angle = angle_rad * i / steps;
    position_mm_ = centre + radius_mm * (sine(angle) * along - cosine(angle) * inward);
    direction_ = cosine(angle) * along + sine(angle) * inward;
    points_mm_.push_back(position_mm_);
  }
  return *this;
}

}  // namespace endowire::vessel::anatomy

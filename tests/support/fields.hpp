#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "endowire/vessel/field.hpp"

namespace endowire::test {

/// Another field, turned and shifted: φ'(x) = φ(Rᵀ(x − t)).
class MovedField final : public vessel::Field {
 public:
  MovedField(std::shared_ptr<const vessel::Field> field, const Eigen::Isometry3d& motion)
      : field_(std::move(field)), motion_(motion), back_(motion.inverse()) {}
  [[nodiscard]] vessel::WallDistance at(const Eigen::Vector3d& p) const override {
    const vessel::WallDistance w = field_->at(back_ * p);
    return {w.distance_mm, motion_.linear() * w.gradient};
  }
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& p) const override {
    return field_->lumen_radius_mm(back_ * p);
  }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& p) const override {
    return field_->tissue_to_next_lumen_mm(back_ * p);
  }
  [[nodiscard]] int exit_at(const Eigen::Vector3d& p) const override { return field_->exit_at(back_ * p); }
  [[nodiscard]] double error_mm() const override { return field_->error_mm(); }

 private:
  std::shared_ptr<const vessel::Field> field_;
  Eigen::Isometry3d motion_, back_;
};

/// A tube along z that ends in a half sphere at z = length: a dead end. φ = R − |x − nearest point of the axis|
class DeadEndField final : public vessel::Field {
 public:
  DeadEndField(double radius_mm, double length_mm) : radius_mm_(radius_mm), length_mm_(length_mm) {}
  [[nodiscard]] vessel::WallDistance at(const Eigen::Vector3d& p) const override {
    const Eigen::Vector3d offset = p - Eigen::Vector3d(0.0, 0.0, std::min(p.z(), length_mm_));
    const double distance = offset.norm();
    if (distance < 1e-12) return {radius_mm_, -Eigen::Vector3d::UnitX()};
    return {radius_mm_ - distance, -offset / distance};
  }
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& /*p*/) const override { return radius_mm_; }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& /*p*/) const override {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] int exit_at(const Eigen::Vector3d& /*p*/) const override { return 0; }
  [[nodiscard]] double error_mm() const override { return 0.0; }

 private:
  double radius_mm_, length_mm_;
};

/// Two parallel tubes along z, their axes at x = ± half the distance, side by side with tissue between them.
class TwinTubesField final : public vessel::Field {
 public:
  TwinTubesField(double radius_mm, double axes_apart_mm) : radius_mm_(radius_mm), apart_mm_(axes_apart_mm) {}
  [[nodiscard]] vessel::WallDistance at(const Eigen::Vector3d& p) const override {
    const Eigen::Vector3d offset(p.x() - (p.x() < 0.0 ? -0.5 : 0.5) * apart_mm_, p.y(), 0.0);
    const double distance = offset.norm();
    if (distance < 1e-12) return {radius_mm_, Eigen::Vector3d::UnitY()};
    return {radius_mm_ - distance, -offset / distance};
  }
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& /*p*/) const override { return radius_mm_; }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& /*p*/) const override {
    return apart_mm_ - 2.0 * radius_mm_;
  }
  [[nodiscard]] int exit_at(const Eigen::Vector3d& /*p*/) const override { return 0; }
  [[nodiscard]] double error_mm() const override { return 0.0; }

 private:
  double radius_mm_, apart_mm_;
};

/// Lumen around a wedge of tissue whose edge lies on the y axis and points along +x: a carina.
class CarinaField final : public vessel::Field {
 public:
  /// @param half_angle_rad  between the axis of the wedge and its faces
  CarinaField(double half_angle_rad, double lumen_radius_mm)
      : along_x_(-std::cos(half_angle_rad)),
        along_z_(std::sin(half_angle_rad)),
        radius_mm_(lumen_radius_mm) {}
  [[nodiscard]] vessel::WallDistance at(const Eigen::Vector3d& p) const override {
    const double side = p.z() < 0.0 ? -1.0 : 1.0;
    const Eigen::Vector3d face(along_x_, 0.0, side * along_z_);
    const Eigen::Vector3d normal(along_z_, 0.0, -side * along_x_);
    if (face.dot(p) > 0.0) return {normal.dot(p), normal};
    const Eigen::Vector3d from_edge(p.x(), 0.0, p.z());
    const double distance = from_edge.norm();
    if (distance < 1e-12) return {0.0, Eigen::Vector3d::UnitX()};
    return {distance, from_edge / distance};
  }
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& /*p*/) const override { return radius_mm_; }
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& /*p*/) const override {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] int exit_at(const Eigen::Vector3d& /*p*/) const override { return 0; }
  [[nodiscard]] double error_mm() const override { return 0.0; }

 private:
  double along_x_, along_z_, radius_mm_;  ///< of the faces, away from the edge
};

}  // namespace endowire::test

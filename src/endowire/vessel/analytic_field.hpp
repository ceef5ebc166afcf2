#pragma once

#include <Eigen/Core>
#include <limits>

#include "endowire/vessel/field.hpp"

namespace endowire::vessel {

/// Fields with a closed form: oracles for tests and validation. Distance, gradient and lumen radius are exact
/// everywhere; on the medial axis, where the gradient does not exist, it is one of its one-sided limits.
/// There are no openings and no second lumen.
class AnalyticField : public Field {
 public:
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] int exit_at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double error_mm() const override { return 0.0; }
};

/// φ = R − |x − c|
class SphereField final : public AnalyticField {
 public:
  SphereField(const Eigen::Vector3d& centre_mm, double radius_mm);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

 private:
  Eigen::Vector3d centre_mm_;
  double radius_mm_;
};

/// Everything on the side of a plane its normal points to: φ = n·(x − p). The lumen radius is a parameter.
class HalfSpaceField final : public AnalyticField {
 public:
  HalfSpaceField(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal, double lumen_radius_mm);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

 private:
  Eigen::Vector3d point_mm_;
  Eigen::Vector3d normal_;
  double lumen_radius_mm_;
};

/// An endless straight tube: φ = R − |(x − p) − ((x − p)·a) a|
class TubeField final : public AnalyticField {
 public:
  TubeField(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& axis, double radius_mm);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

 private:
  Eigen::Vector3d point_mm_;
  Eigen::Vector3d axis_;
  double radius_mm_;
};

/// The inside of an endless cone, its apex at the origin of its axis: φ = z sin β − ρ cos β, β half its
/// opening angle; beyond the apex φ = −|x − apex| where that is nearer.
class ConeField final : public AnalyticField {
 public:
  /// @param axis            from the apex into the cone
  /// @param half_angle_rad  in (0, π/2)
  ConeField(const Eigen::Vector3d& apex_mm, const Eigen::Vector3d& axis, double half_angle_rad);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

 private:
  Eigen::Vector3d apex_mm_;
  Eigen::Vector3d axis_;
  double sine_;
  double cosine_;
};

/// A whole torus: a tube of radius r along a circle of radius R > r. φ = r − √((ρ − R)² + z²)
class TorusField final : public AnalyticField {
 public:
  TorusField(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& axis, double bend_radius_mm,
             double radius_mm);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

 private:
  Eigen::Vector3d centre_mm_;
  Eigen::Vector3d axis_;
  double bend_radius_mm_;
  double radius_mm_;
};

/// A tube along a centreline that runs straight, bends by an angle on a circle, and runs straight again (both
/// straights endless): φ = r − distance to the centreline. The centreline starts to bend at the origin of the
/// frame, comes along `inlet` and bends towards `towards`.
class BentTubeField final : public AnalyticField {
 public:
  /// @param bend_start_mm   where the bend begins on the centreline
  /// @param inlet           direction of travel before the bend
  /// @param towards         direction of the bend's centre; made normal to `inlet`
  /// @param bend_radius_mm  of the centreline, > radius_mm
  /// @param bend_angle_rad  in [0, π]
  /// @param radius_mm       of the tube
  BentTubeField(const Eigen::Vector3d& bend_start_mm, const Eigen::Vector3d& inlet,
                const Eigen::Vector3d& towards, double bend_radius_mm, double bend_angle_rad,
                double radius_mm);
  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;

  /// Point of the centreline at arc length s, 0 where the bend begins, negative before it.
  [[nodiscard]] Eigen::Vector3d centreline_mm(double s_mm) const;
  /// Direction of travel there.
  [[nodiscard]] Eigen::Vector3d tangent(double s_mm) const;
  [[nodiscard]] double bend_length_mm() const { return bend_radius_mm_ * bend_angle_rad_; }

 private:
  Eigen::Vector3d start_mm_;
  Eigen::Vector3d inlet_;
  Eigen::Vector3d towards_;
  double bend_radius_mm_;
  double bend_angle_rad_;
  double radius_mm_;
};

}  // namespace endowire::vessel

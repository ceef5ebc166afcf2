#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/vessel/anatomy/quintic.hpp"
#include "endowire/vessel/anatomy/radius_profile.hpp"

namespace endowire::vessel::anatomy {

/// Where a curve begins or ends and how it runs there.
struct CurveEnd {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();         ///< along the curve, length one
  Eigen::Vector3d curvature_per_mm = Eigen::Vector3d::Zero();  ///< vector, normal to direction
};

/// A point of a vessel's axis.
struct AxisPoint {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();           ///< along the axis, length one
  Eigen::Vector3d curvature_per_mm = Eigen::Vector3d::Zero();  ///< vector, towards the centre of curvature
  double radius_mm = 0.0;                                      ///< of the lumen
  double radius_slope = 0.0;                                   ///< change of the radius along the axis [-]
  double radius_bend_per_mm = 0.0;                             ///< change of that
};

/// The axis of a vessel by its arc length, with the lumen's radius along it.
///
/// The curve through given points is the quintic spline in chord length whose first four derivatives are
/// continuous, with given direction and curvature at both ends. It is then measured and kept as stations at
/// equal steps of arc length, each with position, tangent and curvature; between stations it is the quintic
/// that has those values at both. So the axis and its curvature are continuous everywhere, by construction.
///
/// Accuracy  arc length and unit speed to 1e-6 of a station's step; axis_test shows it.
class Axis {
 public:
  /// @param through_mm  points between the ends, in order; none is allowed
  [[nodiscard]] static Axis spline(const CurveEnd& begin, const std::vector<Eigen::Vector3d>& through_mm,
                                   const CurveEnd& end);

  void set_radius(const RadiusProfile& profile);

  [[nodiscard]] double length_mm() const { return length_mm_; }
  /// Beyond its ends an axis runs on straight with the radius of the end.
  [[nodiscard]] AxisPoint at(double arc_mm) const;

  /// Arc length of the foot of `point_mm` between two arc lengths, where it lies closest to the curve.
  ///
  ///   (x − c(s)) · c′(s) = 0, by Newton's method kept within the bracket
  ///
  /// Domain  the squared distance must have one minimum in the bracket: true for points nearer than the
  ///         radius of curvature. Returns the bracket's end where the minimum lies beyond it.
  /// @param guess_mm  where to begin
  [[nodiscard]] double foot_mm(const Eigen::Vector3d& point_mm, double from_mm, double to_mm,
                               double guess_mm) const;

  /// Arc length of the point of the whole axis nearest to `point_mm`.
  [[nodiscard]] double nearest_arc_mm(const Eigen::Vector3d& point_mm) const;

  /// Station `index` of `stations()`, at arc length index × step_mm().
  struct Station {
    Eigen::Vector3d position_mm;
    Eigen::Vector3d tangent;
    Eigen::Vector3d curvature_per_mm;
    double radius_mm = 0.0;
    double radius_slope = 0.0;
    double radius_bend_per_mm = 0.0;  ///< second derivative of the radius
  };
  [[nodiscard]] const std::vector<Station>& stations() const { return stations_; }
  [[nodiscard]] double step_mm() const { return step_mm_; }

 private:
  struct Place {
    std::size_t station;
    double fraction;
  };
  [[nodiscard]] Place place(double arc_mm) const;

  std::vector<Station> stations_;
  std::vector<Quintic<Eigen::Vector3d>>
      curves_;  ///< from each station to the next, by the fraction between them
  std::vector<Quintic<double>> radii_;
  double step_mm_ = 0.0;
  double length_mm_ = 0.0;
};

}  // namespace endowire::vessel::anatomy

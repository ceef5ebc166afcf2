#include "endowire/vessel/analytic_field.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "endowire/base/error.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

void require(bool holds, const char* field, double value, const char* allowed) {
  if (!holds)
    throw base::InputError(std::string("analytic field: ") + field + " is " + std::to_string(value) +
                           "; must be " + allowed);
}

Vector3d unit(const Vector3d& v, const char* field) {
  const double length = v.norm();
  require(std::isfinite(length) && length > 0.0, field, length, "a direction of length > 0");
  return v / length;
}

double positive(double value, const char* field) {
  require(std::isfinite(value) && value > 0.0, field, value, "> 0");
  return value;
}

/// φ = R − |offset from the nearest centreline point|
WallDistance inside_of(const Vector3d& offset, double radius_mm) {
  const double distance = offset.norm();
  const Vector3d outward = distance > 0.0 ? Vector3d(offset / distance) : Vector3d::UnitX();
  return {radius_mm - distance, -outward};
}

}  // namespace

double AnalyticField::tissue_to_next_lumen_mm(const Vector3d& /*point_mm*/) const {
  return std::numeric_limits<double>::infinity();
}

int AnalyticField::exit_at(const Vector3d& /*point_mm*/) const {
  return 0;
}

SphereField::SphereField(const Vector3d& centre_mm, double radius_mm)
    : centre_mm_(centre_mm), radius_mm_(positive(radius_mm, "radius_mm")) {}

WallDistance SphereField::at(const Vector3d& p) const {
  return inside_of(p - centre_mm_, radius_mm_);
}

double SphereField::lumen_radius_mm(const Vector3d& /*point_mm*/) const {
  return radius_mm_;
}

HalfSpaceField::HalfSpaceField(const Vector3d& point_mm, const Vector3d& normal, double lumen_radius_mm)
    : point_mm_(point_mm),
      normal_(unit(normal, "normal")),
      lumen_radius_mm_(positive(lumen_radius_mm, "lumen_radius_mm")) {}

WallDistance HalfSpaceField::at(const Vector3d& p) const {
  return {normal_.dot(p - point_mm_), normal_};
}

double HalfSpaceField::lumen_radius_mm(const Vector3d& /*point_mm*/) const {
  return lumen_radius_mm_;
}

TubeField::TubeField(const Vector3d& point_mm, const Vector3d& axis, double radius_mm)
    : point_mm_(point_mm), axis_(unit(axis, "axis")), radius_mm_(positive(radius_mm, "radius_mm")) {}

WallDistance TubeField::at(const Vector3d& p) const {
  const Vector3d r = p - point_mm_;
  const Vector3d across = r - r.dot(axis_) * axis_;
  if (across.isZero(0.0)) return {radius_mm_, axis_.unitOrthogonal()};
  return inside_of(across, radius_mm_);
}

double TubeField::lumen_radius_mm(const Vector3d& /*point_mm*/) const {
  return radius_mm_;
}

ConeField::ConeField(const Vector3d& apex_mm, const Vector3d& axis, double half_angle_rad)
    : apex_mm_(apex_mm),
      axis_(unit(axis, "axis")),
      sine_(std::sin(half_angle_rad)),
      cosine_(std::cos(half_angle_rad)) {
  require(half_angle_rad > 0.0 && half_angle_rad < 0.5 * std::numbers::pi, "half_angle_rad", half_angle_rad,
          "in (0, pi/2)");
}

WallDistance ConeField::at(const Vector3d& p) const {
  const Vector3d r = p - apex_mm_;
  const double z = r.dot(axis_);
  const Vector3d across = r - z * axis_;
  const double rho = across.norm();
  if (z * cosine_ + rho * sine_ <= 0.0) {  // the apex is nearest
    const double distance = r.norm();
    return {-distance, distance > 0.0 ? Vector3d(-r / distance) : axis_};
  }
  const Vector3d outward = rho > 0.0 ? Vector3d(across / rho) : axis_.unitOrthogonal();
  return {z * sine_ - rho * cosine_, sine_ * axis_ - cosine_ * outward};
}

/// Radius of the ball that touches the cone all round at the same height; tends to 0 at the apex.
double ConeField::lumen_radius_mm(const Vector3d& p) const {
  constexpr double smallest_mm = 1e-3;  // the interface promises > 0
  return std::max(smallest_mm, (p - apex_mm_).dot(axis_) * sine_ / cosine_);
}

TorusField::TorusField(const Vector3d& centre_mm, const Vector3d& axis, double bend_radius_mm,
                       double radius_mm)
    : centre_mm_(centre_mm),
      axis_(unit(axis, "axis")),
      bend_radius_mm_(bend_radius_mm),
      radius_mm_(positive(radius_mm, "radius_mm")) {
  require(bend_radius_mm > radius_mm, "bend_radius_mm", bend_radius_mm, "> radius_mm");
}

WallDistance TorusField::at(const Vector3d& p) const {
  const Vector3d r = p - centre_mm_;
  const Vector3d across = r - r.dot(axis_) * axis_;
  const double rho = across.norm();
  const Vector3d outward = rho > 0.0 ? Vector3d(across / rho) : axis_.unitOrthogonal();
  const Vector3d offset = r - bend_radius_mm_ * outward;
  if (offset.isZero(0.0)) return {radius_mm_, outward};
  return inside_of(offset, radius_mm_);
}

double TorusField::lumen_radius_mm(const Vector3d& /*point_mm*/) const {
  return radius_mm_;
}

BentTubeField::BentTubeField(const Vector3d& bend_start_mm, const Vector3d& inlet, const Vector3d& towards,
                             double bend_radius_mm, double bend_angle_rad, double radius_mm)
    : start_mm_(bend_start_mm),
      inlet_(unit(inlet, "inlet")),
      towards_(unit(towards - towards.dot(inlet_) * inlet_, "towards")),
      bend_radius_mm_(bend_radius_mm),
      bend_angle_rad_(bend_angle_rad),
      radius_mm_(positive(radius_mm, "radius_mm")) {
  require(bend_radius_mm > radius_mm, "bend_radius_mm", bend_radius_mm, "> radius_mm");
  require(bend_angle_rad >= 0.0 && bend_angle_rad <= std::numbers::pi, "bend_angle_rad", bend_angle_rad,
          "in [0, pi]");
}

Vector3d BentTubeField::centreline_mm(double s_mm) const {
  if (s_mm <= 0.0) return start_mm_ + s_mm * inlet_;
  const double bend = bend_length_mm();
  const double angle = std::min(s_mm, bend) / bend_radius_mm_;
  const Vector3d on_arc =
      start_mm_ + bend_radius_mm_ * (std::sin(angle) * inlet_ + (1.0 - std::cos(angle)) * towards_);
  return s_mm <= bend ? on_arc : Vector3d(on_arc + (s_mm - bend) * tangent(s_mm));
}

Vector3d BentTubeField::tangent(double s_mm) const {
  const double angle = std::clamp(s_mm / bend_radius_mm_, 0.0, bend_angle_rad_);
  return std::cos(angle) * inlet_ + std::sin(angle) * towards_;
}

WallDistance BentTubeField::at(const Vector3d& p) const {
  // The nearest of the three parts of the centreline: each part's own nearest point is found in closed form.
  Vector3d best = p - centreline_mm(std::min(0.0, (p - start_mm_).dot(inlet_)));
  const double bend = bend_length_mm();
  const Vector3d end = centreline_mm(bend);
  const Vector3d outlet = tangent(bend);
  const Vector3d to_outlet = p - centreline_mm(bend + std::max(0.0, (p - end).dot(outlet)));
  if (to_outlet.squaredNorm() < best.squaredNorm()) best = to_outlet;
  const Vector3d from_centre = p - (start_mm_ + bend_radius_mm_ * towards_);
  const double angle = std::atan2(from_centre.dot(inlet_), -from_centre.dot(towards_));
  if (angle > 0.0 && angle < bend_angle_rad_) {
    const Vector3d to_arc = p - centreline_mm(angle * bend_radius_mm_);
    if (to_arc.squaredNorm() < best.squaredNorm()) best = to_arc;
  }
  if (best.isZero(0.0)) return {radius_mm_, inlet_.cross(towards_)};
  return inside_of(best, radius_mm_);
}

double BentTubeField::lumen_radius_mm(const Vector3d& /*point_mm*/) const {
  return radius_mm_;
}

}  // namespace endowire::vessel

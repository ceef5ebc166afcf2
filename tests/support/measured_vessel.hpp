#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include "endowire/vessel/anatomy/plan.hpp"
#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/generate.hpp"
#include "endowire/vessel/repair.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire::test {

/// A generated vessel, measured: calibres on its triangles, lengths and angles on its axes.
class MeasuredVessel {
 public:
  explicit MeasuredVessel(const vessel::GeneratedVessel& made)
      : made_(made),
        repaired_(vessel::repair(made.mesh, "generated")),
        closed_(vessel::close_surface(repaired_, 20.0)),
        surface_(closed_.mesh) {}

  [[nodiscard]] const vessel::GeneratedVessel& made() const { return made_; }
  [[nodiscard]] const vessel::RepairedMesh& repaired() const { return repaired_; }

  [[nodiscard]] double parameter(const std::string& name) const {
    for (const auto& number : made_.parameters)
      if (number.name == name) return number.value;
    throw std::runtime_error("no parameter " + name);
  }
  [[nodiscard]] const vessel::Landmark& mark(const std::string& name) const {
    for (const vessel::Landmark& mark : made_.landmarks)
      if (mark.name == name) return mark;
    throw std::runtime_error("no landmark " + name);
  }
  [[nodiscard]] const vessel::anatomy::Branch& branch(const std::string& name) const {
    for (const vessel::anatomy::Branch& branch : made_.branches)
      if (branch.name == name) return branch;
    throw std::runtime_error("no branch " + name);
  }
  [[nodiscard]] const vessel::anatomy::Branch& parent_of(const vessel::anatomy::Branch& branch) const {
    return made_.branches[static_cast<std::size_t>(branch.parent)];
  }
  /// On the axis of the branch that the landmark lies on, from the axis's beginning.
  [[nodiscard]] double arc(const std::string& name) const {
    return mark(name).arc_mm + branch(mark(name).branch).ostium_arc_mm;
  }
  [[nodiscard]] double between(const std::string& from, const std::string& to) const {
    return std::abs(arc(to) - arc(from));
  }
  /// Of the largest ball around a point that fits into the triangles.
  [[nodiscard]] double inscribed_mm(const Eigen::Vector3d& point) const {
    return surface_.at(point).distance_mm;
  }
  [[nodiscard]] double diameter(const std::string& name) const {
    return 2.0 * inscribed_mm(mark(name).position_mm);
  }
  /// Of a branch behind its ostium.
  [[nodiscard]] double length(const std::string& name) const {
    return branch(name).axis.length_mm() - branch(name).ostium_arc_mm;
  }
  /// Between a branch's axis and its parent's, where it begins.
  [[nodiscard]] double take_off_deg(const std::string& name) const {
    const vessel::anatomy::Branch& b = branch(name);
    return angle_deg(b.axis.at(0.0).tangent, parent_of(b).axis.at(b.parent_arc_mm).tangent);
  }
  [[nodiscard]] static double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
  }

  /// Radius of curvature of the acute lip where a branch leaves its parent, in the plane of both axes there: at the
  /// crest of the rounded part of the wall's section with that plane.
  /// @param about_mm  what it should be: scales the steps of the measurement
  [[nodiscard]] double carina_radius_mm(const std::string& name, double about_mm) const {
    using Eigen::Vector3d;
    vessel::anatomy::Plan plan;
    plan.branches = made_.branches;
    const vessel::anatomy::LumenShape shape = shape_of(plan);
    const vessel::anatomy::Branch& b = branch(name);
    const vessel::anatomy::Axis& parent = parent_of(b).axis;
    const vessel::anatomy::AxisPoint ostium = b.axis.at(b.ostium_arc_mm);
    const Vector3d parent_tangent = parent.at(parent.nearest_arc_mm(ostium.position_mm)).tangent;
    const Vector3d along =
        ostium.tangent.dot(parent_tangent) > 0.0 ? parent_tangent : Vector3d(-parent_tangent);
    // Where both walls would meet without rounding, the way into the wedge of tissue, and across it.
    const Vector3d corner =
        ostium.position_mm + ostium.radius_mm / ostium.tangent.cross(along).norm() * along;
    const Vector3d x = (ostium.tangent + along_wall(parent, corner, along)).normalized();
    const Vector3d y = (along - along.dot(x) * x).normalized();
    const auto f = [&](double u, double v) { return shape.at(corner + u * x + v * y).distance_mm; };
    const auto rounded = [&](double u, double v) {
      return shape.at(corner + u * x + v * y).curvature_radius_mm < 2.0 * about_mm;
    };
    const double h = 0.08 * about_mm;
    double least_tilt = 1.0;
    double curvature = 0.0;
    for (double v = -1.2 * ostium.radius_mm; v < 1.2 * ostium.radius_mm; v += 0.1 * about_mm)
      for (double u = -2.0 * ostium.radius_mm; u < 6.0 * ostium.radius_mm; u += 0.2 * about_mm) {
        if (!(f(u, v) < 0.0 && f(u + 0.2 * about_mm, v) >= 0.0)) continue;  // into tissue
        double low = u;
        double high = u + 0.2 * about_mm;
        for (int i = 0; i < 40; ++i) (f(0.5 * (low + high), v) < 0.0 ? low : high) = 0.5 * (low + high);
        if (!(rounded(low - h, v - h) && rounded(low + h, v - h) && rounded(low - h, v + h) &&
              rounded(low + h, v + h)))
          continue;
        const double fx = (f(low + h, v) - f(low - h, v)) / (2 * h);
        const double fy = (f(low, v + h) - f(low, v - h)) / (2 * h);
        const double fxx = (f(low + h, v) - 2 * f(low, v) + f(low - h, v)) / (h * h);
        const double fyy = (f(low, v + h) - 2 * f(low, v) + f(low, v - h)) / (h * h);
        const double fxy =
            (f(low + h, v + h) - f(low + h, v - h) - f(low - h, v + h) + f(low - h, v - h)) / (4 * h * h);
        const double tilt = std::abs(fy) / std::hypot(fx, fy);  // zero at the crest
        if (tilt > least_tilt) continue;
        least_tilt = tilt;
        curvature =
            std::abs(fxx * fy * fy - 2 * fxy * fx * fy + fyy * fx * fx) / std::pow(fx * fx + fy * fy, 1.5);
      }
    return 1.0 / curvature;
  }

 private:
  /// How a wall runs lengthwise next to a point, in the sense of `forward`.
  [[nodiscard]] static Eigen::Vector3d along_wall(const vessel::anatomy::Axis& axis,
                                                  const Eigen::Vector3d& point,
                                                  const Eigen::Vector3d& forward) {
    const vessel::anatomy::AxisPoint at = axis.at(axis.nearest_arc_mm(point));
    const Eigen::Vector3d wall =
        (at.tangent + at.radius_slope * (point - at.position_mm).normalized()).normalized();
    return wall.dot(forward) > 0.0 ? wall : Eigen::Vector3d(-wall);
  }

  const vessel::GeneratedVessel& made_;
  vessel::RepairedMesh repaired_;
  vessel::ClosedSurface closed_;
  vessel::ExactSurface surface_;
};

}  // namespace endowire::test

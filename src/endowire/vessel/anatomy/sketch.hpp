#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

// What anatomies are drawn with: vessels that leave others, by points and directions.

/// Adds the first vessel.
std::size_t add_trunk(Plan& plan, std::string name, const CurveEnd& begin,
                      const std::vector<Eigen::Vector3d>& through_mm, const CurveEnd& end);

/// Adds a vessel that leaves the side of another: from the other's axis straight in `direction` until it is
/// `straight_mm` outside the other's wall, then through `through_mm`; curvature vanishes at both ends.
struct SideBranch {
  std::string name;
  std::size_t parent = 0;
  double parent_arc_mm = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< length one
  double straight_mm = 4.0;
  std::vector<Eigen::Vector3d> through_mm;  ///< behind that; the last is the vessel's end
  Eigen::Vector3d end_direction = Eigen::Vector3d::Zero();
};
std::size_t add_side_branch(Plan& plan, const SideBranch& side);
/// The axis that it would have.
[[nodiscard]] Axis axis_of(const Plan& plan, const SideBranch& side);
/// Arc length at which an axis leaves the lumen of another, in which it begins.
[[nodiscard]] double ostium_arc_mm(const Axis& parent, const Axis& axis);

/// The factor by which a drawn length is to be multiplied so that what is measured on the curve comes out as wanted:
/// curves are a little longer than the points that they go through are apart.
/// @param measured_mm  what comes out for a factor; close to proportional
template <class Measured>
[[nodiscard]] double factor_for(double wanted_mm, const Measured& measured_mm) {
  double factor = 1.0;
  for (int i = 0; i < 4; ++i) factor *= wanted_mm / measured_mm(factor);
  return factor;
}

/// Adds the second of two vessels that a vessel divides into: its axis is the other's until `parent_arc_mm`,
/// leaves it there with the same direction and curvature and goes through `through_mm`, to the last of them. So
/// the flanks of a bifurcation are as smooth as the axes.
struct SecondBranch {
  std::string name;
  std::size_t parent = 0;
  double parent_arc_mm = 0.0;
  std::vector<Eigen::Vector3d> through_mm;
  Eigen::Vector3d end_direction = Eigen::Vector3d::Zero();
};
std::size_t add_second_branch(Plan& plan, const SecondBranch& second);

/// Calibres along a vessel, by arc length on its axis. Afterwards its ostium is where its axis passes the
/// parent's wall.
void set_calibre(Plan& plan, std::size_t branch, const std::vector<RadiusProfile::Mark>& marks);

/// Adds a lesion to a vessel, and to those that share the stretch.
void add_lesion(Plan& plan, std::size_t branch, const Lesion& lesion);

/// Where a vessel's axis, running in `direction` from another's axis, passes the other's wall.
[[nodiscard]] Eigen::Vector3d wall_point_mm(const Plan& plan, std::size_t parent, double parent_arc_mm,
                                            const Eigen::Vector3d& direction);

/// Rounds where a vessel leaves its parent, for the angle between their axes there.
void round_ostium(Plan& plan, std::size_t branch, double carina_radius_mm);

/// Direction at `angle_rad` from a vessel's axis, to the side of it that `towards` points to.
[[nodiscard]] Eigen::Vector3d leaving(const AxisPoint& at, double angle_rad, const Eigen::Vector3d& towards);

/// Names the end of a vessel: an opening of the mesh and a landmark.
void add_end(Plan& plan, const std::string& name, std::size_t branch, bool at_begin = false);
void add_landmark(Plan& plan, const std::string& name, std::size_t branch, double arc_mm);

}  // namespace endowire::vessel::anatomy

#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

// The pelvis of every anatomy with a femoral access. The aorta ends in its bifurcation at the origin and comes
// straight down to it; x to the left, y to the back, z to the head. Reads the parameters of iliac_parameters.hpp.

enum class Side : std::uint8_t { right, left };

/// What is drawn for the left side, on either.
[[nodiscard]] Eigen::Vector3d on_side(Eigen::Vector3d left, Side side);

/// Above this height the aorta is undivided.
inline constexpr double division_mm = 18.0;

/// Points of a common and an external iliac artery below the division; the last is the end.
[[nodiscard]] std::vector<Eigen::Vector3d> iliac_course(const Values& values, Side side);
/// Direction in which it ends, towards the groin.
[[nodiscard]] Eigen::Vector3d iliac_end_direction(Side side);
/// Where the internal iliac artery leaves.
[[nodiscard]] Eigen::Vector3d iliac_division(const Values& values, Side side);

/// Marks of the aorta, continued by those of the iliac arteries of one side.
/// @param above  marks of the aorta, arc lengths on `axis`
[[nodiscard]] std::vector<RadiusProfile::Mark> with_iliac_calibre(const Values& values, const Axis& axis,
                                                                  Side side,
                                                                  std::vector<RadiusProfile::Mark> above);

/// Adds what the first branch, the aorta continued by the right iliac arteries, lacks: the left iliac arteries
/// and both internal ones, with their ends and landmarks. Returns the index of the left iliac arteries.
/// @param above        marks of the aorta, as given to `with_iliac_calibre`
/// @param left_course  of the left side: `iliac_course`, longer where the anatomy goes on below the groin
std::size_t add_pelvis(Plan& plan, const Values& values, const std::vector<RadiusProfile::Mark>& above,
                       const std::vector<Eigen::Vector3d>& left_course,
                       const Eigen::Vector3d& left_end_direction);

/// Where vessels end in the groins: names both ends and puts the access into the right one.
/// @param left  index of the left iliac arteries
void end_in_groins(Plan& plan, const Values& values, std::size_t left);

}  // namespace endowire::vessel::anatomy

#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "endowire/sim/scene.hpp"
#include "endowire/sim/state.hpp"
#include "endowire/vessel/analytic_field.hpp"

namespace endowire::test {

using FieldPointer = std::shared_ptr<const vessel::Field>;

/// A straight tube along z.
inline FieldPointer straight_tube(double radius_mm = 3.0) {
  return std::make_shared<vessel::TubeField>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), radius_mm);
}

/// A tube that runs along z for 20 mm, bends by 90° towards x on 25 mm, and goes on.
inline FieldPointer bent_tube(double radius_mm = 3.0) {
  return std::make_shared<vessel::BentTubeField>(Eigen::Vector3d(0.0, 0.0, 20.0), Eigen::Vector3d::UnitZ(),
                                                 Eigen::Vector3d::UnitX(), 25.0, 0.5 * std::numbers::pi,
                                                 radius_mm);
}

/// The sheath of these tubes: at the origin, along z.
inline sim::Access origin_access() {
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
}

/// The largest distance between joints of two states of equal length.
inline double shape_difference_mm(const sim::State& a, const sim::State& b) {
  if (a.joints_mm.size() != b.joints_mm.size()) return HUGE_VAL;
  double worst = 0.0;
  for (std::size_t i = 0; i < a.joints_mm.size(); ++i)
    worst = std::max(worst, (a.joints_mm[i] - b.joints_mm[i]).norm());
  return worst;
}

}  // namespace endowire::test

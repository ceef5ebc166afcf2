#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace endowire::sim {

enum class EventKind : std::uint8_t {
  snap,           ///< the wire left one equilibrium for another; value: longest way of a joint [mm]
  perforation,    ///< the tip presses with the threshold of the scene or more; value: force [N]
  kink,           ///< bent beyond its kink curvature; value: curvature [1/mm]
  exit,           ///< end of the vessel: the tip left through an opening; value: its number
  too_narrow,     ///< the lumen is narrower than the wire; value: lumen radius less wire radius [mm], < 0
  hand_slip,      ///< the wire slips in the hand; value: by how much in this step [mm]
  not_converged,  ///< the step was not solved; value: force residual [N]
  stall,          ///< the hand pushes, the tip stays; value: push force [N]
  new_branch,     ///< the tip entered another vessel; value: radius of its lumen there [mm]
  self_overlap,   ///< two parts of the wire lie in each other, which is not modelled; value: gap [mm], < 0
};
inline constexpr std::size_t event_kinds = 10;

struct Event {
  EventKind kind = EventKind::snap;
  double value = 0.0;  ///< as the kind says
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  std::int32_t branch = -1;  ///< of the centreline tree: the stretch of the vessel entered; -1: of none

  bool operator==(const Event&) const = default;
};

}  // namespace endowire::sim

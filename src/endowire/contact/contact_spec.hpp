#pragma once

#include "endowire/contact/wall.hpp"

namespace endowire::contact {

/// Parameters of contact.
struct ContactSpec {
  WallSpec wall;
  double stick_stiffness_ratio = 1.0;  ///< tangential over normal wall stiffness, Mindlin: 2/3 … 1
  double reach_mm = 1.0;  ///< walls nearer than this to the surface of the wire are made constraints
  double gap_error_mm =
      0.02;  ///< largest error of a gap against the field that a final state may have; within
             ///< 0.1 mm of the place of detection the field's own error, if that is larger
  double max_share_mm = 2.0;  ///< samples are at most half a lumen radius, and this, apart
};

}  // namespace endowire::contact

#pragma once

#include <algorithm>
#include <cmath>

#include "device.hpp"
#include "endowire/sim/simulation.hpp"

namespace endowire::haptic {

/// Between hand and wire: positions become commands, forces on the wire become forces on the hand.
///
/// The hand is read as a position, not as increments, so nothing is lost when ticks are missed: what the wire has not yet
/// followed is caught up over the next ticks, at most `catch_up` of it in one, because a long step takes longer and would
/// miss again. A force may follow at once as long as the wire stays near its equilibrium. After a snap, a step that did not
/// converge or a missed tick it would jump; it is then led to its new value at a bounded rate, and flagged until it is there.
class Coupling {
 public:
  static constexpr double catch_up_mm = 0.1;      ///< a tick; five times an ordinary one
  static constexpr double catch_up_rad = 0.0175;  ///< a tick; one degree
  static constexpr double slew_n = 0.02;          ///< a tick: 20 N/s, 0.1 s for the whole grip of a wire
  static constexpr double slew_n_mm = 0.02;       ///< a tick

  /// The next command: towards where the hand is.
  [[nodiscard]] sim::Command command(const HandPosition& hand) const {
    return {std::clamp(hand.advance_mm - followed_.advance_mm, -catch_up_mm, catch_up_mm),
            std::clamp(hand.turn_rad - followed_.turn_rad, -catch_up_rad, catch_up_rad)};
  }

  /// What the hand feels after that command.
  /// @param missed  ticks that passed with no new force before this one
  [[nodiscard]] HandForce force(const sim::Command& command, const sim::StepReport& report, bool missed) {
    if (!report.converged) {  // the wire stays where it was, and is asked again in the next tick
      felt_.flagged = led_ = true;
      return felt_;
    }
    followed_.advance_mm += command.advance_mm;
    followed_.turn_rad += command.torque_rad;
    led_ = led_ || report.snapped || missed;
    // The wire pushes back: what the hand does to the wire, the device does to the hand the other way.
    const double force_n = -report.push_force_n;
    const double torque_n_mm = -report.torque_n_mm;
    if (led_) {
      felt_.force_n += std::clamp(force_n - felt_.force_n, -slew_n, slew_n);
      felt_.torque_n_mm += std::clamp(torque_n_mm - felt_.torque_n_mm, -slew_n_mm, slew_n_mm);
      led_ = felt_.force_n != force_n || felt_.torque_n_mm != torque_n_mm;
    } else {
      felt_.force_n = force_n;
      felt_.torque_n_mm = torque_n_mm;
    }
    felt_.flagged = led_;
    return felt_;
  }

 private:
  HandPosition followed_;  ///< by the wire
  HandForce felt_;
  bool led_ = false;  ///< the force is on its way to that of the wire
};

}  // namespace endowire::haptic

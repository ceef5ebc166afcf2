#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "endowire/sim/scene.hpp"

namespace endowire::haptic {

/// Where the hand holds the wire: what the encoders of a device read, counted from the start.
struct HandPosition {
  double advance_mm = 0.0;
  double turn_rad = 0.0;
};

/// What a device does to the hand: against its advance and against its turn.
struct HandForce {
  double force_n = 0.0;
  double torque_n_mm = 0.0;
  /// Not the force of this very state of the wire: held over a missed tick, or on its way to a new one after a snap.
  bool flagged = false;
};

/// A hand and its device in one, for want of hardware: plays the motions of a scene at even speeds, then rocks to and fro.
/// Replace it by the driver of a device: `position` reads encoders, `output` writes to motors.
class SimulatedDevice {
 public:
  SimulatedDevice(const std::vector<sim::Motion>& motions, double speed_mm_per_s, double turn_rad_per_s) {
    for (const sim::Motion& motion : motions) {
      HandPosition move;
      for (const sim::HandMotion& hand : motion.hands) {
        move.advance_mm += hand.advance_mm;
        move.turn_rad += hand.torque_deg * std::numbers::pi / 180.0;
      }
      add(move, speed_mm_per_s, turn_rad_per_s);
    }
    rock_from_ = moves_.size();
    for (const double advance_mm : {-20.0, 20.0}) add({advance_mm, 0.0}, speed_mm_per_s, turn_rad_per_s);
  }

  /// The hand moves on by one tick.
  [[nodiscard]] HandPosition position(double tick_s) {
    double left_s = tick_s;
    while (left_s > 0.0) {
      const Move& move = moves_[at_];
      const double part_s = std::min(left_s, move.duration_s - in_move_s_);
      position_.advance_mm += move.total.advance_mm * part_s / move.duration_s;
      position_.turn_rad += move.total.turn_rad * part_s / move.duration_s;
      in_move_s_ += part_s;
      left_s -= part_s;
      if (in_move_s_ < move.duration_s) break;
      in_move_s_ = 0.0;
      at_ = at_ + 1 < moves_.size() ? at_ + 1 : rock_from_;
    }
    return position_;
  }
  void output(const HandForce& force) { last_ = force; }
  [[nodiscard]] const HandForce& felt() const { return last_; }

 private:
  struct Move {
    HandPosition total;
    double duration_s;
  };
  void add(const HandPosition& total, double speed_mm_per_s, double turn_rad_per_s) {
    moves_.push_back({total, std::max({1e-3, std::abs(total.advance_mm) / speed_mm_per_s,
                                       std::abs(total.turn_rad) / turn_rad_per_s})});
  }

  std::vector<Move> moves_;
  std::size_t rock_from_ = 0;
  std::size_t at_ = 0;
  double in_move_s_ = 0.0;
  HandPosition position_;
  HandForce last_;
};

}  // namespace endowire::haptic

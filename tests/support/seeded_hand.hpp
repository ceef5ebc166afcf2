#pragma once

#include <algorithm>
#include <numbers>

#include "endowire/sim/scene.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::test {

/// A hand that does anything: phases of 20 to 60 steps, each with an advance of −1 to 1.5 mm and a torque of −10 to 10°
/// a step, so that the wire gets somewhere before the hand changes its mind. It pulls when `most_mm` are inserted and
/// pushes when the wire is `least_mm` short of the sheath's end.
class SeededHand {
 public:
  SeededHand(std::uint64_t seed, double most_mm, double least_mm = -5.0)
      : random_(seed), most_mm_(most_mm), least_mm_(least_mm) {}

  sim::Command next(double inserted_mm) {
    const bool turn_back = (inserted_mm >= most_mm_ && command_.advance_mm > 0.0) ||
                           (inserted_mm <= least_mm_ && command_.advance_mm < 0.0);
    if (left_ == 0 || turn_back) {
      left_ = 20 + static_cast<int>(random_.next() % 41);
      command_.advance_mm = random_.uniform(-1.0, 1.5);
      command_.torque_rad = random_.uniform(-10.0, 10.0) * std::numbers::pi / 180.0;
      if (inserted_mm >= most_mm_) command_.advance_mm = -random_.uniform(0.0, 1.0);
      if (inserted_mm <= least_mm_) command_.advance_mm = random_.uniform(0.0, 1.5);
    }
    --left_;
    return command_;
  }

 private:
  vessel::SplitMix random_;
  double most_mm_;
  double least_mm_;
  sim::Command command_;
  int left_ = 0;
};

}  // namespace endowire::test

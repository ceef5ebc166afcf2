#pragma once

#include <memory>

#include "support/chains.hpp"

namespace endowire::test {

/// Two instruments on one centreline, as a problem of statics; the last rod of both is clamped.
class CoaxialChain {
 public:
  /// @param behind_mm  how far the tip of the second is behind that of the first; moved to the middle of the nearest rod, unless 0
  CoaxialChain(const rod::Instrument& first, const rod::Instrument& second, int rods, double rod_length_mm,
               double behind_mm = 0.0, double turned_rad = 0.0);

  [[nodiscard]] sim::ChainProblem& problem();
  [[nodiscard]] double behind_mm() const { return behind_mm_; }
  /// The hand turns the second instrument by an angle.
  void turn(double angle_rad);
  /// Angle between the frames of both on a rod, unwrapped.
  [[nodiscard]] double angle_rad(int rod) const;
  [[nodiscard]] double hand_torque_n_mm(int instrument) const;
  /// 0, or no number when it did not converge.
  double settle();

 private:
  std::unique_ptr<Chain> chain_;
  std::unique_ptr<rod::MaterialLine> second_;
  double behind_mm_ = 0.0;
};

}  // namespace endowire::test

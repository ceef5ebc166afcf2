#pragma once

#include <Eigen/Core>
#include <vector>

namespace endowire::test {

/// V9 without friction: the helix as it came to rest.
struct Helix {
  double clearance_mm = 0.0;
  double pitch_mm = 0.0;       ///< in its middle
  double wall_n_per_mm = 0.0;  ///< wall force per length there
  std::vector<Eigen::Vector3d> joints_mm;
};
[[nodiscard]] Helix helix_without_friction();

/// V9 with friction: compression along a helix that slides.
struct Lock {
  double lock_mm = 0.0;  ///< length of lock-up from the tip
  std::vector<double> from_tip_mm;
  std::vector<double> compression_n;

  [[nodiscard]] double compression_at_n(double from_mm) const;
};
[[nodiscard]] Lock helix_with_friction();

}  // namespace endowire::test

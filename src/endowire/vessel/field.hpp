#pragma once

#include <Eigen/Core>

namespace endowire::vessel {

/// The wall distance at a point, value and gradient of one and the same interpolant.
struct WallDistance {
  double distance_mm = 0.0;                            ///< positive inside the lumen, negative in the wall
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< points away from the wall, into the lumen [-]
};

/// What the simulation knows of a vessel: a signed distance to its wall, everywhere.
///
/// Openings of the vessel are extruded as virtual tubes, so that the distance stays defined where a wire
/// leaves; `exit_at` tells that it did. Implementations are immutable and safe to share between threads.
class Field {
 public:
  virtual ~Field() = default;

  /// Signed distance to the wall and its gradient at `point_mm`. Defined for every finite point: beyond the
  /// band around the wall in which it is exact to `error_mm()` it keeps its sign and never jumps inside the
  /// band.
  [[nodiscard]] virtual WallDistance at(const Eigen::Vector3d& point_mm) const = 0;

  /// Radius of the lumen around `point_mm`, > 0: sets sample spacing and wall thickness, never the contact.
  [[nodiscard]] virtual double lumen_radius_mm(const Eigen::Vector3d& point_mm) const = 0;

  /// Thickness of tissue between the wall near `point_mm` and another lumen of the same vessel behind it;
  /// infinity if none.
  [[nodiscard]] virtual double tissue_to_next_lumen_mm(const Eigen::Vector3d& point_mm) const = 0;

  /// 0 inside the vessel, k ≥ 1 inside the virtual tube behind opening k (counted from 1).
  [[nodiscard]] virtual int exit_at(const Eigen::Vector3d& point_mm) const = 0;

  /// Largest error of `at` against the true surface that preparation measured near the wall.
  [[nodiscard]] virtual double error_mm() const = 0;
};

}  // namespace endowire::vessel

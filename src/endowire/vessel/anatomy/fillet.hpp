#pragma once

#include <Eigen/Core>

namespace endowire::vessel::anatomy {

/// A lumen near a point: how far its wall is and where it faces.
struct WallSample {
  double distance_mm = 0.0;                            ///< negative inside the lumen
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< length one, out of the lumen
  double curvature_radius_mm = 0.0;                    ///< the smallest of the wall there
};

/// How the walls of two vessels that meet are joined: by the surface of a ball rolled along their crease.
///
///   F = ρ − |q|,  q = λ n₁ + μ n₂,  λ = (a − c b)/(1 − c²),  μ = (b − c a)/(1 − c²)
///       where λ > 0 and μ > 0; min(f₁, f₂) elsewhere
///   a = ρ − f₁,  b = ρ − f₂,  c = n₁ · n₂
///   ρ = ρ₀ (1 + 3 w²) / (1 + 3 w₀²),  w = (1 + c)/2,  w₀ = (1 − cos α)/2
///
/// Symbols  f, n   distances to the two walls and their gradients
///          ρ₀, α  radius of the ball at the carina, where the walls meet at the angle α
/// Where the walls meet at a wider angle, beside and opposite to the carina, the ball is larger, as ostia are.
/// Away from the crease both vessels keep their calibre; a blend by smooth minimum would widen them, most of all
/// where they part at a small angle.
///
/// Departure  the walls are taken as planes within the ball's reach; where they are not, its radius misses ρ by
///            about ρ / r.
/// Accuracy   distance and gradient exact to first order near F = 0.
class Fillet {
 public:
  Fillet() = default;  ///< none: the lesser distance
  /// @param angle_cosine  cos α
  Fillet(double carina_radius_mm, double angle_cosine);

  /// Both lumens together.
  [[nodiscard]] WallSample join(const WallSample& one, const WallSample& other) const;
  /// Nothing further from a wall than this is rounded.
  [[nodiscard]] double reach_mm() const { return 4.0 * base_mm_; }
  [[nodiscard]] double carina_radius_mm() const { return carina_mm_; }
  /// Tissue between parallel walls thinner than this is bridged.
  [[nodiscard]] double bridged_mm() const { return 2.0 * base_mm_; }

 private:
  double carina_mm_ = 0.0;
  double base_mm_ = 0.0;  ///< ρ for w = 0; four times that for w = 1
};

}  // namespace endowire::vessel::anatomy

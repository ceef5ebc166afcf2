#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "endowire/contact/sample.hpp"

namespace endowire::contact {

/// Friction along the wire as remembered between steps, by material arc: forces per length, so that they stay what they are
/// where samples lie closer, or on a wall of another stiffness, in the next step.
struct FrictionMemory {
  std::vector<double> arc_mm;
  std::vector<Eigen::Vector2d> traction_n_per_mm;
  std::vector<double> normal_n_per_mm;

  void clear();
  void reserve(std::size_t samples);
  /// Copies without giving memory up.
  void assign(const FrictionMemory& other);
  /// Gives a sample its traction, which belongs to the material, and its lagged normal force, which belongs to the wall and is that of the
  /// material that lay there; linear between what is remembered.
  /// @param advanced_mm  by which the wire has come forward since: near the tip, whose contact goes with it, that does not count
  void recall(double advanced_mm, Sample& sample) const;

  bool operator==(const FrictionMemory&) const = default;
};

}  // namespace endowire::contact

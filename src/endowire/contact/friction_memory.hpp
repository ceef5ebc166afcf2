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
  /// Gives a sample its traction and lagged normal force, linear between what is remembered.
  /// @param hint  where the last look-up ended, for increasing arcs
  void recall(std::size_t& hint, Sample& sample) const;

  bool operator==(const FrictionMemory&) const = default;
};

}  // namespace endowire::contact

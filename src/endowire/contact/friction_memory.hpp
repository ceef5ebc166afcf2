#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "endowire/contact/sample.hpp"

namespace endowire::contact {

/// Friction along the wire as remembered between steps, by material arc.
struct FrictionMemory {
  std::vector<double> arc_mm;
  std::vector<Eigen::Vector2d> anchor_mm;
  std::vector<double> normal_n_per_mm;

  void clear();
  void reserve(std::size_t samples);
  /// Copies without giving memory up.
  void assign(const FrictionMemory& other);
  /// Gives a sample its anchor and lagged normal force, linear between what is remembered.
  /// @param hint  where the last look-up ended, for increasing arcs
  void recall(std::size_t& hint, Sample& sample) const;

  bool operator==(const FrictionMemory&) const = default;
};

}  // namespace endowire::contact

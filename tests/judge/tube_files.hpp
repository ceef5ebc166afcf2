#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace endowire::tests {

using Triangles = std::vector<std::array<Eigen::Vector3d, 3>>;

/// A tube along x of regular cross-section, normals outwards.
struct TubeMesh {
  double radius_mm = 3.0;  ///< of the corners; the flats are closer by radius (1 − cos π/sides)
  double length_mm = 60.0;
  int sides = 32;
  int rings = 30;
  Eigen::Vector3d start_mm = Eigen::Vector3d::Zero();
  bool cap_start = true;
  bool cap_end = true;

  [[nodiscard]] double flat_radius_mm() const;
  [[nodiscard]] Triangles triangles() const;
};

/// One recorded step: the axis from the tip to the sheath.
struct RecordedAxis {
  std::vector<Eigen::Vector3d> points_mm;
  double radius_mm = 0.4;
  double inserted_mm = 1e9;  ///< > length: everything is in the vessel
};

/// A straight wire of `rods` equal rods, tip first.
[[nodiscard]] RecordedAxis straight_wire(const Eigen::Vector3d& tip_mm, const Eigen::Vector3d& sheath_mm,
                                         int rods);

void write_stl(const std::filesystem::path& path, const Triangles& triangles);
/// Writes wire.pvd and one .vtp for each step; returns the path of wire.pvd.
std::filesystem::path write_recording(const std::filesystem::path& folder,
                                      const std::vector<RecordedAxis>& steps);

}  // namespace endowire::tests

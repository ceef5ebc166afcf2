#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace crossings {

/// The axis of a wire at one recorded step, from the tip to the sheath.
struct Axis {
  std::vector<Eigen::Vector3d> points_mm;
  std::vector<double> arc_mm;     ///< material arc length from the tip, increasing
  std::vector<double> radius_mm;  ///< outer radius at each point
  double inserted_mm = 0.0;       ///< what lies beyond this arc is in the sheath

  [[nodiscard]] Eigen::Vector3d at(double arc_mm) const;
  [[nodiscard]] double radius_at(double arc_mm) const;

 private:
  /// Rod that holds `arc_mm`, and the fraction along it.
  [[nodiscard]] std::pair<std::size_t, double> locate(double arc_mm) const;
};

/// One line of a .pvd file.
struct RecordedFile {
  double time = 0.0;
  int part = 0;  ///< wires of one recording that move side by side
  std::string path;
};

/// @throws InputError when the file is not a .pvd collection or names no files.
[[nodiscard]] std::vector<RecordedFile> read_collection(const std::string& path);

/// @param radius_mm  used instead of the file's `radius_mm`
/// @param sheath_mm  used instead of the file's `inserted_length_mm`: the wire lies in the sheath beyond the
/// point
///                   nearest to it
/// @throws InputError naming what is missing or wrong.
[[nodiscard]] Axis read_axis(const std::string& path, std::optional<double> radius_mm,
                             const std::optional<Eigen::Vector3d>& sheath_mm);

}  // namespace crossings

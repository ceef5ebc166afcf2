#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// What a user decides of an image volume; what is left out is decided here and said.
struct VolumeOptions {
  std::optional<double> threshold;       ///< the lumen is what lies above it
  std::optional<double> threshold_high;  ///< and not above this
  std::optional<std::int64_t> label;     ///< of a label map: the lumen's
  std::optional<int> smooth;             ///< passes of smoothing of the surface; 0: none
  bool keep_all = false;                 ///< all pieces of lumen, not the largest alone
};

/// More passes change nothing that is not lost already.
inline constexpr int max_smoothing_passes = 200;

/// What was decided.
struct VolumeReport {
  std::array<std::int64_t, 3> size{};
  Eigen::Vector3d spacing_mm = Eigen::Vector3d::Zero();
  std::string frame;
  bool label_map = false;
  std::optional<std::int64_t> label;
  std::optional<double> threshold;
  std::optional<double> threshold_high;
  bool threshold_found = false;  ///< here, not by the user
  double threshold_sharpness_per_mm = 0.0;
  std::size_t pieces = 0;  ///< of lumen in the image
  std::size_t pieces_kept = 0;
  std::size_t voxels_kept = 0;
  std::size_t largest_dropped = 0;  ///< voxels of it
  std::size_t cavity_voxels = 0;    ///< holes in the lumen, filled
  int smoothing_passes = 0;
  std::size_t surface_triangles = 0;
  std::size_t surface_triangles_before = 0;  ///< more, when the surface was made smaller
};

/// A scalar on a grid, positive in the lumen, with a layer outside all around: what a surface is taken of.
struct LumenImage {
  std::array<std::int64_t, 3> size{};
  std::vector<float> inside;
  std::array<std::int64_t, 3> first{};  ///< voxel of the volume that value (0, 0, 0) lies at; −1 in the layer
  VolumeReport report;
};

/// The lumen of an image: by label, or by threshold, given or found; its pieces told apart, holes in it filled.
///
/// Beyond the border of the image, and where other pieces are left out, the values are mirrored at zero: the surface lies
/// half a voxel outside the last voxel of lumen.
/// @throws base::InputError when the threshold is ambiguous or the labels are several (the message suggests values), and
///                          when no lumen is left
[[nodiscard]] LumenImage lumen_of(Volume volume, const VolumeOptions& options, const std::string& file_label);

}  // namespace endowire::io

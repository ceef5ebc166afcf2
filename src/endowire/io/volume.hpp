#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace endowire::io {

/// An image volume: values on a grid that lies anywhere in the patient.
///
/// Places are in the frame of DICOM, LPS: x to the patient's left, y to the back, z to the head, in millimetres.
struct Volume {
  std::array<std::int64_t, 3> size{};                     ///< voxels along i, j, k
  std::vector<float> values;                              ///< i runs fastest
  Eigen::Matrix3d step_mm = Eigen::Matrix3d::Identity();  ///< columns: from a voxel to the next along i, j, k
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();    ///< centre of voxel (0, 0, 0)
  bool whole_numbers = false;                             ///< all values are, however they are stored
  double unit_mm = 1.0;                                   ///< of the lengths in the file
  std::string frame;                                      ///< what the file says of its axes, for people

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  [[nodiscard]] Eigen::Vector3d spacing_mm() const { return step_mm.colwise().norm().transpose(); }
};

/// 512 × 512 × 1024: larger than any angiography of one patient, 1 GB as it is held here.
inline constexpr std::int64_t max_voxels = std::int64_t{1} << 28;

/// How numbers are stored in a file.
enum class VoxelType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

struct VoxelFormat {
  VoxelType type = VoxelType::int16;
  bool big_endian = false;
  double slope = 1.0;  ///< value = slope · stored + intercept
  double intercept = 0.0;
};

[[nodiscard]] std::size_t bytes_of(VoxelType type);

/// Turns the lengths of a header, as they stand there, into millimetres.
/// @param header_mm  a unit of length as the header says it; none: it does not, millimetres are taken
/// @param given_mm   as the user says it, which goes before
void apply_unit(Volume& volume, std::optional<double> header_mm, std::optional<double> given_mm);

/// Millimetres in a unit of length that a header names: um, micron, mm, millimeter, cm, m and the like; none: no such name.
[[nodiscard]] std::optional<double> millimetres_in(std::string_view name);

/// Holds size and axes against what is possible, before anything is allocated after them.
/// @throws base::InputError for a size below 2 or beyond max_voxels, or axes that span no volume
void check_grid(const Volume& volume, const std::string& file_label);

/// Decodes the voxels of a volume whose size is known and sound.
/// @param bytes  at least as many as the grid needs
/// @throws base::InputError when there are fewer, or a value is not finite
void decode_voxels(Volume& volume, std::string_view bytes, const VoxelFormat& format,
                   const std::string& file_label);

}  // namespace endowire::io

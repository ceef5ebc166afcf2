#include "endowire/io/volume.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include <cmath>
#include <string_view>

#include "endowire/base/bits.hpp"
#include "endowire/base/error.hpp"

namespace endowire::io {

using base::InputError;

namespace {

constexpr double min_spacing_mm = 0.005;  // micro-CT of a specimen
constexpr double max_spacing_mm = 50.0;

template <class Stored, class Bits>
float value_at(const char* place, const VoxelFormat& format) {
  Bits bits = 0;
  for (std::size_t k = 0; k < sizeof(Bits); ++k) {
    const std::size_t from = format.big_endian ? k : sizeof(Bits) - 1 - k;
    bits = static_cast<Bits>(static_cast<Bits>(bits << (sizeof(Bits) > 1 ? 8U : 0U)) |
                             static_cast<unsigned char>(place[from]));
  }
  return static_cast<float>(format.slope * static_cast<double>(base::bits_as<Stored>(bits)) +
                            format.intercept);
}

template <class Stored, class Bits>
void decode_as(std::vector<float>& values, std::string_view bytes, const VoxelFormat& format) {
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = value_at<Stored, Bits>(bytes.data() + i * sizeof(Bits), format);
}

void decode_all(std::vector<float>& values, std::string_view bytes, const VoxelFormat& format) {
  switch (format.type) {
    case VoxelType::int8:
      return decode_as<std::int8_t, std::uint8_t>(values, bytes, format);
    case VoxelType::uint8:
      return decode_as<std::uint8_t, std::uint8_t>(values, bytes, format);
    case VoxelType::int16:
      return decode_as<std::int16_t, std::uint16_t>(values, bytes, format);
    case VoxelType::uint16:
      return decode_as<std::uint16_t, std::uint16_t>(values, bytes, format);
    case VoxelType::int32:
      return decode_as<std::int32_t, std::uint32_t>(values, bytes, format);
    case VoxelType::uint32:
      return decode_as<std::uint32_t, std::uint32_t>(values, bytes, format);
    case VoxelType::int64:
      return decode_as<std::int64_t, std::uint64_t>(values, bytes, format);
    case VoxelType::uint64:
      return decode_as<std::uint64_t, std::uint64_t>(values, bytes, format);
    case VoxelType::float32:
      return decode_as<float, std::uint32_t>(values, bytes, format);
    case VoxelType::float64:
      return decode_as<double, std::uint64_t>(values, bytes, format);
  }
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::int8:
    case VoxelType::uint8:
      return 1;
    case VoxelType::int16:
    case VoxelType::uint16:
      return 2;
    case VoxelType::int32:
    case VoxelType::uint32:
    case VoxelType::float32:
      return 4;
    case VoxelType::int64:
    case VoxelType::uint64:
    case VoxelType::float64:
      break;
  }
  return 8;
}

void apply_unit(Volume& volume, std::optional<double> header_mm, std::optional<double> given_mm) {
  volume.unit_mm = given_mm ? *given_mm : header_mm.value_or(1.0);
  volume.step_mm *= volume.unit_mm;
  volume.origin_mm *= volume.unit_mm;
}

std::optional<double> millimetres_in(std::string_view name) {
  struct Unit {
    std::string_view names;  // between bars
    double mm;
  };
  constexpr Unit units[] = {{"|um|µm|μm|micron|microns|micrometer|micrometers|micrometre|micrometres|", 1e-3},
                            {"|mm|millimeter|millimeters|millimetre|millimetres|", 1.0},
                            {"|cm|centimeter|centimeters|centimetre|centimetres|", 10.0},
                            {"|m|meter|meters|metre|metres|", 1000.0}};
  std::string wanted = "|";
  for (const char c : name) wanted += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  wanted += '|';
  if (name.empty() || name.find('|') != std::string_view::npos) return {};
  for (const Unit& unit : units)
    if (unit.names.find(wanted) != std::string_view::npos) return unit.mm;
  return {};
}

void check_grid(const Volume& volume, const std::string& file_label) {
  std::int64_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t n = volume.size[k];
    if (n < 2 || n > max_voxels || count > max_voxels / n)
      throw InputError(fmt::format("{}: size is {} x {} x {} voxels; must be >= 2 each and <= {} in all",
                                   file_label, volume.size[0], volume.size[1], volume.size[2], max_voxels));
    count *= n;
  }
  if (!volume.step_mm.allFinite() || !volume.origin_mm.allFinite() ||
      volume.origin_mm.cwiseAbs().maxCoeff() > 1e5)
    throw InputError(file_label + ": its place in space is not finite or beyond 100 m; must be millimetres");
  const Eigen::Vector3d spacing = volume.spacing_mm();
  if (spacing.minCoeff() < min_spacing_mm || spacing.maxCoeff() > max_spacing_mm)
    throw InputError(fmt::format("{}: spacing is {:.4g} x {:.4g} x {:.4g} mm; must be {} … {} mm", file_label,
                                 spacing.x(), spacing.y(), spacing.z(), min_spacing_mm, max_spacing_mm));
  if (std::abs(volume.step_mm.determinant()) < 0.1 * spacing.prod())
    throw InputError(file_label + ": its axes lie in one plane; must span a volume");
}

void decode_voxels(Volume& volume, std::string_view bytes, const VoxelFormat& format,
                   const std::string& file_label) {
  const std::size_t needed = volume.count() * bytes_of(format.type);
  if (bytes.size() < needed)
    throw InputError(fmt::format("{}: holds {} bytes of voxels; must be {} for {} x {} x {}", file_label,
                                 bytes.size(), needed, volume.size[0], volume.size[1], volume.size[2]));
  volume.values.resize(volume.count());
  decode_all(volume.values, bytes, format);
  volume.whole_numbers = true;
  for (std::size_t i = 0; i < volume.values.size(); ++i) {
    // Segmentations are stored as real numbers too; what matters is what they say.
    if (volume.values[i] != std::floor(volume.values[i])) volume.whole_numbers = false;
    if (std::isfinite(volume.values[i])) continue;
    const auto n = static_cast<std::size_t>(volume.size[0]);
    const auto m = static_cast<std::size_t>(volume.size[1]);
    throw InputError(fmt::format("{}: voxel ({}, {}, {}) is {}; must be a finite number", file_label, i % n,
                                 i / n % m, i / (n * m), volume.values[i]));
  }
}

}  // namespace endowire::io

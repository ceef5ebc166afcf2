#include "endowire/io/nifti.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "endowire/base/bits.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/inflate.hpp"

namespace endowire::io {

using base::InputError;

namespace {

constexpr std::size_t header_1_bytes = 348;
constexpr std::size_t header_2_bytes = 540;

/// Numbers of a header, in the file's byte order.
class Header {
 public:
  Header(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  [[nodiscard]] std::int64_t integer(std::size_t at, std::size_t size) const {
    const std::uint64_t value = bits(at, size);
    const unsigned unused = 64 - 8 * static_cast<unsigned>(size);
    return static_cast<std::int64_t>(value << unused) >> unused;
  }
  [[nodiscard]] double real(std::size_t at, std::size_t size) const {
    return size == 4 ? static_cast<double>(base::bits_as<float>(static_cast<std::uint32_t>(bits(at, 4))))
                     : base::bits_as<double>(bits(at, 8));
  }

 private:
  [[nodiscard]] std::uint64_t bits(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k)
      value = value << 8U | static_cast<unsigned char>(bytes_[at + (big_endian_ ? k : size - 1 - k)]);
    return value;
  }
  std::string_view bytes_;
  bool big_endian_;
};

/// Where the two versions keep the same things.
struct Layout {
  std::size_t datatype, dim, dim_bytes, pixdim, real_bytes, offset, slope, units, units_bytes, qform, sform,
      code_bytes, quaternion, rows;
};
constexpr Layout layout_1{70, 40, 2, 76, 4, 108, 112, 123, 1, 252, 254, 2, 256, 280};
constexpr Layout layout_2{12, 16, 8, 104, 8, 168, 176, 500, 4, 344, 348, 4, 352, 400};

struct Type {
  std::int64_t code;
  VoxelType type;
};
constexpr Type types[] = {{2, VoxelType::uint8},    {4, VoxelType::int16},    {8, VoxelType::int32},
                          {16, VoxelType::float32}, {64, VoxelType::float64}, {256, VoxelType::int8},
                          {512, VoxelType::uint16}, {768, VoxelType::uint32}, {1024, VoxelType::int64},
                          {1280, VoxelType::uint64}};

VoxelType type_of(std::int64_t code, const std::string& file) {
  for (const Type& type : types)
    if (type.code == code) return type.type;
  throw InputError(
      fmt::format("{}: datatype is {}; must be one number a voxel (2, 4, 8, 16, 64, 256, 512, 768, "
                  "1024 or 1280)",
                  file, code));
}

std::optional<double> millimetres(std::int64_t units) {
  switch (units & 7) {
    case 1:
      return 1000.0;
    case 2:
      return 1.0;
    case 3:
      return 0.001;
    default:
      return {};
  }
}

/// The grid in RAS, in the file's unit.
void read_axes(const Header& header, const Layout& at, Volume& volume) {
  const std::size_t real = at.real_bytes;
  const auto pixdim = [&](std::size_t k) { return header.real(at.pixdim + k * real, real); };
  if (header.integer(at.sform, at.code_bytes) > 0) {
    for (Eigen::Index row = 0; row < 3; ++row) {
      const std::size_t first = at.rows + static_cast<std::size_t>(row) * 4 * real;
      for (Eigen::Index column = 0; column < 3; ++column)
        volume.step_mm(row, column) = header.real(first + static_cast<std::size_t>(column) * real, real);
      volume.origin_mm[row] = header.real(first + 3 * real, real);
    }
    volume.frame = "sform";
    return;
  }
  const Eigen::Vector3d spacing(pixdim(1), pixdim(2), pixdim(3));
  volume.step_mm = spacing.asDiagonal();
  volume.frame = "spacing alone: the file does not say where it lies";
  if (header.integer(at.qform, at.code_bytes) <= 0) return;
  const double b = header.real(at.quaternion, real);
  const double c = header.real(at.quaternion + real, real);
  const double d = header.real(at.quaternion + 2 * real, real);
  const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
  volume.step_mm = Eigen::Quaterniond(a, b, c, d).normalized().toRotationMatrix() * spacing.asDiagonal();
  if (pixdim(0) < 0.0) volume.step_mm.col(2) = -volume.step_mm.col(2);
  for (std::size_t k = 0; k < 3; ++k)
    volume.origin_mm[static_cast<Eigen::Index>(k)] = header.real(at.quaternion + (3 + k) * real, real);
  volume.frame = "qform";
}

}  // namespace

Volume parse_nifti(std::string_view file, const std::string& file_label, std::optional<double> unit_mm) {
  const bool packed = is_gzip(file);
  std::string head =
      packed ? inflate(file, header_1_bytes, file_label) : std::string(file.substr(0, header_2_bytes));
  if (head.size() < header_1_bytes)
    throw InputError(
        fmt::format("{}: is {} bytes long; a NIfTI header has {}", file_label, head.size(), header_1_bytes));
  bool big_endian = false;
  std::int64_t header_bytes = Header(head, false).integer(0, 4);
  if (header_bytes != header_1_bytes && header_bytes != header_2_bytes) {
    big_endian = true;
    header_bytes = Header(head, true).integer(0, 4);
  }
  const bool two = header_bytes == header_2_bytes;
  if (packed && two) head = inflate(file, header_2_bytes, file_label);
  const std::size_t magic_at = two ? 4 : 344;
  if ((!two && header_bytes != header_1_bytes) || head.size() < static_cast<std::size_t>(header_bytes) ||
      (head.compare(magic_at, 4, std::string_view("n+1\0", 4)) != 0 &&
       head.compare(magic_at, 4, std::string_view("n+2\0", 4)) != 0))
    throw InputError(file_label + ": has no header of NIfTI in one file (n+1, n+2); must be .nii or .nii.gz");
  const Header header(head, big_endian);
  const Layout& at = two ? layout_2 : layout_1;
  Volume volume;
  const auto dim = [&](std::size_t k) { return header.integer(at.dim + k * at.dim_bytes, at.dim_bytes); };
  const std::int64_t dimensions = dim(0);
  if (dimensions < 3 || dimensions > 7)
    throw InputError(fmt::format("{}: has {} dimensions; must be a volume of 3", file_label, dimensions));
  for (std::size_t k = 4; k <= static_cast<std::size_t>(dimensions); ++k)
    if (dim(k) != 1)
      throw InputError(
          fmt::format("{}: has {} volumes along dimension {}; must be one", file_label, dim(k), k));
  for (std::size_t k = 0; k < 3; ++k) volume.size[k] = dim(k + 1);
  read_axes(header, at, volume);
  const Eigen::Vector3d lps_of_ras(-1.0, -1.0, 1.0);
  volume.step_mm = (lps_of_ras.asDiagonal() * volume.step_mm).eval();
  volume.origin_mm = lps_of_ras.cwiseProduct(volume.origin_mm);
  apply_unit(volume, millimetres(header.integer(at.units, at.units_bytes)), unit_mm);
  volume.frame = "NIfTI (" + volume.frame + "), RAS in the file";
  check_grid(volume, file_label);
  VoxelFormat format;
  format.type = type_of(header.integer(at.datatype, 2), file_label);
  format.big_endian = big_endian;
  const double slope = header.real(at.slope, at.real_bytes);
  const double intercept = header.real(at.slope + at.real_bytes, at.real_bytes);
  if (slope != 0.0 && std::isfinite(slope) && std::isfinite(intercept)) {
    format.slope = slope;
    format.intercept = intercept;
  }
  const double claimed = two ? static_cast<double>(header.integer(at.offset, 8)) : header.real(at.offset, 4);
  constexpr double most = 16 << 20;  // extensions of the header are texts
  if (!(claimed >= static_cast<double>(header_bytes) && claimed <= most))
    throw InputError(
        fmt::format("{}: voxels begin at byte {}; must be {} … {}", file_label, claimed, header_bytes, most));
  const auto offset = static_cast<std::size_t>(claimed);
  const std::size_t needed = offset + volume.count() * bytes_of(format.type);
  if (packed) {
    decode_voxels(volume, std::string_view(inflate(file, needed, file_label)).substr(offset), format,
                  file_label);
  } else {
    decode_voxels(volume, file.substr(std::min(offset, file.size())), format, file_label);
  }
  return volume;
}

}  // namespace endowire::io

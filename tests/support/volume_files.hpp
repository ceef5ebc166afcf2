#pragma once

#include <zlib.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "endowire/io/volume.hpp"

namespace endowire::test {

/// Places in the world at which voxel centres lie, LPS.
struct Grid {
  std::array<std::int64_t, 3> size{40, 36, 32};
  Eigen::Matrix3d step_mm = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d place_mm(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin_mm +
           step_mm * Eigen::Vector3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }
};

inline io::Volume volume_of(const Grid& grid, const std::function<double(const Eigen::Vector3d&)>& value) {
  io::Volume volume;
  volume.size = grid.size;
  volume.step_mm = grid.step_mm;
  volume.origin_mm = grid.origin_mm;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        volume.values.push_back(static_cast<float>(value(grid.place_mm(i, j, k))));
  return volume;
}

/// Distance from a line.
inline double from_line_mm(const Eigen::Vector3d& p, const Eigen::Vector3d& on,
                           const Eigen::Vector3d& along) {
  const Eigen::Vector3d r = p - on;
  return (r - r.dot(along) * along).norm();
}

template <class Number>
void put(std::string& bytes, std::size_t at, Number number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

inline std::string as_int16(const io::Volume& volume) {
  std::string bytes;
  for (const float value : volume.values) {
    const auto number = static_cast<std::int16_t>(std::lround(value));
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return bytes;
}

inline std::string packed(const std::string& bytes, bool gzip = true) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, gzip ? 15 + 16 : 15, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// NIfTI-1, 16-bit, placed by its sform.
inline std::string nifti_file(const io::Volume& volume) {
  std::string file(352, '\0');
  put<std::int32_t>(file, 0, 348);
  put<std::int16_t>(file, 40, 3);
  for (std::size_t k = 0; k < 3; ++k) put(file, 42 + 2 * k, static_cast<std::int16_t>(volume.size[k]));
  put<std::int16_t>(file, 70, 4);
  put<std::int16_t>(file, 72, 16);
  for (std::size_t k = 0; k < 3; ++k)
    put(file, 80 + 4 * k, static_cast<float>(volume.spacing_mm()[static_cast<Eigen::Index>(k)]));
  put<float>(file, 108, 352.0F);
  file[123] = 2;
  put<std::int16_t>(file, 254, 1);
  const Eigen::Vector3d ras(-1.0, -1.0, 1.0);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column)
      put(file, 280 + 16 * row + 4 * column,
          static_cast<float>(ras[r] * volume.step_mm(r, static_cast<Eigen::Index>(column))));
    put(file, 280 + 16 * row + 12, static_cast<float>(ras[r] * volume.origin_mm[r]));
  }
  std::memcpy(file.data() + 344, "n+1", 4);
  return file + as_int16(volume);
}

inline std::string three(const Eigen::Vector3d& v, const char* between) {
  char text[128];
  std::snprintf(text, sizeof text, "%.9g%s%.9g%s%.9g", v.x(), between, v.y(), between, v.z());
  return text;
}

inline std::string sizes_text(const io::Volume& volume) {
  return std::to_string(volume.size[0]) + " " + std::to_string(volume.size[1]) + " " +
         std::to_string(volume.size[2]);
}

inline std::string meta_image_file(const io::Volume& volume, bool compressed) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  std::string matrix;
  for (Eigen::Index k = 0; k < 3; ++k) matrix += three(volume.step_mm.col(k) / spacing[k], " ") + " ";
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData "
         "= " +
         std::string(compressed ? "True" : "False") + "\nTransformMatrix = " + matrix +
         "\nOffset = " + three(volume.origin_mm, " ") + "\nElementSpacing = " + three(spacing, " ") +
         "\nDimSize = " + sizes_text(volume) + "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
         (compressed ? packed(as_int16(volume), false) : as_int16(volume));
}

/// In the frame RAS, as 3D Slicer used to write.
inline std::string nrrd_file(const io::Volume& volume, bool gzip) {
  const Eigen::Vector3d ras(-1.0, -1.0, 1.0);
  std::string directions;
  for (Eigen::Index k = 0; k < 3; ++k)
    directions += " (" + three(ras.cwiseProduct(volume.step_mm.col(k)), ",") + ")";
  return "NRRD0004\n# made by a test\ntype: short\ndimension: 3\nspace: right-anterior-superior\nsizes: " +
         sizes_text(volume) + "\nspace directions:" + directions +
         "\nkinds: domain domain domain\nendian: little\nencoding: " + (gzip ? "gzip" : "raw") +
         "\nspace origin: (" + three(ras.cwiseProduct(volume.origin_mm), ",") + ")\nnote:=free: text\n\n" +
         (gzip ? packed(as_int16(volume)) : as_int16(volume));
}

/// One slice of a series, explicit little endian; stored + 1000 with an intercept of −1000.
inline std::string dicom_file(const io::Volume& volume, std::int64_t slice,
                              const std::string& series = "1.2.3") {
  std::string file(128, '\0');
  file += "DICM";
  const auto element = [&](unsigned group, unsigned number, const char* kind, std::string value) {
    if (value.size() % 2 != 0) value += kind == std::string("UI") ? '\0' : ' ';
    const auto add = [&](std::uint64_t bits, int size) {
      for (int k = 0; k < size; ++k) file += static_cast<char>(bits >> (8 * k) & 0xffU);
    };
    add(group, 2);
    add(number, 2);
    file += kind;
    const bool is_long = std::string("OB OW SQ UN").find(kind) != std::string::npos;
    if (is_long) add(0, 2);
    add(value.size(), is_long ? 4 : 2);
    file += value;
  };
  const auto word = [](std::int64_t number) {
    return std::string{static_cast<char>(number & 0xff), static_cast<char>(number >> 8 & 0xff)};
  };
  const Eigen::Vector3d spacing = volume.spacing_mm();
  element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  element(8, 0x60, "CS", "CT");
  // A sequence of undefined length with an item of undefined length: passed over.
  file += std::string("\x08\x00\x40\x11SQ\0\0\xff\xff\xff\xff\xfe\xff\x00\xe0\xff\xff\xff\xff", 20);
  element(0x20, 0x0e, "UI", "9.9.9");
  file += std::string("\xfe\xff\x0d\xe0\0\0\0\0\xfe\xff\xdd\xe0\0\0\0\0", 16);
  element(0x20, 0x0e, "UI", series);
  element(0x20, 0x32, "DS",
          three(volume.origin_mm + static_cast<double>(slice) * volume.step_mm.col(2), "\\"));
  element(0x20, 0x37, "DS",
          three(volume.step_mm.col(0) / spacing[0], "\\") + "\\" +
              three(volume.step_mm.col(1) / spacing[1], "\\"));
  element(0x28, 0x02, "US", word(1));
  element(0x28, 0x10, "US", word(volume.size[1]));
  element(0x28, 0x11, "US", word(volume.size[0]));
  element(0x28, 0x30, "DS", std::to_string(spacing[1]) + "\\" + std::to_string(spacing[0]));
  element(0x28, 0x100, "US", word(16));
  element(0x28, 0x103, "US", word(0));
  element(0x28, 0x1052, "DS", "-1000");
  element(0x28, 0x1053, "DS", "1");
  std::string pixels;
  const std::size_t count = static_cast<std::size_t>(volume.size[0] * volume.size[1]);
  for (std::size_t i = 0; i < count; ++i)
    pixels += word(1000 + std::lround(volume.values[static_cast<std::size_t>(slice) * count + i]));
  element(0x7fe0, 0x10, "OW", pixels);
  return file;
}

}  // namespace endowire::test

#include "endowire/io/nrrd.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/inflate.hpp"
#include "endowire/io/text_header.hpp"
#include "endowire/io/volume_file.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::io {

using base::InputError;

namespace {

constexpr std::size_t max_header_lines = 10'000;  // segmentations of 3D Slicer describe every segment

struct TypeNames {
  VoxelType type;
  std::string_view names;  // between bars
};
constexpr TypeNames type_names[] = {
    {VoxelType::int8, "|signed char|int8|int8_t|"},
    {VoxelType::uint8, "|uchar|unsigned char|uint8|uint8_t|"},
    {VoxelType::int16, "|short|short int|signed short|signed short int|int16|int16_t|"},
    {VoxelType::uint16, "|ushort|unsigned short|unsigned short int|uint16|uint16_t|"},
    {VoxelType::int32, "|int|signed int|int32|int32_t|"},
    {VoxelType::uint32, "|uint|unsigned int|uint32|uint32_t|"},
    {VoxelType::int64, "|longlong|long long|long long int|signed long long|int64|int64_t|"},
    {VoxelType::uint64, "|ulonglong|unsigned long long|unsigned long long int|uint64|uint64_t|"},
    {VoxelType::float32, "|float|"},
    {VoxelType::float64, "|double|"}};

VoxelFormat format_of(const TextHeader& header) {
  VoxelFormat format;
  const std::string wanted = "|" + header.text("type") + "|";
  const auto* const known =
      std::find_if(std::begin(type_names), std::end(type_names),
                   [&](const TypeNames& type) { return type.names.find(wanted) != std::string_view::npos; });
  if (known == std::end(type_names)) header.refuse("type", "a type of whole numbers, float or double");
  format.type = known->type;
  const std::string endian = header.text("endian");
  if (bytes_of(format.type) > 1 && endian != "little" && endian != "big")
    header.refuse("endian", "little or big");
  format.big_endian = endian == "big";
  return format;
}

/// Which axes have to be turned for LPS.
Eigen::Vector3d signs_of(const TextHeader& header) {
  const std::string space = header.text("space");
  if (space.empty() || space == "left-posterior-superior" || space == "LPS") return {1.0, 1.0, 1.0};
  if (space == "right-anterior-superior" || space == "RAS") return {-1.0, -1.0, 1.0};
  if (space == "left-anterior-superior" || space == "LAS") return {1.0, -1.0, 1.0};
  header.refuse("space", "left-posterior-superior, right-anterior-superior or left-anterior-superior");
}

void read_grid(const TextHeader& header, Volume& volume) {
  if (header.numbers("dimension", 1)[0] != 3.0) header.refuse("dimension", "3: one number a voxel");
  volume.size = header.sizes("sizes");
  const Eigen::Vector3d signs = signs_of(header);
  if (header.has("space directions")) {
    // One vector after the other, each the step along an axis.
    volume.step_mm = Eigen::Matrix3d(header.numbers("space directions", 9).data());
  } else if (header.has("spacings")) {
    volume.step_mm = Eigen::Vector3d(header.numbers("spacings", 3).data()).asDiagonal();
  }
  if (header.has("space origin"))
    volume.origin_mm = Eigen::Vector3d(header.numbers("space origin", 3).data());
  volume.step_mm = (signs.asDiagonal() * volume.step_mm).eval();
  volume.origin_mm = signs.cwiseProduct(volume.origin_mm);
  volume.frame = header.has("space") ? "NRRD, " + header.text("space") + " in the file"
                                     : "NRRD without a frame, taken to be LPS";
}

/// The unit of length, in quotes for each axis: one for all. None where it is not said, or no length ("voxel", "???").
std::optional<double> unit_of(const TextHeader& header) {
  const std::string key = header.has("space units") ? "space units" : "units";
  const std::string text = header.text(key);
  std::optional<double> unit;
  std::size_t axes = 0;
  for (std::size_t begin = text.find('"'); begin != std::string::npos; ++axes) {
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string::npos) header.refuse(key, "names of units in quotes");
    const std::optional<double> axis = millimetres_in(trimmed(text.substr(begin + 1, end - begin - 1)));
    if (axes > 0 && axis != unit) header.refuse(key, "the same unit of length for all axes");
    unit = axis;
    begin = text.find('"', end + 1);
  }
  return unit;
}

/// Behind what `line skip` and `byte skip` pass over.
std::string_view skipped(const TextHeader& header, std::string_view data, std::size_t needed, bool raw) {
  if (header.has("line skip")) {
    vessel::Tokens lines(data);
    const double count = header.numbers("line skip", 1)[0];
    for (double k = 0.0; k < count && !lines.at_end(); ++k) static_cast<void>(lines.line());
    data = data.substr(lines.position());
  }
  if (!header.has("byte skip")) return data;
  const double count = header.numbers("byte skip", 1)[0];
  if (count == -1.0 && raw && data.size() >= needed) return data.substr(data.size() - needed);
  if (!(count >= 0.0 && count <= static_cast<double>(data.size())))
    header.refuse("byte skip", "-1, or as many bytes as stand before the voxels");
  return data.substr(static_cast<std::size_t>(count));
}

}  // namespace

Volume parse_nrrd(std::string_view file, const std::string& file_label, const std::filesystem::path& folder,
                  std::optional<double> unit_mm) {
  vessel::Tokens lines(file);
  if (!lines.line().starts_with("NRRD000"))
    throw InputError(file_label + ": does not begin with NRRD000; must be an NRRD file");
  TextHeader header(file_label);
  for (std::size_t n = 0; n < max_header_lines && !lines.at_end(); ++n) {
    const std::string_view line = lines.line();
    if (trimmed(line).empty()) break;
    const std::size_t colon = line.find(':');
    if (line[0] == '#' || colon == std::string_view::npos || line.substr(colon).starts_with(":=")) continue;
    header.set(line.substr(0, colon), line.substr(colon + 1));
  }
  Volume volume;
  read_grid(header, volume);
  apply_unit(volume, unit_of(header), unit_mm);
  check_grid(volume, file_label);
  const VoxelFormat format = format_of(header);
  const std::string encoding = header.text("encoding");
  const bool packed = encoding == "gzip" || encoding == "gz";
  if (!packed && encoding != "raw") header.refuse("encoding", "raw or gzip");
  std::string detached;
  std::string_view data = file.substr(lines.position());
  std::string label = file_label;
  const std::string key = header.has("datafile") ? "datafile" : "data file";
  if (header.has(key)) {
    const std::string where = header.text(key);
    if (where.empty() || where.starts_with("LIST") || where.find('%') != std::string::npos)
      header.refuse(key, "the name of one file");
    detached = read_file(folder / where, max_volume_bytes);
    data = detached;
    label = one_line((folder / where).string());
  }
  const std::size_t needed = volume.count() * bytes_of(format.type);
  data = skipped(header, data, needed, !packed);
  if (packed) {
    decode_voxels(volume, inflate(data, needed, label), format, label);
  } else {
    decode_voxels(volume, data, format, label);
  }
  return volume;
}

}  // namespace endowire::io

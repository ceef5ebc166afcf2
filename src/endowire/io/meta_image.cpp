#include "endowire/io/meta_image.hpp"

#include <fmt/format.h>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/inflate.hpp"
#include "endowire/io/text_header.hpp"
#include "endowire/io/volume_file.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::io {

using base::InputError;

namespace {

constexpr std::size_t max_header_lines = 1000;

struct TypeName {
  std::string_view name;
  VoxelType type;
};
constexpr TypeName type_names[] = {{"MET_CHAR", VoxelType::int8},       {"MET_UCHAR", VoxelType::uint8},
                                   {"MET_SHORT", VoxelType::int16},     {"MET_USHORT", VoxelType::uint16},
                                   {"MET_INT", VoxelType::int32},       {"MET_UINT", VoxelType::uint32},
                                   {"MET_LONG", VoxelType::int32},      {"MET_ULONG", VoxelType::uint32},
                                   {"MET_LONG_LONG", VoxelType::int64}, {"MET_ULONG_LONG", VoxelType::uint64},
                                   {"MET_FLOAT", VoxelType::float32},   {"MET_DOUBLE", VoxelType::float64}};

/// The first of several names for the same thing.
std::string first_of(const TextHeader& header, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (header.has(key)) return key;
  return *keys.begin();
}

bool is_true(const TextHeader& header, const std::string& key) {
  const std::string text = header.text(key);
  return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
}

VoxelFormat format_of(const TextHeader& header) {
  VoxelFormat format;
  const std::string name = header.text("ElementType");
  bool known = false;
  for (const TypeName& type : type_names) {
    if (type.name != name) continue;
    known = true;
    format.type = type.type;
  }
  if (!known) header.refuse("ElementType", "MET_ and CHAR, UCHAR, SHORT, USHORT, INT, UINT, FLOAT or DOUBLE");
  if (header.has("ElementNumberOfChannels") && header.text("ElementNumberOfChannels") != "1")
    header.refuse("ElementNumberOfChannels", "1");
  if (header.has("BinaryData") && !is_true(header, "BinaryData")) header.refuse("BinaryData", "True");
  format.big_endian = is_true(header, first_of(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}));
  return format;
}

void read_grid(const TextHeader& header, Volume& volume) {
  if (header.numbers("NDims", 1)[0] != 3.0) header.refuse("NDims", "3");
  volume.size = header.sizes("DimSize");
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  const std::string spacing_key = first_of(header, {"ElementSpacing", "ElementSize"});
  if (header.has(spacing_key)) spacing = Eigen::Vector3d(header.numbers(spacing_key, 3).data());
  const std::string matrix_key = first_of(header, {"TransformMatrix", "Rotation", "Orientation"});
  if (header.has(matrix_key)) volume.step_mm = Eigen::Matrix3d(header.numbers(matrix_key, 9).data());
  volume.step_mm = (volume.step_mm * spacing.asDiagonal()).eval();
  const std::string offset_key = first_of(header, {"Offset", "Position", "Origin"});
  if (header.has(offset_key)) volume.origin_mm = Eigen::Vector3d(header.numbers(offset_key, 3).data());
  volume.frame = "MetaImage, LPS in the file";
}

}  // namespace

Volume parse_meta_image(std::string_view file, const std::string& file_label,
                        const std::filesystem::path& folder, std::optional<double> unit_mm) {
  TextHeader header(file_label);
  vessel::Tokens lines(file);
  for (std::size_t n = 0; n < max_header_lines && !lines.at_end() && !header.has("ElementDataFile"); ++n) {
    const std::string_view line = lines.line();
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals > 64)
      throw InputError(fmt::format("{}: line {} is no 'Key = value'; must be a MetaImage (.mha, .mhd)",
                                   file_label, n + 1));
    header.set(line.substr(0, equals), line.substr(equals + 1));
  }
  Volume volume;
  read_grid(header, volume);
  apply_unit(volume, millimetres_in(header.text("DistanceUnits")), unit_mm);
  check_grid(volume, file_label);
  const VoxelFormat format = format_of(header);
  const std::string where = header.text("ElementDataFile");
  if (where.empty() || where == "LIST" || where.find('%') != std::string::npos)
    header.refuse("ElementDataFile", "LOCAL or the name of one file");
  std::string detached;
  std::string_view data = file.substr(lines.position());
  std::string label = file_label;
  if (where != "LOCAL" && where != "Local" && where != "local") {
    detached = read_file(folder / where, max_volume_bytes);
    data = detached;
    label = one_line((folder / where).string());
  }
  const std::size_t needed = volume.count() * bytes_of(format.type);
  if (header.has("HeaderSize")) {
    const double skipped = header.numbers("HeaderSize", 1)[0];
    if (skipped == -1.0 && data.size() >= needed) {
      data = data.substr(data.size() - needed);
    } else if (skipped >= 0.0 && skipped <= static_cast<double>(data.size())) {
      data = data.substr(static_cast<std::size_t>(skipped));
    } else {
      header.refuse("HeaderSize", "-1, or as many bytes as stand before the voxels");
    }
  }
  if (is_true(header, "CompressedData")) {
    decode_voxels(volume, inflate(data, needed, label), format, label);
  } else {
    decode_voxels(volume, data, format, label);
  }
  return volume;
}

}  // namespace endowire::io

#include "endowire/io/dicom_series.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/text_header.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::io {

using base::InputError;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t preamble_bytes = 128;
constexpr std::size_t max_files = 20'000;
constexpr std::uintmax_t max_slice_bytes = std::uintmax_t{64} << 20;
constexpr std::uint32_t undefined_length = 0xffffffffU;
/// Slices lie as far apart as the median of them to this part: tables of scanners are exact to some hundredths.
constexpr double spacing_tolerance = 0.02;

const char* const explicit_little_endian = "1.2.840.10008.1.2.1";
const char* const implicit_little_endian = "1.2.840.10008.1.2";

using Tag = std::uint32_t;  // group in the upper half
constexpr Tag transfer_syntax = 0x00020010;
constexpr Tag series_uid = 0x0020000e;
constexpr Tag image_position = 0x00200032;
constexpr Tag image_orientation = 0x00200037;
constexpr Tag samples_per_pixel = 0x00280002;
constexpr Tag frames = 0x00280008;
constexpr Tag rows_tag = 0x00280010;
constexpr Tag columns_tag = 0x00280011;
constexpr Tag pixel_spacing = 0x00280030;
constexpr Tag bits_allocated = 0x00280100;
constexpr Tag pixel_representation = 0x00280103;
constexpr Tag rescale_intercept = 0x00281052;
constexpr Tag rescale_slope = 0x00281053;
constexpr Tag pixel_data = 0x7fe00010;
constexpr Tag item = 0xfffee000;
constexpr Tag item_end = 0xfffee00d;
constexpr Tag sequence_end = 0xfffee0dd;

/// The outermost data elements of a file, as they stand; what lies in sequences is passed over without recursion.
class Elements {
 public:
  Elements(std::string_view file, const std::string& label) : file_(file), label_(label) {
    at_ = preamble_bytes + 4;
    bool explicit_vr = true;
    int depth = 0;
    while (at_ + 8 <= file_.size()) {
      const Tag tag = number(at_, 2) << 16U | number(at_ + 2, 2);
      if (depth == 0 && tag >> 16U != 2 && !in_data_) explicit_vr = begin_data();
      const bool delimiter = tag >> 16U == 0xfffe;
      at_ += 4;
      const std::uint32_t length = delimiter ? take(4) : length_of(explicit_vr);
      if (tag == item_end || tag == sequence_end) {
        depth = std::max(0, depth - 1);
        continue;
      }
      if (length == undefined_length) {
        if (tag == pixel_data) refuse("has packed pixels; must be uncompressed");
        ++depth;
        continue;
      }
      if (length > file_.size() - at_) refuse("ends inside an element; must be whole");
      if (depth == 0 && tag != item) values_.insert_or_assign(tag, file_.substr(at_, length));
      at_ += length;
      if (depth == 0 && tag == pixel_data) return;
    }
  }

  [[nodiscard]] bool has(Tag tag) const { return values_.contains(tag); }
  [[nodiscard]] std::string_view bytes(Tag tag) const {
    const auto found = values_.find(tag);
    return found == values_.end() ? std::string_view() : found->second;
  }
  /// Padded with a space or a zero to even length.
  [[nodiscard]] std::string_view text(Tag tag) const {
    std::string_view text = bytes(tag);
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.remove_suffix(1);
    return trimmed(text);
  }
  [[nodiscard]] std::int64_t whole(Tag tag, const char* name) const {
    const std::string_view value = bytes(tag);
    if (value.size() != 2) refuse(fmt::format("has no {}", name));
    return static_cast<unsigned char>(value[0]) | static_cast<unsigned char>(value[1]) << 8;
  }
  /// Decimal numbers between backslashes.
  [[nodiscard]] std::vector<double> numbers(Tag tag, std::size_t count, const char* name) const {
    std::string plain(text(tag));
    std::replace(plain.begin(), plain.end(), '\\', ' ');
    vessel::Tokens words(plain);
    std::vector<double> numbers;
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      numbers.push_back(vessel::parse_number(word));
    if (numbers.size() != count ||
        !std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
      refuse(fmt::format("has no {} of {} numbers; must be a slice of CT or MR", name, count));
    return numbers;
  }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(label_ + ": " + what); }

 private:
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t size) const {
    std::uint32_t value = 0;
    for (std::size_t k = size; k-- > 0;) value = value << 8U | static_cast<unsigned char>(file_[at + k]);
    return value;
  }
  std::uint32_t take(std::size_t size) {
    if (file_.size() - at_ < size) refuse("ends inside an element; must be whole");
    at_ += size;
    return number(at_ - size, size);
  }
  std::uint32_t length_of(bool explicit_vr) {
    if (!explicit_vr) return take(4);
    const std::string_view kind = file_.substr(at_, 2);
    at_ += 2;
    constexpr std::string_view with_long_length = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
    if (with_long_length.find(kind) == std::string_view::npos) return take(2);
    static_cast<void>(take(2));
    return take(4);
  }
  /// Behind the first group: how the rest is written.
  bool begin_data() {
    in_data_ = true;
    const std::string_view syntax = text(transfer_syntax);
    if (syntax == implicit_little_endian) return false;
    if (syntax != explicit_little_endian)
      refuse(fmt::format(
          "transfer syntax is \"{}\"; must be uncompressed and little endian ({} or {}): unpack it first, "
          "for example with gdcmconv --raw or dcmdjpeg",
          one_line(syntax.substr(0, 64)), explicit_little_endian, implicit_little_endian));
    return true;
  }

  std::string_view file_;
  const std::string& label_;
  std::size_t at_ = 0;
  bool in_data_ = false;
  std::map<Tag, std::string_view> values_;
};

VoxelFormat format_of(const Elements& elements) {
  VoxelFormat format;
  const std::int64_t bits = elements.whole(bits_allocated, "bits allocated");
  const bool is_signed =
      elements.has(pixel_representation) && elements.whole(pixel_representation, "pixel representation") == 1;
  if (bits == 8) {
    format.type = is_signed ? VoxelType::int8 : VoxelType::uint8;
  } else if (bits == 16) {
    format.type = is_signed ? VoxelType::int16 : VoxelType::uint16;
  } else {
    elements.refuse(fmt::format("has {} bits a voxel; must be 8 or 16", bits));
  }
  if (elements.has(rescale_slope)) format.slope = elements.numbers(rescale_slope, 1, "rescale slope")[0];
  if (elements.has(rescale_intercept))
    format.intercept = elements.numbers(rescale_intercept, 1, "rescale intercept")[0];
  return format;
}

struct NamedSlice {
  std::string file;
  DicomSlice slice;
};

/// What a folder holds.
struct Folder {
  std::vector<NamedSlice> slices;  ///< of the series that is meant, or of all
  std::size_t other_files = 0;     ///< that are no images of DICOM
  std::size_t other_slices = 0;    ///< of series that are not meant
};

std::vector<fs::path> files_of(const fs::path& folder, const std::string& label) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code ignored;
    if (!entry.is_regular_file(ignored)) continue;
    files.push_back(entry.path());
    if (files.size() > max_files)
      throw InputError(
          fmt::format("{}: holds more than {} files; must be a folder of one series", label, max_files));
  }
  if (error) throw InputError(fmt::format("{}: cannot be read ({})", label, error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

/// @param series  that is meant; empty: any
Folder slices_of(const fs::path& folder, const std::string& series) {
  const std::string label = one_line(folder.string());
  Folder found;
  std::int64_t voxels = 0;
  for (const fs::path& file : files_of(folder, label)) {
    std::error_code ignored;
    const std::string name = one_line(file.string());
    const bool long_enough = fs::file_size(file, ignored) >= dicom_begin_bytes && !ignored;
    const std::string bytes = long_enough ? read_file(file, max_slice_bytes) : std::string();
    if (!is_dicom(bytes) || !holds_an_image(bytes, name)) {
      ++found.other_files;
      continue;
    }
    DicomSlice slice = parse_dicom(bytes, name);
    if (!series.empty() && slice.series != series) {
      ++found.other_slices;
      continue;
    }
    voxels += slice.rows * slice.columns;
    found.slices.push_back({name, std::move(slice)});
    if (voxels > max_voxels)
      throw InputError(
          fmt::format("{}: holds more than {} voxels; must be a series of fewer", label, max_voxels));
  }
  if (found.slices.empty())
    throw InputError(
        label + ": is a folder without DICOM files; must be a file, or a folder that holds a DICOM series");
  return found;
}

void check_one_series(const std::vector<NamedSlice>& slices, const std::string& label) {
  struct Series {
    std::size_t count = 0;
    std::string file;
  };
  std::map<std::string, Series> all;
  for (const NamedSlice& named : slices) {
    Series& series = all[named.slice.series];
    if (series.count++ == 0) series.file = named.file;
  }
  if (all.size() == 1) return;
  std::string list;
  std::string files;
  for (const auto& [uid, series] : all) {
    list += fmt::format("{}{} ({} slices)", list.empty() ? "" : ", ", one_line(uid), series.count);
    files += (files.empty() ? "" : ", ") + series.file;
  }
  throw InputError(
      fmt::format("{}: holds {} series, {}; must be one: name a file of the one meant, such as {}", label,
                  all.size(), list.substr(0, 400), files.substr(0, 400)));
}

void check_alike(const std::vector<NamedSlice>& slices) {
  const DicomSlice& first = slices.front().slice;
  for (const auto& [file, slice] : slices)
    if (slice.rows != first.rows || slice.columns != first.columns ||
        slice.along_row.dot(first.along_row) < 0.9999 ||
        slice.along_column.dot(first.along_column) < 0.9999 ||
        std::abs(slice.row_spacing_mm - first.row_spacing_mm) > 1e-3 * first.row_spacing_mm ||
        std::abs(slice.column_spacing_mm - first.column_spacing_mm) > 1e-3 * first.column_spacing_mm)
      throw InputError(
          fmt::format("{}: differs in size, spacing or direction from {}; must be alike in one series", file,
                      slices.front().file));
}

/// @param slices  in order along the normal
void check_gaps(const std::vector<NamedSlice>& slices, const Eigen::Vector3d& normal, double spacing_mm) {
  for (std::size_t k = 1; k < slices.size(); ++k) {
    const double gap = normal.dot(slices[k].slice.position_mm - slices[k - 1].slice.position_mm);
    if (std::abs(gap - spacing_mm) <= spacing_tolerance * spacing_mm) continue;
    throw InputError(fmt::format("{}: lies {:.3f} mm from {}; must be {:.3f} mm, as most slices are: {}",
                                 slices[k].file, gap, slices[k - 1].file, spacing_mm,
                                 gap < spacing_mm ? "one is there twice" : "one is missing between them"));
  }
}

/// Slices lie behind each other, a tilted gantry's on a slant, but none aside.
void check_line(const std::vector<NamedSlice>& slices, double spacing_mm) {
  const Eigen::Vector3d first = slices.front().slice.position_mm;
  const Eigen::Vector3d step =
      (slices.back().slice.position_mm - first) / static_cast<double>(slices.size() - 1);
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const double aside = (slices[k].slice.position_mm - first - static_cast<double>(k) * step).norm();
    if (aside > 0.5 * spacing_mm)
      throw InputError(fmt::format("{}: lies {:.3f} mm beside the line of the series; must be <= {:.3f} mm",
                                   slices[k].file, aside, 0.5 * spacing_mm));
  }
}

}  // namespace

bool is_dicom(std::string_view file) {
  return file.size() >= dicom_begin_bytes && file.substr(preamble_bytes, 4) == "DICM";
}

bool holds_an_image(std::string_view file, const std::string& file_label) {
  const Elements elements(file, file_label);
  return elements.has(pixel_data) || elements.has(rows_tag);
}

DicomSlice parse_dicom(std::string_view file, const std::string& file_label) {
  if (!is_dicom(file)) throw InputError(file_label + ": has no DICM behind 128 bytes; must be a DICOM file");
  const Elements elements(file, file_label);
  if (elements.has(frames) && elements.text(frames) != "1")
    elements.refuse(fmt::format("has {} frames; must be one slice a file",
                                one_line(elements.text(frames).substr(0, 20))));
  if (elements.has(samples_per_pixel) && elements.whole(samples_per_pixel, "samples per pixel") != 1)
    elements.refuse("is a colour image; must have one number a voxel");
  DicomSlice slice;
  slice.series = elements.text(series_uid);
  slice.rows = elements.whole(rows_tag, "rows");
  slice.columns = elements.whole(columns_tag, "columns");
  slice.position_mm = Eigen::Vector3d(elements.numbers(image_position, 3, "image position").data());
  const std::vector<double> directions = elements.numbers(image_orientation, 6, "image orientation");
  slice.along_row = Eigen::Vector3d(directions.data());
  slice.along_column = Eigen::Vector3d(directions.data() + 3);
  if (std::abs(slice.along_row.norm() - 1.0) > 1e-2 || std::abs(slice.along_column.norm() - 1.0) > 1e-2 ||
      std::abs(slice.along_row.dot(slice.along_column)) > 1e-2)
    elements.refuse("has an image orientation that is no pair of directions at right angles");
  const std::vector<double> spacing = elements.numbers(pixel_spacing, 2, "pixel spacing");
  slice.row_spacing_mm = spacing[0];
  slice.column_spacing_mm = spacing[1];
  slice.format = format_of(elements);
  slice.pixels = elements.bytes(pixel_data);
  const std::size_t needed =
      static_cast<std::size_t>(slice.rows * slice.columns) * bytes_of(slice.format.type);
  if (slice.rows < 2 || slice.columns < 2 || slice.pixels.size() < needed)
    elements.refuse(fmt::format("holds {} bytes of {} x {} voxels; must be {}", slice.pixels.size(),
                                slice.rows, slice.columns, needed));
  return slice;
}

Volume read_dicom_series(const fs::path& folder, const fs::path& file, std::optional<double> unit_mm) {
  const std::string label = one_line(folder.string());
  std::string series;
  if (!file.empty()) {
    const std::string name = one_line(file.string());
    series = parse_dicom(read_file(file, max_slice_bytes), name).series;
  }
  Folder found = slices_of(folder, series);
  std::vector<NamedSlice>& slices = found.slices;
  check_one_series(slices, label);
  check_alike(slices);
  if (slices.size() < 2) throw InputError(label + ": holds one slice; must be a series of two and more");
  const DicomSlice& first = slices.front().slice;
  const Eigen::Vector3d normal = first.along_row.cross(first.along_column).normalized();
  const auto height = [&](const NamedSlice& named) { return normal.dot(named.slice.position_mm); };
  std::stable_sort(slices.begin(), slices.end(),
                   [&](const NamedSlice& a, const NamedSlice& b) { return height(a) < height(b); });
  std::vector<double> gaps;
  for (std::size_t k = 1; k < slices.size(); ++k) gaps.push_back(height(slices[k]) - height(slices[k - 1]));
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  const double spacing_mm = gaps[gaps.size() / 2];
  check_gaps(slices, normal, spacing_mm);
  check_line(slices, spacing_mm);

  Volume volume;
  const DicomSlice& low = slices.front().slice;
  volume.size = {low.columns, low.rows, static_cast<std::int64_t>(slices.size())};
  volume.origin_mm = low.position_mm;
  volume.step_mm.col(0) = low.column_spacing_mm * low.along_row;
  volume.step_mm.col(1) = low.row_spacing_mm * low.along_column;
  volume.step_mm.col(2) =
      (slices.back().slice.position_mm - low.position_mm) / static_cast<double>(slices.size() - 1);
  volume.frame = fmt::format("DICOM, {} slices, LPS in the files", slices.size());
  if (found.other_slices > 0)
    volume.frame += fmt::format(", {} slices of other series left out", found.other_slices);
  if (found.other_files > 0) volume.frame += fmt::format(", {} other files passed over", found.other_files);
  apply_unit(volume, 1.0, unit_mm);
  check_grid(volume, label);
  volume.values.reserve(volume.count());
  volume.whole_numbers = true;
  for (NamedSlice& named : slices) {
    Volume one;
    one.size = {low.columns, low.rows, 1};
    decode_voxels(one, named.slice.pixels, named.slice.format, named.file);
    volume.values.insert(volume.values.end(), one.values.begin(), one.values.end());
    volume.whole_numbers = volume.whole_numbers && one.whole_numbers;
    named.slice.pixels = {};
  }
  return volume;
}

}  // namespace endowire::io

#include "endowire/io/volume_file.hpp"

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "endowire/io/dicom_series.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/meta_image.hpp"
#include "endowire/io/nifti.hpp"
#include "endowire/io/nrrd.hpp"

namespace endowire::io {

namespace fs = std::filesystem;

namespace {

std::string lower_name(const fs::path& path) {
  std::string name = path.filename().string();
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

bool ends_with_any(const std::string& name, std::initializer_list<std::string_view> endings) {
  for (const std::string_view ending : endings)
    if (name.ends_with(ending)) return true;
  return false;
}

}  // namespace

bool names_a_dicom_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return false;
  if (lower_name(path).ends_with(".dcm")) return true;
  std::array<char, dicom_begin_bytes> begin{};  // scanners write names without an ending
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return is_dicom({begin.data(), static_cast<std::size_t>(file.gcount())});
}

bool names_a_volume(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) ||
         ends_with_any(lower_name(path), {".nii", ".nii.gz", ".mha", ".mhd", ".nrrd", ".nhdr"}) ||
         names_a_dicom_file(path);
}

Volume read_volume(const fs::path& path, std::optional<double> unit_mm) {
  const std::string name = lower_name(path);
  std::error_code error;
  if (fs::is_directory(path, error)) return read_dicom_series(path, {}, unit_mm);
  if (names_a_dicom_file(path))
    return read_dicom_series(path.parent_path().empty() ? "." : path.parent_path(), path, unit_mm);
  const std::string bytes = read_file(path, max_volume_bytes);
  const std::string label = one_line(path.string());
  if (ends_with_any(name, {".mha", ".mhd"}))
    return parse_meta_image(bytes, label, path.parent_path(), unit_mm);
  if (ends_with_any(name, {".nrrd", ".nhdr"})) return parse_nrrd(bytes, label, path.parent_path(), unit_mm);
  return parse_nifti(bytes, label, unit_mm);
}

}  // namespace endowire::io

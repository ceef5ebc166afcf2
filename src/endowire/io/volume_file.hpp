#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// Files of images beyond this are refused before they are read: max_voxels of four bytes.
inline constexpr std::uintmax_t max_volume_bytes = std::uintmax_t{1} << 30;

/// Whether a path names an image volume: a folder (a DICOM series), or a file called .nii, .nii.gz, .mha, .mhd, .nrrd,
/// .nhdr or .dcm, or one that begins as a DICOM file does.
[[nodiscard]] bool names_a_volume(const std::filesystem::path& path);

/// Reads an image volume. A file of a DICOM series stands for its series: the others of its folder are left out.
/// @param unit_mm  of the lengths in the file, when it is wrong about it
/// @throws base::InputError one line that names the file, what is wrong with it and what is allowed
[[nodiscard]] Volume read_volume(const std::filesystem::path& path, std::optional<double> unit_mm = {});

/// Whether a path names one file of a DICOM series.
[[nodiscard]] bool names_a_dicom_file(const std::filesystem::path& path);

}  // namespace endowire::io

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// One slice as a DICOM file holds it.
struct DicomSlice {
  std::string series;  ///< SeriesInstanceUID
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< centre of the first voxel, LPS
  Eigen::Vector3d along_row = Eigen::Vector3d::UnitX();   ///< to the next column, length one
  Eigen::Vector3d along_column = Eigen::Vector3d::UnitY();
  double row_spacing_mm = 0.0;     ///< between rows
  double column_spacing_mm = 0.0;  ///< between columns
  VoxelFormat format;
  std::string pixels;  ///< as stored
};

/// Whether bytes begin as a DICOM file does.
[[nodiscard]] bool is_dicom(std::string_view file);

/// Reads what a volume needs of one file: uncompressed, little endian, one number a voxel, one frame.
/// Source  DICOM PS3.5 (data elements), PS3.10 (files), PS3.3 C.7.6.2 (image plane).
/// @throws base::InputError for anything else, and for what is damaged
[[nodiscard]] DicomSlice parse_dicom(std::string_view file, const std::string& file_label);

/// The volume of a series, one file a slice, in a folder. Other files of the folder are passed over.
/// @throws base::InputError when there is no series or several, slices differ in size or direction, one is missing or
///                          there twice; it names the slice
[[nodiscard]] Volume read_dicom_series(const std::filesystem::path& folder);

}  // namespace endowire::io

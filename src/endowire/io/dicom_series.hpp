#pragma once

#include <filesystem>
#include <optional>
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

/// What a DICOM file begins with: a preamble, DICM, and a first byte.
inline constexpr std::size_t dicom_begin_bytes = 133;

/// Whether bytes begin as a DICOM file does.
[[nodiscard]] bool is_dicom(std::string_view file);

/// Whether a file that is one (is_dicom) holds an image: not a directory of a disc, a report or a plan.
[[nodiscard]] bool holds_an_image(std::string_view file, const std::string& file_label);

/// Reads what a volume needs of one file: uncompressed, little endian, one number a voxel, one frame.
/// Source  DICOM PS3.5 (data elements), PS3.10 (files), PS3.3 C.7.6.2 (image plane).
/// @throws base::InputError for anything else, and for what is damaged
[[nodiscard]] DicomSlice parse_dicom(std::string_view file, const std::string& file_label);

/// The volume of a series, one file a slice, in a folder. Other files of the folder, and DICOM files without an image, are
/// passed over and counted in `frame`.
/// @param file     one of the series that is meant; empty: the folder must hold one alone
/// @param unit_mm  of length, when the files are wrong about it
/// @throws base::InputError when there is no series or several, slices differ in size or direction, one is missing, there
///                          twice or aside; it names the slice
[[nodiscard]] Volume read_dicom_series(const std::filesystem::path& folder,
                                       const std::filesystem::path& file = {},
                                       std::optional<double> unit_mm = {});

}  // namespace endowire::io

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// A MetaImage: header and voxels in one file (.mha), or the voxels in another file beside it (.mhd), packed with zlib or
/// not. Its frame is LPS, as in ITK; the first three numbers of TransformMatrix are the direction of the first axis.
/// Lengths are in what DistanceUnits says: um, mm or cm.
/// @param folder   where a data file is looked for
/// @param unit_mm  of length, when the header is wrong about it
/// @throws base::InputError for what is no such file, is damaged, or holds more than one number a voxel
[[nodiscard]] Volume parse_meta_image(std::string_view file, const std::string& file_label,
                                      const std::filesystem::path& folder,
                                      std::optional<double> unit_mm = {});

}  // namespace endowire::io

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// A MetaImage: header and voxels in one file (.mha), or the voxels in another file beside it (.mhd), packed with zlib or
/// not. Its frame is LPS, as in ITK; the first three numbers of TransformMatrix are the direction of the first axis.
/// @param folder  where a data file is looked for
/// @throws base::InputError for what is no such file, is damaged, or holds more than one number a voxel
[[nodiscard]] Volume parse_meta_image(std::string_view file, const std::string& file_label,
                                      const std::filesystem::path& folder);

}  // namespace endowire::io

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// An NRRD volume: header and voxels in one file (.nrrd), or the voxels in another file beside it (.nhdr), raw or packed
/// with gzip. Frames LPS, RAS and LAS are turned into LPS; a file without one is taken to be in LPS, and that is said.
/// Source  http://teem.sourceforge.net/nrrd/format.html
/// Lengths are in what `space units`, else `units`, say.
/// @param folder   where a data file is looked for
/// @param unit_mm  of length, when the header is wrong about it
/// @throws base::InputError for what is no such file, is damaged, or is not a volume of single numbers
[[nodiscard]] Volume parse_nrrd(std::string_view file, const std::string& file_label,
                                const std::filesystem::path& folder, std::optional<double> unit_mm = {});

}  // namespace endowire::io

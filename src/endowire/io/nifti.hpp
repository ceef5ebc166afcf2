#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// A NIfTI image of version 1 or 2 in one file, packed with gzip or not.
///
/// Its axes are those of the sform, else of the qform, else of the spacing alone; NIfTI's frame is RAS and is turned into
/// LPS. The scale of values and the unit of length of the header are applied.
/// Source  https://nifti.nimh.nih.gov/nifti-1 and nifti-2 (headers nifti1.h, nifti2.h).
/// @param unit_mm  of length, when the header is wrong about it
/// @throws base::InputError for what is no such file, is damaged, has more than three dimensions, or a type of number
///                          that is no scalar
[[nodiscard]] Volume parse_nifti(std::string_view file, const std::string& file_label,
                                 std::optional<double> unit_mm = {});

}  // namespace endowire::io

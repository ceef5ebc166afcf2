#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace endowire::io {

/// The first `size` bytes behind a gzip or zlib stream. Memory grows with what comes out, never with what a header claims,
/// and never beyond `size`: what lies behind is not unpacked.
/// @throws base::InputError when the stream is damaged or ends before
[[nodiscard]] std::string inflate(std::string_view packed, std::size_t size, const std::string& file_label);

/// Whether bytes begin as a gzip file does.
[[nodiscard]] bool is_gzip(std::string_view bytes);

}  // namespace endowire::io

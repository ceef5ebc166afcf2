#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace endowire::io {

/// An image of 8-bit palette indices, row by row from the top.
struct IndexedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;                        ///< width × height
  std::array<std::array<std::uint8_t, 4>, 256> palette{};  ///< red, green, blue, opacity
};

/// The image as a PNG file. Compressed by run lengths with the fixed Huffman code of DEFLATE: no library
/// needed, and flat backgrounds all but vanish. Source  PNG (ISO/IEC 15948), zlib (RFC 1950), DEFLATE (RFC
/// 1951 §3.2.6).
[[nodiscard]] std::string encode_png(const IndexedImage& image);

}  // namespace endowire::io

#include "endowire/io/png.hpp"

#include "endowire/base/contract.hpp"

namespace endowire::io {

namespace {

/// CRC-32 of PNG chunks, polynomial 0xedb88320 (ISO/IEC 15948 annex D).
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

/// Adler-32 of the uncompressed bytes (RFC 1950 §8).
std::uint32_t adler32(std::string_view bytes) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % 65521U;
    b = (b + a) % 65521U;
  }
  return (b << 16) | a;
}

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xffU);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::string body = std::string(type) + std::string(data);
  out += body;
  append_u32(out, crc32(body));
}

/// Bits of a DEFLATE stream: data from the low bit up, Huffman codes from their high bit down.
class BitWriter {
 public:
  explicit BitWriter(std::string& out) : out_(out) {}
  void bits(std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bit((value >> i) & 1U);
  }
  void code(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) bit((value >> i) & 1U);
  }
  /// A literal, length or end symbol in the fixed code.
  void symbol(std::uint32_t symbol) {
    if (symbol < 144) return code(0x30 + symbol, 8);
    if (symbol < 256) return code(0x190 + symbol - 144, 9);
    if (symbol < 280) return code(symbol - 256, 7);
    code(0xc0 + symbol - 280, 8);
  }
  void flush() {
    while (used_ != 0) bit(0);
  }

 private:
  void bit(std::uint32_t value) {
    byte_ |= value << used_;
    if (++used_ == 8) {
      out_ += static_cast<char>(byte_);
      byte_ = 0;
      used_ = 0;
    }
  }
  std::string& out_;
  std::uint32_t byte_ = 0;
  int used_ = 0;
};

/// Repeats the last byte `length` times more: a match at distance 1, of 3 … 258 bytes (RFC 1951 §3.2.5).
void append_repeat(BitWriter& writer, std::uint32_t length) {
  if (length == 258) {
    writer.symbol(285);
  } else {
    int extra = 0;
    while (length - 3 >= (8U << extra)) ++extra;
    const std::uint32_t offset = length - 3;
    const std::uint32_t step = offset >> extra;
    const std::uint32_t symbol =
        extra == 0 ? 257 + offset : 257 + 4 * static_cast<std::uint32_t>(extra) + step;
    writer.symbol(symbol);
    writer.bits(offset & ((1U << extra) - 1U), extra);
  }
  writer.code(0, 5);
}

std::string deflate_runs(std::string_view bytes) {
  std::string out = "\x78\x01";
  BitWriter writer(out);
  writer.bits(1, 1);  // the last block
  writer.bits(1, 2);  // fixed Huffman code
  std::size_t i = 0;
  while (i < bytes.size()) {
    const char value = bytes[i];
    std::size_t end = i + 1;
    while (end < bytes.size() && bytes[end] == value) ++end;
    writer.symbol(static_cast<unsigned char>(value));
    std::size_t left = end - i - 1;
    while (left >= 3) {
      const std::size_t length = left > 258 ? 258 : left;
      append_repeat(writer, static_cast<std::uint32_t>(length));
      left -= length;
    }
    for (; left > 0; --left) writer.symbol(static_cast<unsigned char>(value));
    i = end;
  }
  writer.symbol(256);
  writer.flush();
  append_u32(out, adler32(bytes));
  return out;
}

}  // namespace

std::string encode_png(const IndexedImage& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  ENDOWIRE_EXPECTS(image.pixels.size() == width * height, "an image has a byte for every pixel");
  std::string raw;
  raw.reserve((width + 1) * height);
  for (std::size_t row = 0; row < height; ++row) {
    raw += '\0';  // no filter
    raw.append(reinterpret_cast<const char*>(image.pixels.data()) + row * width, width);
  }
  std::string header;
  append_u32(header, static_cast<std::uint32_t>(width));
  append_u32(header, static_cast<std::uint32_t>(height));
  header += std::string("\x08\x03\x00\x00\x00", 5);  // 8 bit, palette
  std::string colours;
  std::string opacities;
  for (const auto& entry : image.palette) {
    for (std::size_t c = 0; c < 3; ++c) colours += static_cast<char>(entry[c]);
    opacities += static_cast<char>(entry[3]);
  }
  std::string out = "\x89PNG\r\n\x1a\n";
  append_chunk(out, "IHDR", header);
  append_chunk(out, "PLTE", colours);
  append_chunk(out, "tRNS", opacities);
  append_chunk(out, "IDAT", deflate_runs(raw));
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace endowire::io

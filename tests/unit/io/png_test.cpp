#include "endowire/io/png.hpp"

#include <gtest/gtest.h>

#include <random>

#include "endowire/io/lumen_shading.hpp"

namespace endowire::io {
namespace {

/// A reader of just what `encode_png` writes, from the RFCs: fixed Huffman codes, matches at any distance.
class Inflater {
 public:
  explicit Inflater(std::string bytes) : bytes_(std::move(bytes)) {}
  std::string run() {
    EXPECT_EQ(bits(1), 1U);  // last block
    EXPECT_EQ(bits(2), 1U);  // fixed codes
    std::string out;
    while (true) {
      const unsigned symbol = literal();
      if (symbol == 256) return out;
      if (symbol < 256) {
        out += static_cast<char>(symbol);
        continue;
      }
      constexpr unsigned base[] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                   31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
      constexpr unsigned extra[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                    2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
      unsigned length = base[symbol - 257];
      length += bits(static_cast<int>(extra[symbol - 257]));
      EXPECT_EQ(code(5), 0U);  // distance 1
      out.append(length, out.back());
    }
  }

 private:
  unsigned bits(int count) {
    unsigned value = 0;
    for (int i = 0; i < count; ++i) value |= bit() << i;
    return value;
  }
  unsigned code(int count) {
    unsigned value = 0;
    for (int i = 0; i < count; ++i) value = value << 1 | bit();
    return value;
  }
  unsigned literal() {
    unsigned value = code(7);
    if (value <= 0x17) return value + 256;
    value = value << 1 | bit();
    if (value >= 0x30 && value <= 0xbf) return value - 0x30;
    if (value >= 0xc0 && value <= 0xc7) return value - 0xc0 + 280;
    value = value << 1 | bit();
    return value - 0x190 + 144;
  }
  unsigned bit() {
    const unsigned value = static_cast<unsigned char>(bytes_.at(at_ / 8)) >> (at_ % 8) & 1U;
    ++at_;
    return value;
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

std::string image_data(const std::string& png) {
  const std::size_t at = png.find("IDAT");
  std::size_t size = 0;
  for (std::size_t i = at - 4; i < at; ++i) size = size << 8 | static_cast<unsigned char>(png[i]);
  return png.substr(at + 4 + 2, size - 6);  // without zlib's head and checksum
}

TEST(Png, PixelsSurviveWhateverTheRuns) {
  std::mt19937 random(7);
  IndexedImage image;
  image.width = 300;
  image.height = 40;
  while (image.pixels.size() < 12000) {
    const std::size_t run = random() % 3 == 0 ? random() % 700 : random() % 6;
    image.pixels.insert(image.pixels.end(), run, static_cast<std::uint8_t>(random() % 256));
  }
  image.pixels.resize(12000);
  const std::string raw = Inflater(image_data(encode_png(image))).run();
  ASSERT_EQ(raw.size(), 301U * 40U);
  for (std::size_t row = 0; row < 40; ++row) {
    EXPECT_EQ(raw[row * 301], '\0');
    for (std::size_t column = 0; column < 300; ++column)
      ASSERT_EQ(static_cast<unsigned char>(raw[row * 301 + 1 + column]), image.pixels[row * 300 + column]);
  }
}

TEST(Png, ChecksumsAreThoseOfTheStandards) {
  IndexedImage image;
  image.width = image.height = 1;
  image.pixels = {0};
  const std::string png = encode_png(image);
  // The end chunk is the same in every PNG file.
  EXPECT_EQ(png.substr(png.size() - 12), std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(LumenShading, TwoLayersTakeAwayMoreThanOneAndNothingIsDrawnBeside) {
  vessel::TriangleMesh mesh;
  mesh.vertices_mm = {{1, 0, 1}, {9, 0, 1}, {1, 0, 9}, {1, 5, 1}, {4, 5, 1}, {1, 5, 4}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  View view;
  view.extent_mm = {10.0, 10.0};
  const IndexedImage image = shade_lumen(mesh, view, 100, 100);
  const auto at = [&](double x, double z) {
    return image
        .pixels[static_cast<std::size_t>((10.0 - z) * 10.0) * 100 + static_cast<std::size_t>(x * 10.0)];
  };
  EXPECT_EQ(at(9.0, 9.0), 0);
  EXPECT_EQ(at(0.5, 5.0), 0);
  EXPECT_NEAR(at(5.0, 4.0), 255 * 0.09, 1.0);                 // one layer, face on
  EXPECT_NEAR(at(1.5, 1.6), 255 * (1.0 - 0.91 * 0.91), 1.0);  // two of them
}

}  // namespace
}  // namespace endowire::io

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "endowire/io/png.hpp"

namespace endowire::io {

/// Draws on an image of palette indices: lines, discs and small text. What lies outside is cut off.
class Canvas {
 public:
  Canvas(int width, int height, std::uint8_t ground);

  void set(int x, int y, std::uint8_t colour);
  void rectangle(int x, int y, int width, int height, std::uint8_t colour);
  void disc(const Eigen::Vector2d& centre, double radius, std::uint8_t colour);
  /// A line with round ends.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, std::uint8_t colour);
  /// Digits, small letters and . - +; other characters leave a space.
  /// @param x, y  of the left upper corner; a character is 6 · scale wide and 7 · scale high
  void text(int x, int y, std::string_view text, int scale, std::uint8_t colour);
  [[nodiscard]] static int text_width(std::string_view text, int scale) {
    return (6 * static_cast<int>(text.size()) - 1) * scale;
  }

  [[nodiscard]] IndexedImage& image() { return image_; }

 private:
  IndexedImage image_;
};

}  // namespace endowire::io

#include "endowire/io/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace endowire::io {

namespace {

constexpr int glyph_width = 5;
constexpr int glyph_height = 7;

/// Rows from the top, the leftmost of five columns in the highest bit.
struct Glyph {
  char character;
  std::array<std::uint8_t, glyph_height> rows;
};

// clang-format off
constexpr std::array<Glyph, 39> glyphs{{
    {'0', {14, 17, 19, 21, 25, 17, 14}},
    {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {31, 2, 4, 2, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},
    {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},
    {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},
    {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'+', {0, 4, 4, 31, 4, 4, 0}},
    {'a', {0, 0, 14, 1, 15, 17, 15}},
    {'b', {16, 16, 22, 25, 17, 17, 30}},
    {'c', {0, 0, 14, 16, 16, 17, 14}},
    {'d', {1, 1, 13, 19, 17, 17, 15}},
    {'e', {0, 0, 14, 17, 31, 16, 14}},
    {'f', {6, 9, 8, 28, 8, 8, 8}},
    {'g', {0, 15, 17, 17, 15, 1, 14}},
    {'h', {16, 16, 22, 25, 17, 17, 17}},
    {'i', {4, 0, 12, 4, 4, 4, 14}},
    {'j', {2, 0, 6, 2, 2, 18, 12}},
    {'k', {16, 16, 18, 20, 24, 20, 18}},
    {'l', {12, 4, 4, 4, 4, 4, 14}},
    {'m', {0, 0, 26, 21, 21, 17, 17}},
    {'n', {0, 0, 22, 25, 17, 17, 17}},
    {'o', {0, 0, 14, 17, 17, 17, 14}},
    {'p', {0, 0, 30, 17, 30, 16, 16}},
    {'q', {0, 0, 13, 19, 15, 1, 1}},
    {'r', {0, 0, 22, 25, 16, 16, 16}},
    {'s', {0, 0, 14, 16, 14, 1, 30}},
    {'t', {8, 8, 28, 8, 8, 9, 6}},
    {'u', {0, 0, 17, 17, 17, 19, 13}},
    {'v', {0, 0, 17, 17, 17, 10, 4}},
    {'w', {0, 0, 17, 17, 21, 21, 10}},
    {'x', {0, 0, 17, 10, 4, 10, 17}},
    {'y', {0, 0, 17, 17, 15, 1, 14}},
    {'z', {0, 0, 31, 2, 4, 8, 31}},
}};
// clang-format on

}  // namespace

Canvas::Canvas(int width, int height, std::uint8_t ground) {
  image_.width = width;
  image_.height = height;
  image_.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), ground);
}

void Canvas::set(int x, int y, std::uint8_t colour) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  image_.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                static_cast<std::size_t>(x)] = colour;
}

void Canvas::rectangle(int x, int y, int width, int height, std::uint8_t colour) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) set(i, j, colour);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, std::uint8_t colour) {
  line(centre, centre, 2.0 * radius, colour);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, std::uint8_t colour) {
  const double reach = 0.5 * width;
  const Eigen::Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const auto low = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - reach)); };
  const auto high = [&](double a, double b) { return static_cast<int>(std::ceil(std::max(a, b) + reach)); };
  for (int y = low(from.y(), to.y()); y <= high(from.y(), to.y()); ++y)
    for (int x = low(from.x(), to.x()); x <= high(from.x(), to.x()); ++x) {
      const Eigen::Vector2d place(x + 0.5, y + 0.5);
      const double part = length2 > 0.0 ? std::clamp((place - from).dot(along) / length2, 0.0, 1.0) : 0.0;
      if ((place - from - part * along).squaredNorm() <= reach * reach) set(x, y, colour);
    }
}

void Canvas::text(int x, int y, std::string_view text, int scale, std::uint8_t colour) {
  for (const char c : text) {
    const auto* const glyph =
        std::find_if(glyphs.begin(), glyphs.end(), [c](const Glyph& g) { return g.character == c; });
    for (int row = 0; glyph != glyphs.end() && row < glyph_height; ++row)
      for (int column = 0; column < glyph_width; ++column)
        if ((glyph->rows[static_cast<std::size_t>(row)] >> (glyph_width - 1 - column) & 1) != 0)
          rectangle(x + column * scale, y + row * scale, scale, scale, colour);
    x += (glyph_width + 1) * scale;
  }
}

}  // namespace endowire::io

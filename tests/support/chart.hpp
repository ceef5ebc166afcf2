#pragma once

#include <array>
#include <string>
#include <vector>

namespace endowire::drawing {

enum class Mark { none, dot, ring, cross };

/// Points that belong together.
struct Series {
  std::string name;  ///< in the legend; empty: not there
  std::vector<std::array<double, 2>> points;
  bool line = true;
  Mark mark = Mark::dot;
  int colour = 0;       ///< of the palette; -1: grey
  bool broken = false;  ///< a thin, broken line: a guide
  std::string label{};  ///< written at its last point; may be empty
};

struct Axis {
  std::string label;
  bool logarithmic = false;  ///< points that are not positive are left out
};

/// A picture of series over two axes.
struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  bool true_to_scale = false;  ///< a millimetre is as long on both axes
};

/// One SVG with charts side by side, in rows of two when there are more than three. Coordinates have one decimal, so that equal values give
/// equal files.
/// @throws std::invalid_argument  for a chart without points, or with numbers that are not finite
[[nodiscard]] std::string svg(const std::vector<Chart>& charts);

}  // namespace endowire::drawing

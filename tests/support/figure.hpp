#pragma once

#include <string>
#include <vector>

#include "support/plane_point.hpp"

namespace endowire::test {

/// How a series is drawn: closed forms as lines, our values as rings, guides thin and broken.
enum class Mark { line, rings, guide };

struct Series {
  Mark mark = Mark::line;
  std::vector<PlanePoint> points;
  std::string label;  ///< written at its last point; may be empty
};

/// One picture of docs/validation.md: values of the simulator over closed forms.
struct Figure {
  std::string name;     ///< of the file, without its ending
  std::string title;    ///< one line over the axes
  std::string x_label;  ///< with unit
  std::string y_label;
  std::vector<Series> series;
  bool equal_axes = false;  ///< a shape: one scale for both
  bool log_x = false;
  bool log_y = false;
};

/// The picture as SVG: a chart of `support/chart.hpp`, and its errors.
[[nodiscard]] std::string svg(const Figure& figure);

}  // namespace endowire::test

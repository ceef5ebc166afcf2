#include "support/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "endowire/io/markup.hpp"

namespace endowire::drawing {

namespace {

constexpr double kPlotWidth = 360.0;
constexpr double kPlotHeight = 270.0;
constexpr double kLeft = 62.0;
constexpr double kTop = 34.0;
constexpr double kBottom = 46.0;
constexpr double kRight = 16.0;
constexpr double kRightOfLabels = 100.0;
constexpr double kLegendRow = 16.0;
/// Told apart by people who do not see red or green [Okabe & Ito 2008].
constexpr std::array<std::string_view, 7> kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};

/// From values to pixels along one axis.
struct Scale {
  double low = 0.0, high = 1.0;  ///< values, or their logarithms
  double from = 0.0, to = 1.0;   ///< pixels
  bool logarithmic = false;

  [[nodiscard]] bool shows(double value) const { return !logarithmic || value > 0.0; }
  [[nodiscard]] double at(double value) const {
    const double v = logarithmic ? std::log10(value) : value;
    return from + (v - low) / (high - low) * (to - from);
  }
};

Scale scale_of(const Chart& chart, std::size_t coordinate) {
  Scale scale;
  scale.logarithmic = (coordinate == 0 ? chart.x : chart.y).logarithmic;
  scale.low = HUGE_VAL;
  scale.high = -HUGE_VAL;
  for (const Series& series : chart.series) {
    for (const auto& point : series.points) {
      if (!scale.shows(point[coordinate])) continue;
      const double v = scale.logarithmic ? std::log10(point[coordinate]) : point[coordinate];
      if (!std::isfinite(v)) throw std::invalid_argument(chart.title + ": a value is not finite");
      scale.low = std::min(scale.low, v);
      scale.high = std::max(scale.high, v);
    }
  }
  if (!(scale.high >= scale.low)) throw std::invalid_argument(chart.title + ": nothing to draw");
  const double margin = std::max(0.06 * (scale.high - scale.low), 1e-9);
  scale.low -= margin;
  scale.high += margin;
  return scale;
}

/// Widens one of two scales until both have as many millimetres a pixel.
void make_true(Scale& x, Scale& y) {
  const double x_unit = (x.high - x.low) / std::abs(x.to - x.from);
  const double y_unit = (y.high - y.low) / std::abs(y.to - y.from);
  Scale& narrow = x_unit < y_unit ? x : y;
  const double more =
      0.5 * (narrow.high - narrow.low) * (std::max(x_unit, y_unit) / std::min(x_unit, y_unit) - 1.0);
  narrow.low -= more;
  narrow.high += more;
}

std::vector<double> ticks_of(const Scale& scale) {
  std::vector<double> ticks;
  if (scale.logarithmic) {
    const bool few = scale.high - scale.low > 2.5;
    for (double decade = std::floor(scale.low); decade <= scale.high; decade += 1.0) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double v = decade + std::log10(digit);
        if (v > scale.low && v < scale.high && (digit == 1.0 || !few)) ticks.push_back(std::pow(10.0, v));
      }
    }
    return ticks;
  }
  const double rough = (scale.high - scale.low) / 5.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough / decade > 5.0 ? 10.0 : rough / decade > 2.0 ? 5.0 : 2.0);
  for (double v = std::ceil(scale.low / step) * step; v < scale.high; v += step)
    ticks.push_back(std::abs(v) < 1e-9 * step ? 0.0 : v);
  return ticks;
}

std::string colour_of(const Series& series) {
  if (series.colour < 0) return "#888888";
  return std::string(kPalette[static_cast<std::size_t>(series.colour) % kPalette.size()]);
}

std::string mark_at(Mark mark, double x, double y, const std::string& colour) {
  switch (mark) {
    case Mark::none:
      return "";
    case Mark::dot:
      return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.4' fill='{}'/>\n", x, y, colour);
    case Mark::ring:
      return fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='3.8' fill='white' stroke='{}' stroke-width='1.6'/>\n", x, y,
          colour);
    case Mark::cross:
      return fmt::format(
          "<path d='M{0:.1f} {1:.1f}l8 8m0-8l-8 8' stroke='{2}' stroke-width='2' fill='none'/>\n", x - 4.0,
          y - 4.0, colour);
  }
  return "";
}

std::string text_at(double x, double y, std::string_view anchor, std::string_view more,
                    std::string_view text) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'{}>{}</text>\n", x, y, anchor, more,
                     io::escaped_markup(text));
}

std::string axes(const Chart& chart, const Scale& x, const Scale& y) {
  std::string out;
  for (const double tick : ticks_of(x)) {
    out += fmt::format("<path d='M{0:.1f} {1:.1f}V{2:.1f}' stroke='#e4e4e4'/>\n", x.at(tick), y.from, y.to);
    out += text_at(x.at(tick), y.from + 15.0, "middle", "", fmt::format("{:g}", tick));
  }
  std::size_t longest = 0;
  for (const double tick : ticks_of(y)) {
    longest = std::max(longest, fmt::format("{:g}", tick).size());
    out += fmt::format("<path d='M{0:.1f} {1:.1f}H{2:.1f}' stroke='#e4e4e4'/>\n", x.from, y.at(tick), x.to);
    out += text_at(x.from - 6.0, y.at(tick) + 4.0, "end", "", fmt::format("{:g}", tick));
  }
  out +=
      fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' stroke='#444'/>\n",
                  x.from, y.to, x.to - x.from, y.from - y.to);
  const double middle = 0.5 * (y.from + y.to);
  out += text_at(0.5 * (x.from + x.to), y.to - 12.0, "middle", " font-weight='bold'", chart.title);
  out += text_at(0.5 * (x.from + x.to), y.from + 33.0, "middle", "", chart.x.label);
  const double beside = x.from - (longest > 5 ? 52.0 : 46.0);
  out += text_at(beside, middle, "middle",
                 fmt::format(" transform='rotate(-90 {:.1f} {:.1f})'", beside, middle), chart.y.label);
  return out;
}

std::string drawn(const Series& series, const Scale& x, const Scale& y) {
  const std::string colour = colour_of(series);
  std::string path;
  std::string marks;
  for (const auto& point : series.points) {
    if (!x.shows(point[0]) || !y.shows(point[1])) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(point[0]), y.at(point[1]));
    marks += mark_at(series.mark, x.at(point[0]), y.at(point[1]), colour);
  }
  if (!series.label.empty() && !series.points.empty()) {
    const auto& last = series.points.back();
    marks += text_at(x.at(last[0]) + 7.0, y.at(last[1]) + 4.0, "start", fmt::format(" fill='{}'", colour),
                     series.label);
  }
  if (!series.line || path.empty()) return marks;
  return fmt::format("<path d='{}' fill='none' stroke='{}' {}/>\n", path, colour,
                     series.broken ? "stroke-dasharray='5 4'" : "stroke-width='1.6'") +
         marks;
}

std::string legend(const Chart& chart, double left, double top) {
  std::string out;
  for (const Series& series : chart.series) {
    if (series.name.empty()) continue;
    const std::string colour = colour_of(series);
    if (series.line)
      out += fmt::format("<path d='M{:.1f} {:.1f}h22' stroke='{}' stroke-width='1.6'/>\n", left, top, colour);
    out += mark_at(series.mark, left + 11.0, top, colour);
    out += text_at(left + 28.0, top + 4.0, "start", "", series.name);
    top += kLegendRow;
  }
  return out;
}

}  // namespace

std::string svg(const std::vector<Chart>& charts) {
  std::size_t names = 0;
  double right = kRight;
  for (const Chart& chart : charts) {
    for (const Series& series : chart.series)
      if (!series.label.empty()) right = kRightOfLabels;
    names = std::max(names, static_cast<std::size_t>(
                                std::count_if(chart.series.begin(), chart.series.end(),
                                              [](const Series& series) { return !series.name.empty(); })));
  }
  const std::size_t columns = charts.size() > 3 ? 2 : charts.size();
  const std::size_t lines = (charts.size() + columns - 1) / columns;
  const double panel_width = kLeft + kPlotWidth + right;
  const double panel_height = kTop + kPlotHeight + kBottom + kLegendRow * static_cast<double>(names);
  const double width = panel_width * static_cast<double>(columns);
  const double height = panel_height * static_cast<double>(lines);
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}' "
      "font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n",
      width, height);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Chart& chart = charts[i];
    const double left = kLeft + panel_width * static_cast<double>(i % columns);
    const double top = kTop + panel_height * static_cast<double>(i / columns);
    Scale x = scale_of(chart, 0);
    Scale y = scale_of(chart, 1);
    x.from = left;
    x.to = left + kPlotWidth;
    y.from = top + kPlotHeight;
    y.to = top;
    if (chart.true_to_scale) make_true(x, y);
    out += axes(chart, x, y);
    for (const Series& series : chart.series) out += drawn(series, x, y);
    out += legend(chart, left, top + kPlotHeight + kBottom + 2.0);
  }
  return out + "</svg>\n";
}

}  // namespace endowire::drawing

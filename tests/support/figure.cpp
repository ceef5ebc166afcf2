#include "support/figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace endowire::test {

namespace {

// Sizes in pixels.
constexpr double kWidth = 560.0;
constexpr double kHeight = 340.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 100.0;  // labels of series are written there
constexpr double kTop = 52.0;
constexpr double kBottom = 52.0;
constexpr double kRing = 3.2;

const char* const kExact = "#2f6f9f";
const char* const kOurs = "#b8432a";
const char* const kText = "#333333";

std::string fixed(double value, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string result = text;
  return result.find_first_of("123456789") == std::string::npos && result.front() == '-' ? result.substr(1)
                                                                                         : result;
}

/// One direction of the picture: values to pixels, and where its ticks are.
struct Axis {
  double low = 0.0, high = 1.0;  ///< logarithms where it is logarithmic
  double from_px = 0.0, to_px = 1.0;
  bool logarithmic = false;

  [[nodiscard]] double value(double v) const { return logarithmic ? std::log10(v) : v; }
  [[nodiscard]] double px(double v) const {
    return from_px + (value(v) - low) / (high - low) * (to_px - from_px);
  }
  [[nodiscard]] double scale() const { return std::abs(to_px - from_px) / (high - low); }

  struct Tick {
    double at;
    std::string text;
  };
  [[nodiscard]] std::vector<Tick> ticks() const {
    std::vector<Tick> result;
    if (logarithmic) {
      constexpr double kFewDecades = 2.0;
      for (int e = static_cast<int>(std::floor(low)); e <= high; ++e) {
        for (const double m : {1.0, 2.0, 5.0}) {
          const double v = m * std::pow(10.0, e);
          if (value(v) < low || value(v) > high || (m > 1.0 && high - low > kFewDecades)) continue;
          char text[48];
          std::snprintf(text, sizeof text, "%g", v);
          result.push_back({v, text});
        }
      }
      return result;
    }
    constexpr double kMostTicks = 6.0;
    const double raw = (high - low) / kMostTicks;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10.0 * power;
    for (const double nice : {5.0, 2.0, 1.0})
      if (nice * power >= raw) step = nice * power;
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    for (double v = step * std::ceil(low / step - 1e-9); v <= high + 1e-9 * step; v += step)
      result.push_back({v, fixed(v, decimals)});
    return result;
  }
};

Axis fitted(const Figure& figure, bool across) {
  Axis axis;
  axis.logarithmic = across ? figure.log_x : figure.log_y;
  axis.from_px = across ? kLeft : kHeight - kBottom;
  axis.to_px = across ? kWidth - kRight : kTop;
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const Series& series : figure.series) {
    for (const PlanePoint& p : series.points) {
      const double v = axis.value(across ? p.x : p.y);
      if (!std::isfinite(v)) throw std::invalid_argument(figure.name + ": a value is not finite");
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(high > low)) throw std::invalid_argument(figure.name + ": nothing to draw");
  constexpr double kMargin = 0.04;
  axis.low = low - kMargin * (high - low);
  axis.high = high + kMargin * (high - low);
  return axis;
}

/// The axis with the larger scale is widened to that of the other.
void make_equal(Axis& a, Axis& b) {
  Axis& wide = a.scale() > b.scale() ? a : b;
  const double scale = std::min(a.scale(), b.scale());
  const double middle = 0.5 * (wide.low + wide.high);
  const double half = 0.5 * std::abs(wide.to_px - wide.from_px) / scale;
  wide.low = middle - half;
  wide.high = middle + half;
}

void write(std::ostringstream& out, double x, double y, const char* anchor, const char* colour,
           const std::string& text, const std::string& more = "") {
  out << "<text x=\"" << fixed(x, 1) << "\" y=\"" << fixed(y, 1) << "\" text-anchor=\"" << anchor
      << "\" fill=\"" << colour << "\"" << more << ">" << text << "</text>\n";
}

void draw_axes(std::ostringstream& out, const Figure& figure, const Axis& x, const Axis& y) {
  const double bottom = kHeight - kBottom;
  const double right = kWidth - kRight;
  for (const Axis::Tick& t : x.ticks()) {
    const std::string at = fixed(x.px(t.at), 1);
    out << "<path d=\"M" << at << "," << fixed(kTop, 1) << " V" << fixed(bottom, 1)
        << "\" stroke=\"#e6e6e6\" fill=\"none\"/>\n";
    write(out, x.px(t.at), bottom + 16.0, "middle", kText, t.text);
  }
  for (const Axis::Tick& t : y.ticks()) {
    out << "<path d=\"M" << fixed(kLeft, 1) << "," << fixed(y.px(t.at), 1) << " H" << fixed(right, 1)
        << "\" stroke=\"#e6e6e6\" fill=\"none\"/>\n";
    write(out, kLeft - 6.0, y.px(t.at) + 4.0, "end", kText, t.text);
  }
  out << "<rect x=\"" << fixed(kLeft, 1) << "\" y=\"" << fixed(kTop, 1) << "\" width=\""
      << fixed(right - kLeft, 1) << "\" height=\"" << fixed(bottom - kTop, 1)
      << "\" fill=\"none\" stroke=\"#999999\"/>\n";
  write(out, 0.5 * (kLeft + right), kHeight - 14.0, "middle", kText, figure.x_label);
  const std::string turned = " transform=\"rotate(-90 16 " + fixed(0.5 * (kTop + bottom), 1) + ")\"";
  write(out, 16.0, 0.5 * (kTop + bottom), "middle", kText, figure.y_label, turned);
  write(out, kLeft, 20.0, "start", kText, figure.title, " font-weight=\"bold\"");
  out << "<path d=\"M" << fixed(kLeft, 1) << ",36 h22\" stroke=\"" << kExact
      << "\" stroke-width=\"1.6\" fill=\"none\"/>\n";
  write(out, kLeft + 28.0, 40.0, "start", kText, "closed form");
  out << "<circle cx=\"" << fixed(kLeft + 120.0, 1) << "\" cy=\"36\" r=\"" << fixed(kRing, 1)
      << "\" fill=\"none\" stroke=\"" << kOurs << "\" stroke-width=\"1.3\"/>\n";
  write(out, kLeft + 130.0, 40.0, "start", kText, "endowire");
}

void draw_series(std::ostringstream& out, const Series& series, const Axis& x, const Axis& y) {
  const char* const colour = series.mark == Mark::rings ? kOurs : kExact;
  if (series.mark == Mark::rings) {
    for (const PlanePoint& p : series.points)
      out << "<circle cx=\"" << fixed(x.px(p.x), 1) << "\" cy=\"" << fixed(y.px(p.y), 1) << "\" r=\""
          << fixed(kRing, 1) << "\" fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.3\"/>\n";
  } else {
    out << "<path d=\"";
    for (std::size_t i = 0; i < series.points.size(); ++i)
      out << (i == 0 ? "M" : " L") << fixed(x.px(series.points[i].x), 1) << ","
          << fixed(y.px(series.points[i].y), 1);
    out << "\" fill=\"none\" stroke=\"" << (series.mark == Mark::guide ? "#999999" : colour)
        << (series.mark == Mark::guide ? "\" stroke-dasharray=\"5 4" : "\" stroke-width=\"1.6") << "\"/>\n";
  }
  if (series.label.empty()) return;
  const PlanePoint& last = series.points.back();
  write(out, x.px(last.x) + 7.0, y.px(last.y) + 4.0, "start", series.mark == Mark::guide ? "#777777" : colour,
        series.label);
}

}  // namespace

std::string svg(const Figure& figure) {
  Axis x = fitted(figure, true);
  Axis y = fitted(figure, false);
  if (figure.equal_axes) make_equal(x, y);
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << fixed(kWidth, 0) << " "
      << fixed(kHeight, 0) << "\" width=\"" << fixed(kWidth, 0) << "\" height=\"" << fixed(kHeight, 0)
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"white\"/>\n";
  draw_axes(out, figure, x, y);
  for (const Series& series : figure.series) draw_series(out, series, x, y);
  out << "</svg>\n";
  return out.str();
}

}  // namespace endowire::test

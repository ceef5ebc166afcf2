#include "endowire/io/instrument_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "endowire/io/instrument_facts.hpp"
#include "endowire/io/markup.hpp"

// The drawing, in pixels:
//
//   ┌───────────────────────────────────────────────┐
//   │ model, description                            │
//   │ ┌───────────────────┐  ┌────────────────────┐ │
//   │ │ EI, GJ            │  │ unloaded end       │ │
//   │ │ over the distance │  │ (and from above)   │ │
//   │ └───────────────────┘  └────────────────────┘ │
//   └───────────────────────────────────────────────┘

namespace endowire::io {

namespace {

constexpr double width = 1100.0;
constexpr double height = 520.0;
constexpr double margin = 28.0;
constexpr int samples = 400;
constexpr double flat_mm = 0.5;  // a shape that leaves its plane by less is drawn once
const char* const ink = "#1c2b39";
const char* const quiet_ink = "#5f7385";
const char* const bending_colour = "#00798c";
const char* const twisting_colour = "#e25822";

struct Box {
  double x, y, width, height;
};

std::string text_at(double x, double y, const std::string& content, int size, const char* anchor = "start",
                    const char* fill = quiet_ink) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", x, y,
      size, anchor, fill, escaped_markup(content));
}

std::string path(const std::vector<Eigen::Vector2d>& points, const char* colour, double stroke) {
  std::string d;
  for (const Eigen::Vector2d& p : points)
    d += fmt::format("{}{:.2f} {:.2f}", d.empty() ? "M" : "L", p.x(), p.y());
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"/>\n",
      d, colour, stroke);
}

/// Rigidities over the distance from the tip: both axes such that a soft tip is as large as a long shaft.
std::string profile(const rod::MaterialLine& line, const Box& box) {
  const std::vector<double> arcs = profile_arcs_mm(line, samples);
  std::vector<double> bending;
  std::vector<double> twisting;
  for (const double arc : arcs) {
    bending.push_back(line.flexural_rigidity_n_mm2(arc));
    twisting.push_back(line.torsional_rigidity_n_mm2(arc));
  }
  double low = HUGE_VAL;
  double high = 0.0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    low = std::min({low, bending[i], twisting[i]});
    high = std::max({high, bending[i], twisting[i]});
  }
  low = std::pow(10.0, std::floor(std::log10(low)));
  high = std::pow(10.0, std::ceil(std::log10(high)));
  const auto x = [&](double arc) { return box.x + box.width * std::sqrt(arc / line.length_mm()); };
  const auto y = [&](double value) {
    return box.y + box.height * std::log(high / value) / std::log(high / low);
  };
  std::string out;
  for (double level = low; level < 1.01 * high; level *= 10.0) {
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#d7dee4\"/>\n",
                       box.x, box.x + box.width, y(level), y(level));
    out += text_at(box.x - 6.0, y(level) + 4.0, fmt::format("{:g}", level), 12, "end");
  }
  for (const double tick : {0.0, 10.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0}) {
    if (tick > line.length_mm()) break;
    out += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#d7dee4\"/>\n", x(tick),
        box.y, box.y + box.height);
    out += text_at(x(tick), box.y + box.height + 17.0, fmt::format("{:g}", tick), 12, "middle");
  }
  const auto curve = [&](const std::vector<double>& values) {
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < arcs.size(); ++i) points.emplace_back(x(arcs[i]), y(values[i]));
    return points;
  };
  out += path(curve(twisting), twisting_colour, 2.0) + path(curve(bending), bending_colour, 3.0);
  out += text_at(box.x, box.y - 10.0, "EI", 14, "start", bending_colour);
  out += text_at(box.x + 26.0, box.y - 10.0, "GJ", 14, "start", twisting_colour);
  out += text_at(box.x + 52.0, box.y - 10.0, "N mm\u00b2", 14);
  out += text_at(box.x + 0.5 * box.width, box.y + box.height + 38.0, "mm from the tip", 13, "middle");
  return out;
}

/// One view of the unloaded end; `up` is the axis that is drawn upwards.
std::string shape(const rod::MaterialLine& line, const std::vector<Eigen::Vector3d>& joints, int up,
                  const Box& box, const std::string& caption) {
  const auto flat = [&](const Eigen::Vector3d& p) { return Eigen::Array2d(p.x(), p[up]); };
  Eigen::Array2d low = flat(joints.front());
  Eigen::Array2d high = low;
  for (const Eigen::Vector3d& p : joints) {
    low = low.min(flat(p));
    high = high.max(flat(p));
  }
  const double radius_mm = line.radius_mm(0.0);
  low -= radius_mm;
  high += radius_mm;
  const double px = std::min(box.width / (high - low).x(), box.height / (high - low).y());
  const Eigen::Array2d corner(box.x + 0.5 * (box.width - px * (high - low).x()),
                              box.y + 0.5 * (box.height + px * (high - low).y()));
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3d& p : joints) {
    const Eigen::Array2d at = px * (flat(p) - low);
    points.emplace_back(corner.x() + at.x(), corner.y() - at.y());
  }
  std::string out = path(points, ink, std::max(2.0 * radius_mm * px, 1.5));
  out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#c2185b\"/>\n", points.front().x(),
                     points.front().y());
  double bar_mm = 1.0;
  for (const double longer : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (longer * px <= 0.3 * box.width) bar_mm = longer;
  const double bar_y = box.y + box.height + 26.0;
  out += path({{box.x + box.width - bar_mm * px, bar_y}, {box.x + box.width, bar_y}}, quiet_ink, 2.0);
  out += text_at(box.x + box.width, bar_y + 17.0, fmt::format("{:g} mm", bar_mm), 12, "end");
  return out + text_at(box.x, box.y - 10.0, caption, 14);
}

}  // namespace

std::string instrument_picture_svg(const InstrumentFile& file) {
  const rod::MaterialLine line(file.instrument);
  const std::vector<Eigen::Vector3d> joints = unloaded_end_mm(line);
  double off_plane_mm = 0.0;
  for (const Eigen::Vector3d& p : joints) off_plane_mm = std::max(off_plane_mm, std::abs(p.z()));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width, height);
  svg += text_at(margin, 42.0, file.instrument.model, 24, "start", ink);
  svg += text_at(margin, 68.0, file.description, 14);
  constexpr double top = 120.0;
  constexpr double inner = height - top - 64.0;
  svg += profile(line, {margin + 40.0, top, 440.0, inner});
  const Box right{600.0, top, width - 600.0 - margin, inner - 16.0};
  if (off_plane_mm < flat_mm) {
    svg += shape(line, joints, 1, right, "unloaded end");
  } else {
    const double half = 0.5 * (right.height - 70.0);
    svg += shape(line, joints, 1, {right.x, right.y, right.width, half}, "unloaded end, from the front");
    svg += shape(line, joints, 2, {right.x, right.y + half + 70.0, right.width, half}, "from above");
  }
  return svg + "</svg>\n";
}

}  // namespace endowire::io

#include "endowire/io/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/io/canvas.hpp"
#include "endowire/io/lumen_shading.hpp"
#include "endowire/io/png.hpp"
#include "endowire/io/view.hpp"

// The sheet, in pixels:
//
//   ┌────────────┬─────────┬────────────┐
//   │ front      │ side    │ above      │
//   │            │         │            │
//   │            │         ├────────────┤
//   │            │         │ legend     │
//   └────────────┴─────────┴────────────┘

namespace endowire::io {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double margin = 30.0;  // around each view: numbers of ends lie in it
constexpr double most_wide = 1600.0;
constexpr double most_high = 1000.0;
constexpr int legend_width = 320;
constexpr int legend_height = 150;
constexpr int letter = 2;  // pixels of the font's dots

// The palette: glass by its opacity, then the scale of radii, then single colours.
constexpr int glass_steps = 160;
constexpr int scale_steps = 80;
constexpr std::uint8_t ink = 250;
constexpr std::uint8_t white = 251;
constexpr std::uint8_t mark = 252;
constexpr std::uint8_t rule = 253;

using Rgb = std::array<double, 3>;

Rgb mix(const Rgb& a, const Rgb& b, double f) {
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])};
}

/// Blue for narrow over green and amber to red for wide, all dark enough for glass and white.
Rgb scale_colour(double f) {
  constexpr std::array<Rgb, 4> stops{{{32, 60, 170}, {0, 140, 110}, {225, 150, 20}, {190, 20, 40}}};
  const double place = std::clamp(f, 0.0, 1.0) * 3.0;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), 2);
  return mix(stops[i], stops[i + 1], place - static_cast<double>(i));
}

void set_palette(IndexedImage& image) {
  const auto put = [&](std::size_t i, const Rgb& c) {
    for (std::size_t k = 0; k < 3; ++k) image.palette[i][k] = static_cast<std::uint8_t>(std::lround(c[k]));
    image.palette[i][3] = 255;
  };
  for (std::size_t i = 0; i < glass_steps; ++i)
    put(i, mix({255, 255, 255}, {84, 116, 146}, static_cast<double>(i) / (glass_steps - 1)));
  for (std::size_t i = 0; i < scale_steps; ++i)
    put(glass_steps + i, scale_colour(static_cast<double>(i) / (scale_steps - 1)));
  put(ink, {28, 43, 57});
  put(white, {255, 255, 255});
  put(mark, {194, 24, 91});
  put(rule, {217, 224, 230});
}

struct Panel {
  View view;
  const char* caption;
  double x = 0.0;
  double y = 0.0;
  double px_per_mm = 1.0;

  [[nodiscard]] Vector2d place(const Vector3d& point_mm) const {
    const Vector2d flat = view.project_mm(point_mm) - view.corner_mm;
    return {x + px_per_mm * flat.x(), y + px_per_mm * (view.extent_mm.y() - flat.y())};
  }
  [[nodiscard]] int width() const { return static_cast<int>(std::ceil(px_per_mm * view.extent_mm.x())); }
  [[nodiscard]] int height() const { return static_cast<int>(std::ceil(px_per_mm * view.extent_mm.y())); }
};

View view_of(const vessel::TriangleMesh& mesh, const Vector3d& right, const Vector3d& up) {
  View view;
  view.right = right;
  view.up = up;
  Vector2d low = Vector2d::Constant(1e300);
  Vector2d high = -low;
  for (const Vector3d& v : mesh.vertices_mm) {
    low = low.cwiseMin(view.project_mm(v));
    high = high.cwiseMax(view.project_mm(v));
  }
  view.corner_mm = low;
  view.extent_mm = (high - low).cwiseMax(1e-3);
  return view;
}

/// Radii of all points: the scale of colours, by the logarithm.
struct RadiusScale {
  double low_mm = 1.0;
  double high_mm = 2.0;

  [[nodiscard]] std::uint8_t colour(double radius_mm) const {
    const double part = std::log(std::max(radius_mm, low_mm) / low_mm) / std::log(high_mm / low_mm);
    return static_cast<std::uint8_t>(glass_steps +
                                     std::lround(std::clamp(part, 0.0, 1.0) * (scale_steps - 1)));
  }
};

RadiusScale scale_of(const vessel::CentrelineTree& tree) {
  std::vector<double> radii;
  for (const vessel::CentrelinePoint& point : tree.points()) radii.push_back(point.radius_mm);
  if (radii.empty()) return {};
  std::sort(radii.begin(), radii.end());
  RadiusScale scale;
  scale.low_mm = std::max(0.05, radii[radii.size() / 50]);
  scale.high_mm = std::max(1.1 * scale.low_mm, radii[radii.size() - 1 - radii.size() / 50]);
  return scale;
}

void draw_glass(Canvas& canvas, const Panel& panel, const vessel::TriangleMesh& mesh) {
  const IndexedImage glass = shade_lumen(mesh, panel.view, panel.width(), panel.height());
  for (int y = 0; y < glass.height; ++y)
    for (int x = 0; x < glass.width; ++x) {
      const int opacity = glass.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(glass.width) +
                                       static_cast<std::size_t>(x)];
      if (opacity > 0)
        canvas.set(static_cast<int>(panel.x) + x, static_cast<int>(panel.y) + y,
                   static_cast<std::uint8_t>(opacity * (glass_steps - 1) / 255));
    }
}

void draw_lines(Canvas& canvas, const Panel& panel, const vessel::CentrelineTree& tree,
                const RadiusScale& scale) {
  for (std::size_t b = 0; b < tree.branches().size(); ++b) {
    const auto points = tree.points_of(static_cast<std::int32_t>(b));
    for (std::size_t i = 1; i < points.size(); ++i)
      canvas.line(panel.place(points[i - 1].position_mm), panel.place(points[i].position_mm), 3.0,
                  scale.colour(0.5 * (points[i - 1].radius_mm + points[i].radius_mm)));
  }
}

void draw_ends(Canvas& canvas, const Panel& panel, const std::vector<vessel::VesselEnd>& ends) {
  for (const vessel::VesselEnd& end : ends) {
    const Vector2d at = panel.place(end.centre_mm);
    canvas.disc(at, 5.0, mark);
    if (!end.open) canvas.disc(at, 2.5, white);
  }
  for (const vessel::VesselEnd& end : ends) {  // the numbers lie over all marks, outward of their own
    const std::string number = fmt::format("{}", end.number);
    const Vector2d flat(panel.view.right.dot(end.direction), -panel.view.up.dot(end.direction));
    const Vector2d away = flat.norm() > 0.2 ? Vector2d(flat.normalized()) : Vector2d(0.7, -0.7);
    const Vector2d middle = panel.place(end.centre_mm) + 17.0 * away;
    const int width = Canvas::text_width(number, letter);
    const int x = static_cast<int>(middle.x()) - width / 2;
    const int y = static_cast<int>(middle.y()) - 7;
    canvas.rectangle(x - 2, y - 2, width + 4, 7 * letter + 4, white);
    canvas.text(x, y, number, letter, mark);
  }
}

void draw_legend(Canvas& canvas, int x, int y, double px_per_mm, const RadiusScale& scale) {
  constexpr int bar = 240;
  canvas.text(x, y, "radius of the lumen mm", letter, ink);
  for (int i = 0; i < bar; ++i)
    canvas.rectangle(x + i, y + 22, 1, 12,
                     static_cast<std::uint8_t>(glass_steps + i * (scale_steps - 1) / (bar - 1)));
  const std::string middle = fmt::format("{:.2g}", std::sqrt(scale.low_mm * scale.high_mm));
  const std::string high = fmt::format("{:.2g}", scale.high_mm);
  canvas.text(x, y + 40, fmt::format("{:.2g}", scale.low_mm), letter, ink);
  canvas.text(x + bar / 2 - Canvas::text_width(middle, letter) / 2, y + 40, middle, letter, ink);
  canvas.text(x + bar - Canvas::text_width(high, letter), y + 40, high, letter, ink);
  double length_mm = std::pow(10.0, std::floor(std::log10(bar / px_per_mm)));
  for (const double factor : {5.0, 2.0})
    if (factor * length_mm * px_per_mm <= bar) {
      length_mm *= factor;
      break;
    }
  const int length = static_cast<int>(length_mm * px_per_mm);
  canvas.rectangle(x, y + 84, length, 3, ink);
  canvas.rectangle(x, y + 79, 2, 13, ink);
  canvas.rectangle(x + length - 2, y + 79, 2, 13, ink);
  canvas.text(x, y + 98, fmt::format("{:g} mm", length_mm), letter, ink);
}

}  // namespace

std::string contact_sheet_png(const vessel::TriangleMesh& mesh, const vessel::CentrelineTree& tree,
                              const std::vector<vessel::VesselEnd>& ends) {
  const Vector3d root = tree.points().empty() ? Vector3d::Zero() : tree.points().front().position_mm;
  const Directions directions = directions_of(vessel::bounds_mm(mesh), root, Vector3d::Zero());
  const Vector3d right = directions.forward.cross(directions.up);
  std::array<Panel, 3> panels{{{view_of(mesh, right, directions.up), "front"},
                               {view_of(mesh, directions.forward, directions.up), "side"},
                               {view_of(mesh, right, directions.forward), "above"}}};
  const double wide =
      panels[0].view.extent_mm.x() + panels[1].view.extent_mm.x() + panels[2].view.extent_mm.x();
  const double high = std::max(panels[0].view.extent_mm.y(), panels[2].view.extent_mm.y());
  const double px_per_mm = std::min((most_wide - 6.0 * margin) / wide, (most_high - 3.0 * margin) / high);
  double x = margin;
  for (Panel& panel : panels) {
    panel.px_per_mm = px_per_mm;
    panel.x = std::floor(x);
    panel.y = 2.0 * margin;
    x += panel.width() + 2.0 * margin;
  }
  const Panel& above = panels[2];
  const int width = static_cast<int>(std::max(x, above.x + legend_width));
  const int legend_y = static_cast<int>(above.y + above.height() + 2.0 * margin);
  const int height =
      std::max(static_cast<int>(panels[0].y + panels[0].height() + margin), legend_y + legend_height);
  Canvas canvas(width, height, white);
  set_palette(canvas.image());
  const RadiusScale scale = scale_of(tree);
  for (const Panel& panel : panels) {
    draw_glass(canvas, panel, mesh);
    draw_lines(canvas, panel, tree, scale);
    draw_ends(canvas, panel, ends);
    canvas.text(static_cast<int>(panel.x), 10, panel.caption, letter, ink);
    if (panel.x > margin) canvas.rectangle(static_cast<int>(panel.x - margin), 0, 1, height, rule);
  }
  draw_legend(canvas, static_cast<int>(above.x), legend_y, px_per_mm, scale);
  return encode_png(canvas.image());
}

}  // namespace endowire::io

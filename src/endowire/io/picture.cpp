#include "endowire/io/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "endowire/io/base64.hpp"
#include "endowire/io/lumen_shading.hpp"
#include "endowire/io/markup.hpp"
#include "endowire/io/png.hpp"
#include "endowire/io/view.hpp"

// The drawing, in pixels:
//
//   ┌──────────────────────────────────────────────────────────┐
//   │ title, subtitle                                          │
//   │ ┌────────────┐ ┌───────┐ ┌──────────┐ ┌──────────┐       │
//   │ │            │ │       │ │ tip,     │ │ tip,     │       │
//   │ │  front     │ │ side  │ │ front    │ │ side     │       │
//   │ │  (x, z)    │ │ (y,z) │ └──────────┘ └──────────┘       │
//   │ │            │ │       │  colour scale                   │
//   │ │            │ │       │  numbers      force / insertion │
//   │ └────────────┘ └───────┘                                 │
//   └──────────────────────────────────────────────────────────┘

namespace endowire::io {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using sim::Snapshot;
using sim::SnapshotPoint;

constexpr double margin = 36.0;
constexpr double gap = 16.0;
constexpr double top = 104.0;
constexpr double panel_height = 900.0;
constexpr double close_up = 300.0;        // side of a magnified view
constexpr double close_up_mm = 40.0;      // of vessel in it
constexpr double overview_width = 560.0;  // of both overviews at least
constexpr double least_wire_px = 2.0;
constexpr double sample_scale = 2.0;  // image pixels per pixel of the drawing
const char* const ink = "#1c2b39";
const char* const quiet_ink = "#5f7385";
const char* const accent = "#c2185b";

struct Panel {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  View view;
  std::string caption;
  std::array<std::string, 2> axes;  // names of right and up
  bool magnified = false;

  [[nodiscard]] double px_per_mm() const { return width / view.extent_mm.x(); }
  [[nodiscard]] Vector2d place(const Vector3d& point_mm) const {
    const Vector2d flat = view.project_mm(point_mm) - view.corner_mm;
    return {x + flat.x() * px_per_mm(), y + height - flat.y() * px_per_mm()};
  }
};

struct Colour {
  double r, g, b;
};

/// Where a force lies on the colour scale, 0 … 1: by its square root, for contacts are few and most are
/// slight.
double scale_position(double force, double full_scale) {
  if (!std::isfinite(force)) return 1.0;
  return std::sqrt(std::clamp(force / full_scale, 0.0, 1.0));
}

/// Dark ink where nothing presses, then blue-green, amber and red: readable on grey-blue, and in grey.
/// @param position  0 … 1
Colour scale_colour(double position) {
  constexpr std::array<Colour, 5> stops{
      {{28, 43, 57}, {0, 121, 140}, {237, 174, 73}, {226, 88, 34}, {170, 14, 60}}};
  const double place = position * static_cast<double>(stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double f = place - static_cast<double>(i);
  const auto mix = [f](double a, double b) { return a + f * (b - a); };
  return {mix(stops[i].r, stops[i + 1].r), mix(stops[i].g, stops[i + 1].g), mix(stops[i].b, stops[i + 1].b)};
}

std::string css(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(std::lround(colour.r)),
                     static_cast<int>(std::lround(colour.g)), static_cast<int>(std::lround(colour.b)));
}

/// The smallest of 1, 2, 5 times a power of ten that is >= value.
double nice_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

/// The largest of 1, 2, 5 times a power of ten that is <= value.
double nice_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

/// A light rim that keeps a label readable on dark ground.
const char* const halo =
    "paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3.5\" stroke-linejoin=\"round\"";

class Svg {
 public:
  void add(const std::string& element) { body_ += element + '\n'; }
  void text(double x, double y, const std::string& content, double size, const std::string& fill,
            const std::string& more = "") {
    add(fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"{}\" {}>{}</text>", x, y, size,
                    fill, more, escaped_markup(content)));
  }
  void line(const Vector2d& a, const Vector2d& b, const std::string& stroke, double width,
            const std::string& more = "") {
    add(
        fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
                    "stroke-width=\"{}\" {}/>",
                    a.x(), a.y(), b.x(), b.y(), stroke, width, more));
  }
  [[nodiscard]] std::string document(double width, double height) const {
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
               "viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
               "font-family=\"'DejaVu Sans', 'Helvetica Neue', Arial, sans-serif\">\n"
               "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
               width, height) +
           body_ + "</svg>\n";
  }

 private:
  std::string body_;
};

/// The part of the wire that is drawn: from the tip to the end of the sheath, and a little of the sheath
/// behind it.
std::vector<SnapshotPoint> wire_in_vessel(const Snapshot& snapshot) {
  std::vector<SnapshotPoint> points;
  for (const SnapshotPoint& point : snapshot.points)
    if (point.position_mm.allFinite()) points.push_back(point);
  return points;
}

double largest_force(const std::vector<SnapshotPoint>& points) {
  double largest = 0.0;
  for (const SnapshotPoint& point : points)
    if (std::isfinite(point.wall_force_n_per_mm)) largest = std::max(largest, point.wall_force_n_per_mm);
  return largest;
}

void draw_wire(Svg& svg, const Panel& panel, const std::vector<SnapshotPoint>& points, double full_scale) {
  if (points.size() < 2) return;
  const double true_px = 2.0 * points.front().radius_mm * panel.px_per_mm();
  const double width = std::max(true_px, least_wire_px) + (panel.magnified ? 0.0 : 0.8);
  std::string outline;
  for (const SnapshotPoint& point : points) {
    const Vector2d at = panel.place(point.position_mm);
    outline += fmt::format("{}{:.2f} {:.2f}", outline.empty() ? "M" : "L", at.x(), at.y());
  }
  svg.add(fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"#ffffff\" stroke-opacity=\"0.85\" stroke-width=\"{:.2f}\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\"/>",
      outline, width + 2.4));
  // From the sheath to the tip, so that the tip lies on top where the wire crosses itself.
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    const double force = 0.5 * (points[i].wall_force_n_per_mm + points[i - 1].wall_force_n_per_mm);
    svg.line(panel.place(points[i].position_mm), panel.place(points[i - 1].position_mm),
             css(scale_colour(scale_position(force, full_scale))), std::round(width * 100.0) / 100.0,
             "stroke-linecap=\"round\"");
  }
}

void draw_lumen(Svg& svg, const Panel& panel, const vessel::TriangleMesh& mesh) {
  const int width = static_cast<int>(std::lround(panel.width * sample_scale));
  const int height = static_cast<int>(std::lround(panel.height * sample_scale));
  svg.add(
      fmt::format("<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                  "xlink:href=\"data:image/png;base64,{}\"/>",
                  panel.x, panel.y, panel.width, panel.height,
                  base64(encode_png(shade_lumen(mesh, panel.view, width, height)))));
}

void draw_scale_bar(Svg& svg, const Panel& panel) {
  const double length_mm = nice_below(0.3 * panel.view.extent_mm.x());
  const Vector2d right(panel.x + panel.width - 16.0, panel.y + panel.height - 18.0);
  const Vector2d left = right - Vector2d(length_mm * panel.px_per_mm(), 0.0);
  for (const bool rim : {true, false}) {
    const char* const stroke = rim ? "#ffffff" : ink;
    const double width = rim ? 5.0 : 2.0;
    svg.line(left, right, stroke, width);
    svg.line(left - Vector2d(0, 4), left + Vector2d(0, 4), stroke, width);
    svg.line(right - Vector2d(0, 4), right + Vector2d(0, 4), stroke, width);
  }
  svg.text(0.5 * (left.x() + right.x()), right.y() - 8.0, fmt::format("{:g} mm", length_mm), 12, ink,
           fmt::format("text-anchor=\"middle\" {}", halo));
}

void draw_axes(Svg& svg, const Panel& panel) {
  const Vector2d origin(panel.x + 18.0, panel.y + panel.height - 18.0);
  svg.line(origin, origin + Vector2d(22, 0), quiet_ink, 1.2, "marker-end=\"url(#arrow)\"");
  svg.line(origin, origin - Vector2d(0, 22), quiet_ink, 1.2, "marker-end=\"url(#arrow)\"");
  svg.text(origin.x() + 31.0, origin.y() + 4.0, panel.axes[0], 12, quiet_ink, halo);
  svg.text(origin.x(), origin.y() - 31.0, panel.axes[1], 12, quiet_ink,
           fmt::format("text-anchor=\"middle\" {}", halo));
}

/// A label `away` pixels beside a mark, on the side that has more room.
void label(Svg& svg, const Panel& panel, const Vector2d& at, double away, const std::string& text,
           const char* colour) {
  const bool left = at.x() > panel.x + 0.72 * panel.width;
  svg.text(at.x() + (left ? -away : away), at.y() + 4.5, text, 13, colour,
           fmt::format("font-weight=\"bold\" text-anchor=\"{}\" {}", left ? "end" : "start", halo));
}

void draw_marks(Svg& svg, const Panel& panel, const std::vector<SnapshotPoint>& points,
                const sim::Access& access, const View* magnified) {
  if (!panel.magnified) {
    const Vector2d at = panel.place(access.position_mm);
    const Vector2d flat(panel.view.right.dot(access.direction), -panel.view.up.dot(access.direction));
    const Vector2d along = flat.norm() > 1e-6 ? Vector2d(flat.normalized()) : Vector2d(0.0, -1.0);
    const Vector2d across(-along.y(), along.x());
    const Vector2d tail = at - 15.0 * along;
    const Vector2d a = at - 1.0 * along;
    const Vector2d b = tail + 6.5 * across;
    const Vector2d c = tail - 6.5 * across;
    svg.add(fmt::format(
        "<polygon points=\"{:.2f},{:.2f} {:.2f},{:.2f} {:.2f},{:.2f}\" fill=\"{}\" stroke=\"#ffffff\" "
        "stroke-width=\"1.2\"/>",
        a.x(), a.y(), b.x(), b.y(), c.x(), c.y(), ink));
    label(svg, panel, tail, 12.0, "access", ink);
  }
  if (points.empty()) return;
  const Vector2d tip = panel.place(points.front().position_mm);
  const double radius =
      panel.magnified ? std::max(5.0, points.front().radius_mm * panel.px_per_mm() + 4.0) : 6.5;
  svg.add(fmt::format(
      "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>",
      tip.x(), tip.y(), radius, accent));
  if (magnified == nullptr) return label(svg, panel, tip, radius + 6.0, "tip", accent);
  const double scale = panel.px_per_mm();
  const Vector2d corner = magnified->corner_mm - panel.view.corner_mm;
  const double frame_x = panel.x + corner.x() * scale;
  const double frame_width = magnified->extent_mm.x() * scale;
  svg.add(fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"{}\" "
      "stroke-width=\"1\" stroke-dasharray=\"4 3\"/>",
      frame_x, panel.y + panel.height - (corner.y() + magnified->extent_mm.y()) * scale, frame_width,
      magnified->extent_mm.y() * scale, quiet_ink));
  label(svg, panel, tip, 0.5 * frame_width + 7.0, "tip", accent);
}

void draw_panel(Svg& svg, const Panel& panel, const vessel::TriangleMesh& mesh,
                const std::vector<SnapshotPoint>& points, const sim::Access& access, double full_scale,
                const View* magnified) {
  const std::string clip = fmt::format("clip{:.0f}x{:.0f}", panel.x, panel.y);
  const std::string frame =
      fmt::format("x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"8\"", panel.x, panel.y,
                  panel.width, panel.height);
  svg.add(fmt::format("<clipPath id=\"{}\"><rect {}/></clipPath>", clip, frame));
  svg.add(fmt::format("<rect {} fill=\"#f6f8fa\" stroke=\"#d9e0e6\"/>", frame));
  svg.add(fmt::format("<g clip-path=\"url(#{})\">", clip));
  draw_lumen(svg, panel, mesh);
  draw_wire(svg, panel, points, full_scale);
  draw_marks(svg, panel, points, access, magnified);
  draw_axes(svg, panel);
  draw_scale_bar(svg, panel);
  svg.add("</g>");
  svg.text(panel.x + 14.0, panel.y + 24.0, panel.caption, 13, quiet_ink, halo);
}

void draw_colour_scale(Svg& svg, double x, double y, double width, double full_scale) {
  svg.text(x, y, "Wall force on the wire, N/mm", 13, ink, "font-weight=\"bold\"");
  std::string stops;
  for (int i = 0; i <= 16; ++i)
    stops += fmt::format("<stop offset=\"{}%\" stop-color=\"{}\"/>", i * 6.25, css(scale_colour(i / 16.0)));
  svg.add("<linearGradient id=\"scale\">" + stops + "</linearGradient>");
  svg.add(fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"12\" rx=\"3\" fill=\"url(#scale)\"/>", x,
      y + 12.0, width));
  for (const double part : {0.0, 0.05, 0.2, 0.5, 1.0}) {
    const double at = x + width * scale_position(part, 1.0);
    const char* const anchor = part == 0.0 ? "start" : (part == 1.0 ? "end" : "middle");
    svg.text(at, y + 41.0, fmt::format("{:.6g}", full_scale * part), 12, quiet_ink,
             fmt::format("text-anchor=\"{}\"", anchor));
    if (part > 0.0 && part < 1.0) svg.line({at, y + 24.0}, {at, y + 28.0}, quiet_ink, 1.0);
  }
}

void draw_numbers(Svg& svg, double x, double y, double width, const std::vector<HeadlineNumber>& numbers) {
  for (const HeadlineNumber& number : numbers) {
    svg.text(x, y, number.label, 13, quiet_ink);
    svg.text(x + width, y, number.value, 14, ink, "font-weight=\"bold\" text-anchor=\"end\"");
    svg.line({x, y + 9.0}, {x + width, y + 9.0}, "#e4eaef", 1.0);
    y += 29.0;
  }
}

void draw_force_curve(Svg& svg, double x, double y, double width, double height,
                      const std::vector<ForcePoint>& forces) {
  double low = 0.0;
  double high = 0.0;
  double longest = 0.0;
  for (const ForcePoint& point : forces) {
    low = std::min(low, point.push_force_n);
    high = std::max(high, point.push_force_n);
    longest = std::max(longest, point.inserted_mm);
  }
  if (!(longest > 0.0) || !(high - low > 0.0)) return;
  if (low > -0.02 * high) low = 0.0;  // a trace of pull needs no room of its own
  svg.text(x, y, "Push force over inserted length", 13, ink, "font-weight=\"bold\"");
  const double step_n = nice_above((high - low) / 5.0);
  const double first = std::floor(low / step_n);
  const double last = std::max(first + 1.0, std::ceil(high / step_n));
  const double left = x + 44.0;
  const double right = x + width - 6.0;
  const double above = y + 18.0;
  const double below = y + height - 34.0;
  const auto at_y = [&](double force) {
    return below - (force / step_n - first) / (last - first) * (below - above);
  };
  const double step_mm = nice_above(longest / 5.5);
  const auto at_x = [&](double length) { return left + length / longest * (right - left); };
  const int lines = static_cast<int>(std::lround(last - first));
  for (int i = 0; i <= lines; ++i) {
    const double force = (first + i) * step_n;
    svg.line({left, at_y(force)}, {right, at_y(force)}, force == 0.0 ? "#9fb0be" : "#e4eaef", 1.0);
    svg.text(left - 8.0, at_y(force) + 4.0, fmt::format("{:.6g}", force), 12, quiet_ink,
             "text-anchor=\"end\"");
  }
  const int marks = static_cast<int>(std::floor(longest / step_mm));
  for (int i = 0; i <= marks; ++i)
    svg.text(at_x(i * step_mm), below + 18.0, fmt::format("{:g}", i * step_mm), 12, quiet_ink,
             "text-anchor=\"middle\"");
  svg.text(right, y + height, "inserted, mm", 12, quiet_ink, "text-anchor=\"end\"");
  svg.text(left, y + height, "N", 12, quiet_ink, "text-anchor=\"end\" dx=\"-8\"");
  // At most a thousand points: thinned, keeping the largest force of each stretch.
  const std::size_t stride = forces.size() / 1000 + 1;
  std::string path;
  for (std::size_t i = 0; i < forces.size(); i += stride) {
    const auto begin = forces.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = forces.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, forces.size()));
    const ForcePoint& point = *std::max_element(begin, end, [](const ForcePoint& a, const ForcePoint& b) {
      return std::abs(a.push_force_n) < std::abs(b.push_force_n);
    });
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at_x(std::max(0.0, point.inserted_mm)),
                        at_y(point.push_force_n));
  }
  svg.add(fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"#00798c\" stroke-width=\"1.8\" stroke-linejoin=\"round\"/>",
      path));
}

/// `x`, `−y`, … of a direction along an axis; nothing for any other.
std::string axis_name(const Vector3d& direction) {
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) > 1.0 - 1e-6)
      return (direction[axis] < 0.0 ? "−" : "") + std::string(names[static_cast<std::size_t>(axis)]);
  }
  return "";
}

std::array<View, 2> views_of(const Eigen::AlignedBox3d& box, const Vector3d& access_mm,
                             const Vector3d& gravity) {
  const Directions directions = directions_of(box, access_mm, gravity);
  std::array<View, 2> views;
  views[0].right = directions.forward.cross(directions.up);
  views[1].right = directions.forward;
  views[0].up = views[1].up = directions.up;
  return views;
}

/// What a view must show, in its own plane.
Eigen::AlignedBox2d flat_bounds(const View& view, const vessel::TriangleMesh& mesh,
                                const std::vector<SnapshotPoint>& points, const sim::Access& access) {
  Eigen::AlignedBox2d box(view.project_mm(access.position_mm));
  for (const Vector3d& vertex : mesh.vertices_mm) box.extend(view.project_mm(vertex));
  for (const SnapshotPoint& point : points) box.extend(view.project_mm(point.position_mm));
  return box;
}

Panel overview(const View& view, const char* caption, const Eigen::AlignedBox2d& box, double scale,
               double spare) {
  Panel panel;
  panel.view = view;
  panel.width = box.sizes().x() * scale + spare;
  panel.height = panel_height;
  panel.view.extent_mm = Vector2d(panel.width, panel.height) / scale;
  panel.view.corner_mm = box.center() - 0.5 * panel.view.extent_mm;
  panel.caption = caption;
  panel.axes = {axis_name(view.right), axis_name(view.up)};
  panel.y = top;
  return panel;
}

Panel tip_panel(const Panel& whole, const Vector3d& tip_mm, double x) {
  Panel panel = whole;
  panel.x = x;
  panel.width = panel.height = close_up;
  panel.magnified = true;
  panel.view.extent_mm = Vector2d(close_up_mm, close_up_mm);
  panel.view.corner_mm = panel.view.project_mm(tip_mm) - 0.5 * panel.view.extent_mm;
  panel.caption = "Tip, " + std::string(whole.caption == "Front" ? "front" : "side");
  return panel;
}

}  // namespace

std::string wire_picture_svg(const vessel::TriangleMesh& mesh, const Snapshot& snapshot,
                             const sim::Access& access, const PictureContent& content) {
  const std::vector<SnapshotPoint> points = wire_in_vessel(snapshot);
  const double largest = largest_force(points);
  const double full_scale = largest > 1e-9 ? nice_above(largest) : 0.01;

  // One scale for both overviews, with room for captions and labels; narrow vessels get wider margins.
  const std::array<View, 2> views =
      views_of(vessel::bounds_mm(mesh), access.position_mm, content.gravity_m_per_s2);
  const std::array<Eigen::AlignedBox2d, 2> flat{flat_bounds(views[0], mesh, points, access),
                                                flat_bounds(views[1], mesh, points, access)};
  const double wide_mm = flat[0].sizes().x() + flat[1].sizes().x();
  const double high_mm = std::max(1.0, flat[0].sizes().y());
  const double scale = std::min((panel_height - 110.0) / high_mm, 1000.0 / std::max(1.0, wide_mm));
  const double spare = std::max(70.0, 0.5 * (overview_width - wide_mm * scale));
  std::array<Panel, 2> whole{overview(views[0], "Front", flat[0], scale, spare),
                             overview(views[1], "Side", flat[1], scale, spare)};
  whole[0].x = margin;
  whole[1].x = whole[0].x + whole[0].width + gap;
  const double column = whole[1].x + whole[1].width + gap;
  const Vector3d tip = points.empty() ? access.position_mm : points.front().position_mm;
  const std::array<Panel, 2> detail{tip_panel(whole[0], tip, column),
                                    tip_panel(whole[1], tip, column + close_up + gap)};

  Svg svg;
  svg.add(
      fmt::format("<defs><marker id=\"arrow\" viewBox=\"0 0 6 6\" refX=\"3\" refY=\"3\" markerWidth=\"6\" "
                  "markerHeight=\"6\" "
                  "orient=\"auto\"><path d=\"M0 0L6 3L0 6z\" fill=\"{}\"/></marker></defs>",
                  quiet_ink));
  svg.text(margin, 50.0, content.title, 26, ink, "font-weight=\"bold\"");
  svg.text(margin, 78.0, content.subtitle, 15, quiet_ink);
  for (std::size_t k = 0; k < 2; ++k) {
    draw_panel(svg, whole[k], mesh, points, access, full_scale, &detail[k].view);
    draw_panel(svg, detail[k], mesh, points, access, full_scale, nullptr);
  }
  const double column_width = 2.0 * close_up + gap;
  double y = top + close_up + 42.0;
  draw_colour_scale(svg, column, y, column_width, full_scale);
  y += 84.0;
  const std::size_t half = (content.numbers.size() + 1) / 2;
  const auto middle = content.numbers.begin() + static_cast<std::ptrdiff_t>(half);
  draw_numbers(svg, column, y, close_up, {content.numbers.begin(), middle});
  draw_numbers(svg, column + close_up + gap, y, close_up, {middle, content.numbers.end()});
  y += 29.0 * static_cast<double>(half) + 22.0;
  draw_force_curve(svg, column, y, column_width, std::max(140.0, top + panel_height - y), content.forces);
  return svg.document(column + column_width + margin, top + panel_height + margin);
}

}  // namespace endowire::io

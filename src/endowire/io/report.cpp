#include "endowire/io/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "endowire/io/base64.hpp"
#include "endowire/io/decimate.hpp"
#include "endowire/io/markup.hpp"
#include "endowire/io/report_page.hpp"
#include "endowire/io/version.hpp"
#include "endowire/io/view.hpp"

namespace endowire::io {

using json = nlohmann::ordered_json;

namespace {

// Together below max_report_bytes, with four bytes of base64 to three of data:
constexpr std::size_t max_triangles = 40'000;      // 1 MB; finer than a screen shows
constexpr std::size_t max_wire_bytes = 3'600'000;  // 4.8 MB; 200 shapes of 900 points
constexpr std::size_t max_events = 1'000;          // 0.3 MB; more than anyone reads
constexpr std::size_t bytes_per_point = 5 * sizeof(float);

json vector_json(const Eigen::Vector3d& value) {
  json list = json::array();
  for (int c = 0; c < 3; ++c) list.push_back(std::isfinite(value[c]) ? json(value[c]) : json(nullptr));
  return list;
}

json vessel_json(const vessel::TriangleMesh& mesh) {
  const vessel::TriangleMesh small = decimated(mesh, max_triangles);
  std::vector<float> positions;
  positions.reserve(3 * small.vertices_mm.size());
  for (const Eigen::Vector3d& vertex : small.vertices_mm)
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(vertex[c]));
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * small.triangles.size());
  for (const auto& triangle : small.triangles)
    for (const std::int32_t corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"triangles", small.triangles.size()},
          {"triangles_of_mesh", mesh.triangles.size()},
          {"position_mm", base64(positions)},
          {"corners", base64(corners)}};
}

json series_json(const RunHistory& history) {
  const auto column = [&](auto value) {
    std::vector<double> values;
    values.reserve(history.steps().size());
    for (const HistoryStep& step : history.steps()) values.push_back(value(step));
    return base64(values);
  };
  return {{"every", history.every()},
          {"count", history.steps().size()},
          {"step", column([](const HistoryStep& s) { return static_cast<double>(s.step); })},
          {"time_s", column([](const HistoryStep& s) { return s.time_s; })},
          {"inserted_mm", column([](const HistoryStep& s) { return s.inserted_mm; })},
          {"push_force_n", column([](const HistoryStep& s) { return s.push_force_n; })},
          {"torque_n_mm", column([](const HistoryStep& s) { return s.torque_n_mm; })},
          {"wall_force_n", column([](const HistoryStep& s) { return s.wall_force_n; })},
          {"tip_force_n", column([](const HistoryStep& s) { return s.tip_force_n; })}};
}

/// As many key frames as fit, evenly; the last one always.
std::vector<const KeyFrame*> chosen_frames(const RunHistory& history) {
  const std::vector<KeyFrame>& frames = history.frames();
  std::size_t bytes = 0;
  for (const KeyFrame& frame : frames) bytes += frame.radius_mm.size() * bytes_per_point;
  const std::size_t every = std::max<std::size_t>(1, (bytes + max_wire_bytes - 1) / max_wire_bytes);
  std::vector<const KeyFrame*> chosen;
  for (std::size_t i = (frames.size() + every - 1) % every; i < frames.size(); i += every)
    chosen.push_back(&frames[i]);
  return chosen;
}

json wire_json(const RunHistory& history) {
  json steps = json::array();
  json points = json::array();
  std::vector<float> positions;
  std::vector<float> radii;
  std::vector<float> forces;
  for (const KeyFrame* frame : chosen_frames(history)) {
    steps.push_back(frame->step);
    points.push_back(frame->radius_mm.size());
    positions.insert(positions.end(), frame->position_mm.begin(), frame->position_mm.end());
    radii.insert(radii.end(), frame->radius_mm.begin(), frame->radius_mm.end());
    forces.insert(forces.end(), frame->wall_force_n_per_mm.begin(), frame->wall_force_n_per_mm.end());
  }
  return {{"step", steps},
          {"points", points},
          {"position_mm", base64(positions)},
          {"radius_mm", base64(radii)},
          {"wall_force_n_per_mm", base64(forces)}};
}

json summary_of(const std::string& text) {
  json summary = json::parse(text);
  summary["events_in_all"] = summary["events"].size();  // first: a new key moves the others
  json& events = summary["events"];
  if (events.size() > max_events) events.erase(events.begin() + max_events, events.end());
  return summary;
}

/// Inside a script element nothing may look like its end.
std::string inside_script(const json& value) {
  std::string out;
  for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

/// Puts the parts into the page, in one pass: nothing inside a part is looked at.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string out;
  while (true) {
    const std::size_t mark = page.find("{{");
    out += page.substr(0, mark);
    if (mark == std::string_view::npos) return out;
    const std::size_t end = page.find("}}", mark);
    const std::string_view name = page.substr(mark + 2, end - mark - 2);
    for (const auto& [part, text] : parts)
      if (part == name) out += text;
    page.remove_prefix(end + 2);
  }
}

}  // namespace

std::string report_html(const ReportContent& content) {
  const Directions directions =
      directions_of(vessel::bounds_mm(content.mesh), content.access.position_mm, content.gravity_m_per_s2);
  const json run = {
      {"schema", 1},
      {"version", version},
      {"title", content.title},
      {"subtitle", content.subtitle},
      {"summary", summary_of(content.summary)},
      {"view", {{"up", vector_json(directions.up)}, {"forward", vector_json(directions.forward)}}},
      {"access",
       {{"position_mm", vector_json(content.access.position_mm)},
        {"direction", vector_json(content.access.direction)}}},
      {"vessel", vessel_json(content.mesh)},
      {"series", series_json(content.history)},
      {"wire", wire_json(content.history)}};
  return filled(report_page::html, {{"title", escaped_markup(content.title)},
                                    {"style", std::string(report_page::style)},
                                    {"run", inside_script(run)},
                                    {"script", std::string(report_page::script)}});
}

}  // namespace endowire::io

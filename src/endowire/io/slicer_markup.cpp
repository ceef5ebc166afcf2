#include "endowire/io/slicer_markup.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace endowire::io {

using json = nlohmann::ordered_json;

namespace {

json curve(const std::string& name, std::span<const vessel::CentrelinePoint> points) {
  json control_points = json::array();
  json radii = json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& x = points[i].position_mm;
    control_points.push_back({{"id", fmt::format("{}", i + 1)},
                              {"label", fmt::format("{}-{}", name, i + 1)},
                              {"position", {x.x(), x.y(), x.z()}},
                              {"selected", true},
                              {"locked", true},
                              {"visibility", false},
                              {"positionStatus", "defined"}});
    radii.push_back(points[i].radius_mm);
  }
  json measurement = {
      {"name", "Radius"}, {"enabled", true}, {"units", "mm"}, {"controlPointValues", std::move(radii)}};
  return {{"type", "Curve"},
          {"name", name},
          {"coordinateSystem", "LPS"},
          {"coordinateUnits", "mm"},
          {"locked", true},
          {"labelFormat", "%N-%d"},
          {"controlPoints", std::move(control_points)},
          {"measurements", json::array({std::move(measurement)})}};
}

}  // namespace

json slicer_markups(const vessel::CentrelineTree& tree) {
  json curves = json::array();
  for (std::size_t b = 0; b < tree.branches().size(); ++b)
    curves.push_back(curve(tree.branches()[b].name, tree.points_of(static_cast<std::int32_t>(b))));
  return {{"@schema",
           "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
           "markups-schema-v1.0.3.json#"},
          {"markups", std::move(curves)}};
}

}  // namespace endowire::io

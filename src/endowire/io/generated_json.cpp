#include "endowire/io/generated_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace endowire::io {
namespace {

using nlohmann::ordered_json;

ordered_json vector_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

ordered_json branch_json(const vessel::anatomy::Branch& branch, const vessel::GeneratedVessel& vessel,
                         double spacing_mm) {
  ordered_json json;
  json["name"] = branch.name;
  if (branch.parent >= 0) json["parent"] = vessel.branches[static_cast<std::size_t>(branch.parent)].name;
  json["length_mm"] = branch.axis.length_mm();
  json["ostium_arc_mm"] = branch.ostium_arc_mm;
  ordered_json points = ordered_json::array();
  const double steps = std::ceil(branch.axis.length_mm() / spacing_mm);
  for (double i = 0.0; i <= steps; i += 1.0) {
    const double arc = branch.axis.length_mm() * i / steps;
    const vessel::anatomy::AxisPoint at = branch.axis.at(arc);
    points.push_back({{"arc_mm", arc},
                      {"position_mm", vector_json(at.position_mm)},
                      {"radius_mm", at.radius_mm},
                      {"curvature_per_mm", at.curvature_per_mm.norm()}});
  }
  json["axis"] = std::move(points);
  return json;
}

}  // namespace

ordered_json generated_json(const vessel::GeneratedVessel& vessel, double spacing_mm) {
  ordered_json json;
  json["schema"] = 1;
  json["triangles"] = vessel.mesh.triangles.size();
  for (const auto& [name, value] : vessel.parameters) json["parameters"][name] = value;
  json["access"] = {{"position_mm", vector_json(vessel.access_position_mm)},
                    {"direction", vector_json(vessel.access_direction)}};
  json["route_mm"] = vessel.route_mm;
  for (const vessel::Landmark& mark : vessel.landmarks)
    json["landmarks"].push_back({{"name", mark.name},
                                 {"branch", mark.branch},
                                 {"arc_mm", mark.arc_mm},
                                 {"position_mm", vector_json(mark.position_mm)},
                                 {"radius_mm", mark.lumen_radius_mm}});
  for (const vessel::anatomy::Branch& branch : vessel.branches)
    json["branches"].push_back(branch_json(branch, vessel, spacing_mm));
  return json;
}

}  // namespace endowire::io

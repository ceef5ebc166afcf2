#include "endowire/vessel/inspect.hpp"

#include <cstdio>

namespace endowire::vessel {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

VesselReport inspect(const std::string& file_label, const RepairedMesh& repaired, const MeshField& field) {
  VesselReport report;
  report.file = file_label;
  report.mesh = repaired.report;
  report.field = field.facts();
  for (std::size_t k = 0; k < repaired.openings.size(); ++k) {
    const Opening& o = repaired.openings[k];
    const VirtualTube& tube = field.virtual_tubes()[k];
    report.openings.push_back(
        {o.number, o.centre_mm, o.direction, o.diameter_mm, tube.end_mm - tube.begin_mm});
  }
  for (const PinHole& hole : repaired.pin_holes)
    report.pin_holes.push_back({hole.centre_mm, hole.diameter_mm});

  const MeshReport& m = repaired.report;
  auto& say = report.remarks;
  if (m.degenerate_triangles > 0)
    say.push_back(counted(m.degenerate_triangles, "degenerate triangle was", "degenerate triangles were") +
                  " dropped");
  if (m.duplicate_triangles > 0)
    say.push_back(counted(m.duplicate_triangles, "duplicate triangle was", "duplicate triangles were") +
                  " dropped");
  if (m.inward_in_file) say.emplace_back("the file's normals point inward; they were turned");
  if (!m.inward_in_file && m.flipped_triangles > 0)
    say.push_back(counted(m.flipped_triangles, "triangle was", "triangles were") + " turned to face outward");
  if (m.non_manifold_edges > 0)
    say.push_back(counted(m.non_manifold_edges, "edge has", "edges have") + " more than two triangles");
  if (m.components > 1) say.push_back("the mesh has " + std::to_string(m.components) + " separate pieces");
  if (m.wall_with_thickness)
    say.emplace_back("one surface encloses another: this is a vessel wall with a thickness, not a lumen");
  if (!repaired.pin_holes.empty())
    say.push_back(counted(repaired.pin_holes.size(), "pin hole counts", "pin holes count") +
                  " as closed wall");
  if (repaired.openings.empty()) say.emplace_back("the vessel ends are closed: a wire cannot leave");
  for (const OpeningReport& o : report.openings)
    if (o.virtual_tube_mm < 0.99 * FieldParameters{}.virtual_tube_mm)
      say.push_back("the virtual tube behind opening " + std::to_string(o.number) + " is only " +
                    rounded(o.virtual_tube_mm) + " mm long: another wall is in its way");
  if (!report.field.refinement_complete)
    say.push_back("the distance field misses its error target at sharp edges: at most " +
                  rounded(report.field.error_max_mm) + " mm, 99 % below " +
                  rounded(report.field.error_p99_mm) + " mm");
  return report;
}

}  // namespace endowire::vessel

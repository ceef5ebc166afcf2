#include "endowire/vessel/inspect.hpp"

#include "endowire/vessel/mesh_text.hpp"

namespace endowire::vessel {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string near(const FlawPlaces& places) {
  std::string text = ", near ";
  for (std::size_t k = 0; k < places.first_mm.size(); ++k)
    text += (k > 0 ? ", " : "") + place_text(places.first_mm[k]);
  return places.count > places.first_mm.size() ? text + ", …" : text;
}

}  // namespace

std::vector<std::string> repair_remarks(const RepairedMesh& repaired) {
  const MeshReport& m = repaired.report;
  std::vector<std::string> say;
  if (m.degenerate_triangles > 0)
    say.push_back(counted(m.degenerate_triangles, "degenerate triangle was", "degenerate triangles were") +
                  " dropped");
  if (m.duplicate_triangles > 0)
    say.push_back(counted(m.duplicate_triangles, "duplicate triangle was", "duplicate triangles were") +
                  " dropped");
  if (m.inward_in_file) say.emplace_back("the file's normals point inward; they were turned");
  if (!m.inward_in_file && m.flipped_triangles > 0)
    say.push_back(counted(m.flipped_triangles, "triangle was", "triangles were") + " turned to face outward");
  if (m.non_manifold_edges.count > 0)
    say.push_back(counted(m.non_manifold_edges.count, "edge has", "edges have") + " more than two triangles" +
                  near(m.non_manifold_edges));
  if (m.fins.count > 0)
    say.push_back(counted(m.fins.count, "fin that hangs on the wall was", "fins that hang on the wall were") +
                  " dropped" + near(m.fins));
  if (m.membranes.count > 0)
    say.push_back(
        counted(m.membranes.count, "membrane across the lumen was", "membranes across the lumen were") +
        " dropped" + near(m.membranes));
  if (m.debris.count > 0)
    say.push_back(
        counted(m.debris.count, "piece too small to be a vessel was", "pieces too small to be vessels were") +
        " dropped" + near(m.debris));
  if (m.wall_with_thickness)
    say.push_back("this is a vessel wall with a thickness: its inner surface is the lumen, " +
                  counted(m.wall_triangles, "triangle", "triangles") + " of the wall were dropped");
  if (m.self_intersections.count > 0)
    say.push_back(counted(m.self_intersections.count, "pair of triangles passes", "pairs of triangles pass") +
                  " through each other, and were kept" + near(m.self_intersections));
  if (m.components > 1) say.push_back("the lumen has " + std::to_string(m.components) + " separate pieces");
  if (m.cut_ends > 0)
    say.push_back(counted(m.cut_ends, "end", "ends") + " without an edge at the rim cut back to a plane");
  if (m.sliver_triangles > 0)
    say.push_back(counted(m.sliver_triangles, "triangle without area was", "triangles without area were") +
                  " kept");
  FlawPlaces holes;
  for (const PinHole& hole : repaired.pin_holes) holes.add(hole.centre_mm);
  if (holes.count > 0)
    say.push_back(counted(holes.count, "pin hole counts", "pin holes count") + " as closed wall" +
                  near(holes));
  return say;
}

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

  report.remarks = repair_remarks(repaired);
  auto& say = report.remarks;
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

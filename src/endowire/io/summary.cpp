#include "endowire/io/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "endowire/io/file.hpp"
#include "endowire/io/version.hpp"
#include "endowire/vessel/inspect.hpp"

namespace endowire::io {

using json = nlohmann::ordered_json;

namespace {

json finite(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json vector_json(const Eigen::Vector3d& value) {
  return json::array({finite(value.x()), finite(value.y()), finite(value.z())});
}

json spread(const std::vector<double>& values) {
  return {{"steps", values.size()},
          {"p50", finite(percentile(values, 0.5))},
          {"p95", finite(percentile(values, 0.95))},
          {"p99", finite(percentile(values, 0.99))},
          {"p999", finite(percentile(values, 0.999))},
          {"max", finite(percentile(values, 1.0))}};
}

double mean(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double per_step(double count, std::uint64_t steps) {
  return steps == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(steps);
}

json name_or_null(const vessel::CentrelineTree& tree, std::int32_t branch) {
  return branch < 0 ? json(nullptr) : json(tree.branches()[static_cast<std::size_t>(branch)].name);
}

json events_json(const RunStatistics& run, const vessel::CentrelineTree& tree) {
  json events = json::array();
  for (const TimedEvent& timed : run.events) {
    const sim::Event& event = timed.event;
    events.push_back({{"step", timed.step},
                      {"time_s", finite(timed.time_s)},
                      {"kind", name_of(event.kind)},
                      {"value", finite(event.value)},
                      {"unit", unit_of(event.kind)},
                      {"position_mm", vector_json(event.position_mm)}});
    if (event.branch >= 0) events.back()["branch"] = name_or_null(tree, event.branch);
  }
  return events;
}

json failure_json(const RunStatistics& run) {
  if (run.failed.empty()) return nullptr;
  const FailedStep& first = run.failed.front();
  return {{"step", first.step},
          {"time_s", finite(first.time_s)},
          {"inserted_length_mm", finite(first.inserted_length_mm)},
          {"termination", name_of(first.solve.termination)},
          {"correction_mm", finite(first.solve.correction_mm)},
          {"force_residual_n", finite(first.solve.force_residual_n)},
          {"moment_residual_n_mm", finite(first.solve.moment_residual_n_mm)}};
}

/// The target and how far the tip is from it; null without a target.
json target_json(const SceneFile& scene, const RunGoal& goal, const Eigen::Vector3d& tip_mm) {
  if (!goal.target || !scene.target) return nullptr;
  const sim::Target& target = *goal.target;
  const sim::TargetDistance distance = sim::distance_to(target, goal.tree, tip_mm);
  return {{"name", scene.target->name},
          {"branch", name_or_null(goal.tree, target.branch)},
          {"beyond_ostium_mm", finite(target.beyond_ostium_mm)},
          {"within_radii", finite(target.within_radii)},
          {"position_mm", vector_json(target.position_mm)},
          {"radius_mm", finite(target.radius_mm)},
          {"reached", distance.reached},
          {"to_go_mm", finite(distance.to_go_mm)},
          {"offset_radii", finite(distance.offset_radii)}};
}

}  // namespace

namespace {

json places_json(const vessel::FlawPlaces& places) {
  json first = json::array();
  for (const Eigen::Vector3d& place : places.first_mm) first.push_back(vector_json(place));
  return first;
}

json volume_json(const VolumeReport& report) {
  const auto number = [](const auto& value) { return value ? json(*value) : json(nullptr); };
  return {{"size", report.size},
          {"spacing_mm", vector_json(report.spacing_mm)},
          {"frame_in_file", report.frame},
          {"frame", "LPS"},
          {"label_map", report.label_map},
          {"label", number(report.label)},
          {"threshold", number(report.threshold)},
          {"threshold_high", number(report.threshold_high)},
          {"threshold_found", report.threshold_found},
          {"pieces", report.pieces},
          {"pieces_kept", report.pieces_kept},
          {"voxels_kept", report.voxels_kept},
          {"largest_dropped_voxels", report.largest_dropped},
          {"cavity_voxels_filled", report.cavity_voxels},
          {"smoothing_passes", report.smoothing_passes}};
}

}  // namespace

json ends_json(const std::vector<vessel::VesselEnd>& ends) {
  json list = json::array();
  for (const vessel::VesselEnd& end : ends)
    list.push_back({{"number", end.number},
                    {"open", end.open},
                    {"centre_mm", vector_json(end.centre_mm)},
                    {"direction", vector_json(end.direction)},
                    {"diameter_mm", finite(end.diameter_mm)},
                    {"branch", end.branch.empty() ? json(nullptr) : json(end.branch)},
                    {"access_mm", vector_json(end.access_mm)},
                    {"inward", vector_json(end.inward)}});
  return list;
}

json vessel_json(const VesselMesh& mesh, const vessel::MeshField& field) {
  const vessel::MeshReport& report = mesh.repaired.report;
  const vessel::FieldFacts& facts = field.facts();
  json openings = json::array();
  for (const vessel::Opening& opening : mesh.repaired.openings)
    openings.push_back({{"number", opening.number},
                        {"centre_mm", vector_json(opening.centre_mm)},
                        {"direction", vector_json(opening.direction)},
                        {"diameter_mm", finite(opening.diameter_mm)}});
  json holes = json::array();
  for (const vessel::PinHole& hole : mesh.repaired.pin_holes)
    holes.push_back({{"centre_mm", vector_json(hole.centre_mm)}, {"diameter_mm", finite(hole.diameter_mm)}});
  const auto& diameters = facts.lumen_diameter_percentiles_mm;
  return {{"source", mesh.source},
          {"content_hash", hash_text(mesh.content_hash)},
          {"unit", vessel::name_of(mesh.unit)},
          {"unit_inferred", mesh.unit_inferred},
          {"unit_text", mesh.unit_text},
          {"image", mesh.volume ? volume_json(*mesh.volume) : json(nullptr)},
          {"triangles", report.triangles},
          {"vertices", report.vertices},
          {"components", report.components},
          {"bounds_mm",
           {{"low", vector_json(report.bounds_mm.min())}, {"high", vector_json(report.bounds_mm.max())}}},
          {"area_mm2", finite(report.area_mm2)},
          {"volume_mm3", finite(report.volume_mm3)},
          {"wall_with_thickness", report.wall_with_thickness},
          {"openings", openings},
          {"pin_holes", holes},
          {"lumen_diameter_mm",
           {{"p5", finite(diameters[0])},
            {"p25", finite(diameters[1])},
            {"p50", finite(diameters[2])},
            {"p75", finite(diameters[3])},
            {"p95", finite(diameters[4])}}},
          {"repair",
           {{"triangles_in_file", report.triangles_in_file},
            {"merged_points", report.merged_points},
            {"degenerate_triangles_dropped", report.degenerate_triangles},
            {"duplicate_triangles_dropped", report.duplicate_triangles},
            {"sliver_triangles_kept", report.sliver_triangles},
            {"flipped_triangles", report.flipped_triangles},
            {"inward_in_file", report.inward_in_file},
            {"non_manifold_edges", report.non_manifold_edges.count},
            {"fins_dropped", report.fins.count},
            {"membranes_dropped", report.membranes.count},
            {"components_in_file", report.components_in_file},
            {"debris_dropped", report.debris.count},
            {"wall_triangles_dropped", report.wall_triangles},
            {"ends_cut", report.cut_ends},
            {"self_intersections", report.self_intersections.count},
            {"self_intersections_mm", places_json(report.self_intersections)},
            {"non_manifold_edges_mm", places_json(report.non_manifold_edges)},
            {"debris_mm", places_json(report.debris)},
            {"remarks", vessel::repair_remarks(mesh.repaired)}}},
          {"field",
           {{"bytes", facts.bytes},
            {"bricks", facts.bricks},
            {"finest_spacing_mm", finite(facts.finest_spacing_mm)},
            {"error_max_mm", finite(facts.error_max_mm)},
            {"error_p99_mm", finite(facts.error_p99_mm)},
            {"error_p50_mm", finite(facts.error_p50_mm)},
            {"refinement_complete", facts.refinement_complete}}}};
}

std::string summary_json(const SceneFile& scene, const VesselMesh& mesh, const vessel::MeshField& field,
                         const RunGoal& goal, const RunStatistics& run, const sim::Snapshot& last,
                         std::uint64_t state_hash, const CrossingVerdict& verdict,
                         const MachineFacts& machine) {
  const Eigen::Vector3d tip =
      last.points.empty() ? scene.access.position_mm : Eigen::Vector3d(last.points.front().position_mm);
  json summary = {
      {"schema", 1},
      {"version", version},
      {"scene", scene.name},
      {"scene_hash", hash_text(content_hash(scene.text))},
      {"vessel", vessel_json(mesh, field)},
      {"steps", run.steps},
      {"converged_steps", run.converged_steps},
      {"split_steps", run.split_steps},
      {"detections_per_step", finite(per_step(run.detections, run.steps))},
      {"detections_per_step_without_snap", finite(per_step(run.calm_detections, run.step_us.size()))},
      {"verifications_per_step", finite(per_step(static_cast<double>(run.verifications), run.steps))},
      {"newton_iterations",
       {{"mean", finite(mean(run.newton_iterations))},
        {"p99", finite(percentile(run.newton_iterations, 0.99))},
        {"max", finite(percentile(run.newton_iterations, 1.0))}}},
      {"rods",
       {{"min", run.least_rods},
        {"mean", finite(per_step(run.rods, run.steps))},
        {"max", run.most_rods},
        {"final", run.last_rods},
        {"divided", run.rods_divided},
        {"joined", run.rods_joined}}},
      {"max_resolution_energy_mj", finite(run.max_resolution_energy_mj)},
      {"contact_samples_max", run.most_contact_samples},
      {"max_wall_deflection_mm", finite(percentile(run.wall_deflection_mm, 1.0))},
      {"p99_wall_deflection_mm", finite(percentile(run.wall_deflection_mm, 0.99))},
      {"wall_crossings", verdict.crossings ? json(*verdict.crossings) : json(nullptr)},
      {"max_force_5mm_n", finite(run.max_force_5mm_n)},
      {"max_tip_force_n", finite(run.max_tip_force_n)},
      {"instruments",
       {{{"model", scene.instrument.model},
         {"inserted_length_mm", finite(last.inserted_length_mm)},
         {"tip_position_mm", vector_json(tip)},
         {"tip_branch", name_or_null(goal.tree, goal.tree.branch_at(tip))},
         {"max_push_force_n", finite(run.max_push_force_n)},
         {"min_push_force_n", finite(run.min_push_force_n)},
         {"max_torque_n_mm", finite(run.max_torque_n_mm)},
         {"hand_slip_mm", finite(run.hand_slip_mm)}}}},
      {"target", target_json(scene, goal, tip)},
      {"perforation_threshold",
       {{"force_n", finite(scene.simulation.perforation_force_n)}, {"source", scene.perforation_source}}},
      {"events", events_json(run, goal.tree)},
      {"first_failure", failure_json(run)},
      {"state_hash", hash_text(state_hash)},
      {"machine",
       {{"step_time_us", spread(run.step_us)},
        {"step_time_snap_us", spread(run.snap_step_us)},
        {"peak_memory_mb", finite(machine.peak_memory_mb)},
        {"preparation_s", finite(machine.preparation_s)},
        {"field_from_cache", machine.field_from_cache},
        {"isa", machine.isa}}}};
  if (!verdict.crossings) summary["wall_crossings_note"] = verdict.note;
  return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace endowire::io

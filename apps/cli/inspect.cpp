#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "endowire/io/centreline_file.hpp"
#include "endowire/io/summary.hpp"
#include "endowire/io/vessel_file.hpp"
#include "progress.hpp"

namespace endowire::cli {

namespace {

struct Options {
  std::string vessel;
  std::string unit = "mm";
  std::string cache = io::default_cache_folder().string();
  std::string centreline;  ///< file to write; empty: none
  bool json = false;
};

std::string place(const Eigen::Vector3d& point) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", point.x(), point.y(), point.z());
}

void print_repairs(const vessel::MeshReport& report) {
  const auto count = [](std::size_t number, const char* what) {
    if (number > 0) fmt::print("  {:<22} {} {}\n", "", number, what);
  };
  fmt::print("  {:<22} {}\n", "repaired",
             report.inward_in_file ? "triangles faced inward: all turned" : "orientation as in the file");
  count(report.flipped_triangles, "triangles turned to face outward");
  count(report.degenerate_triangles, "degenerate triangles dropped");
  count(report.duplicate_triangles, "duplicate triangles dropped");
  count(report.sliver_triangles, "triangles without area, kept");
  count(report.non_manifold_edges.count, "edges of three or more triangles");
}

void print_facts(const io::VesselMesh& mesh, const vessel::MeshField& field) {
  const vessel::MeshReport& report = mesh.repaired.report;
  const vessel::FieldFacts& facts = field.facts();
  const Eigen::Vector3d size = report.bounds_mm.sizes();
  const auto& diameters = facts.lumen_diameter_percentiles_mm;
  fmt::print("{}\n", mesh.source);
  fmt::print("  {:<22} {} in the file, {} used, {} vertices, {} component{}\n", "triangles",
             report.triangles_in_file, report.triangles, report.vertices, report.components,
             report.components == 1 ? "" : "s");
  fmt::print("  {:<22} {:.1f} x {:.1f} x {:.1f} mm, from {} to {}\n", "size", size.x(), size.y(), size.z(),
             place(report.bounds_mm.min()), place(report.bounds_mm.max()));
  fmt::print("  {:<22} {:.0f} mm2, volume {:.0f} mm3\n", "area", report.area_mm2, report.volume_mm3);
  fmt::print("  {:<22} {:.1f} mm (5 %), {:.1f} mm (median), {:.1f} mm (95 % of the wall)\n", "lumen diameter",
             diameters[0], diameters[2], diameters[4]);
  if (mesh.repaired.openings.empty()) fmt::print("  {:<22} none: the vessel is closed\n", "openings");
  for (const vessel::Opening& opening : mesh.repaired.openings)
    fmt::print("  {:<22} diameter {:.1f} mm at {}, facing {}\n", fmt::format("opening {}", opening.number),
               opening.diameter_mm, place(opening.centre_mm),
               fmt::format("({:.2f}, {:.2f}, {:.2f})", opening.direction.x(), opening.direction.y(),
                           opening.direction.z()));
  for (const vessel::PinHole& hole : mesh.repaired.pin_holes)
    fmt::print("  {:<22} diameter {:.2f} mm at {}, treated as wall\n", "pin hole", hole.diameter_mm,
               place(hole.centre_mm));
  print_repairs(report);
  fmt::print(
      "  {:<22} {:.1f} MB, finest cell {:.3f} mm, error {:.4f} mm (median), {:.4f} mm (99 %), {:.4f} mm "
      "(largest)\n",
      "distance field", static_cast<double>(facts.bytes) / 1e6, facts.finest_spacing_mm, facts.error_p50_mm,
      facts.error_p99_mm, facts.error_max_mm);
}

/// How a branch ends: at an end of the vessel, a cut, or a bifurcation.
std::string end_of(const vessel::CentrelineTree& tree, std::int32_t branch) {
  std::string text;
  for (const vessel::CentrelineEnd& end : tree.ends()) {
    if (end.branch != branch) continue;
    if (!text.empty()) text += ", ";
    text += end.root ? fmt::format("root at {}", io::name_of(end)) : io::name_of(end);
    if (end.rejoins >= 0)
      text += fmt::format(", rejoins {}", tree.branches()[static_cast<std::size_t>(end.rejoins)].name);
  }
  return text;
}

void print_branches(const vessel::CentrelineTree& tree) {
  if (tree.branches().empty()) {
    fmt::print("  {:<22} none: no lumen with an end was found\n", "branches");
    return;
  }
  fmt::print("  {:<22} {}, root first; radius of the lumen from ostium to cap\n", "branches",
             tree.branches().size());
  fmt::print("    {:<16} {:<16} {:>9} {:>19}  {}\n", "name", "parent", "length/mm",
             "radius/mm least mean most", "ends at");
  for (std::size_t b = 0; b < tree.branches().size(); ++b) {
    const vessel::CentrelineBranch& branch = tree.branches()[b];
    const std::string parent =
        branch.parent < 0 ? "-" : tree.branches()[static_cast<std::size_t>(branch.parent)].name;
    fmt::print("    {:<16} {:<16} {:>9.1f} {:>11.2f} {:>6.2f} {:>6.2f}  {}\n", branch.name, parent,
               branch.length_mm, branch.min_radius_mm, branch.mean_radius_mm, branch.max_radius_mm,
               end_of(tree, static_cast<std::int32_t>(b)));
  }
}

int run(const Options& options) {
  const vessel::LengthUnit unit = vessel::parse_length_unit(options.unit, "--unit");
  const io::VesselMesh mesh = io::read_vessel_file(options.vessel, unit);
  Progress progress(options.json);
  progress.stage("preparing the distance field …");
  const io::PreparedField prepared = io::prepare_field(mesh, options.cache);
  progress.stage("looking for centrelines …");
  const std::shared_ptr<const vessel::CentrelineTree> tree = io::prepare_centrelines(mesh, options.cache);
  progress.clear();
  if (!options.centreline.empty()) io::write_centrelines_vtp(options.centreline, *tree);
  if (options.json) {
    nlohmann::ordered_json facts = io::vessel_json(mesh, *prepared.field);
    facts["centrelines"] = io::centrelines_json(*tree);
    fmt::print("{}\n", facts.dump(2));
  } else {
    print_facts(mesh, *prepared.field);
    print_branches(*tree);
  }
  return exit_success;
}

}  // namespace

std::function<int()> add_inspect(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "inspect", "what a mesh is: triangles, openings, lumen diameters, repairs, branches");
  command->add_option("VESSEL", options->vessel, "STL file of the lumen")->required();
  command->add_option("--unit", options->unit, "unit of the file: mm, cm or m")->capture_default_str();
  command->add_option("--cache", options->cache, "folder for prepared distance fields and centrelines");
  command->add_option("--centreline", options->centreline, "write the centrelines to this file (VTP)");
  command->add_flag("--json", options->json, "as JSON");
  return [options] { return run(*options); };
}

}  // namespace endowire::cli

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "endowire/io/centreline_file.hpp"
#include "endowire/io/contact_sheet.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/slicer_markup.hpp"
#include "endowire/io/summary.hpp"
#include "progress.hpp"
#include "vessel_input.hpp"

namespace endowire::cli {

namespace {

struct Options {
  VesselInput vessel;
  std::string cache = io::default_cache_folder().string();
  std::string centreline;  ///< file to write; empty: none
  std::string picture;     ///< the same
  bool json = false;
};

void print_field(const vessel::FieldFacts& facts) {
  const auto& diameters = facts.lumen_diameter_percentiles_mm;
  fmt::print("  {:<22} {:.1f} mm (5 %), {:.1f} mm (median), {:.1f} mm (95 % of the wall)\n", "lumen diameter",
             diameters[0], diameters[2], diameters[4]);
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

/// As the name asks for: markups of 3D Slicer, else VTP.
void write_centrelines(const std::string& file, const vessel::CentrelineTree& tree) {
  if (file.ends_with(".json")) {
    io::write_file_atomically(file, io::slicer_markups(tree).dump(1) + "\n");
  } else {
    io::write_centrelines_vtp(file, tree);
  }
}

int run(const Options& options) {
  const io::VesselMesh mesh = read_vessel(options.vessel);
  Progress progress(options.json);
  progress.stage("preparing the distance field …");
  const io::PreparedField prepared = io::prepare_field(mesh, options.cache);
  progress.stage("looking for centrelines …");
  const std::shared_ptr<const vessel::CentrelineTree> tree = io::prepare_centrelines(mesh, options.cache);
  progress.clear();
  const std::vector<vessel::VesselEnd> ends = vessel::vessel_ends(mesh.repaired, *tree);
  if (!options.centreline.empty()) write_centrelines(options.centreline, *tree);
  if (!options.picture.empty())
    io::write_file_atomically(options.picture, io::contact_sheet_png(mesh.repaired.mesh, *tree, ends));
  if (options.json) {
    nlohmann::ordered_json facts = io::vessel_json(mesh, *prepared.field);
    facts["ends"] = io::ends_json(ends);
    facts["centrelines"] = io::centrelines_json(*tree);
    fmt::print("{}\n", facts.dump(2));
  } else {
    print_vessel(mesh);
    print_field(prepared.field->facts());
    print_ends(ends);
    print_branches(*tree);
  }
  return exit_success;
}

}  // namespace

std::function<int()> add_inspect(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "inspect", "what a vessel is: unit, triangles, repairs, ends, lumen diameters, branches");
  add_vessel_options(*command, options->vessel);
  command->add_option("--cache", options->cache, "folder for prepared distance fields and centrelines");
  command->add_option("--centreline", options->centreline,
                      "write the centrelines to this file: .vtp, or .mrk.json for 3D Slicer");
  command->add_option(
      "--picture", options->picture,
      "draw the vessel from three sides, ends numbered, centrelines by radius, into this file (PNG)");
  command->add_flag("--json", options->json, "as JSON");
  return [options] { return run(*options); };
}

}  // namespace endowire::cli

#include "vessel_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "endowire/base/error.hpp"
#include "endowire/vessel/inspect.hpp"
#include "endowire/vessel/text_tokens.hpp"

namespace endowire::cli {

namespace {

double number_of(const std::string& text, const char* option, const char* allowed) {
  const double number = vessel::parse_number(text);
  if (!std::isfinite(number))
    throw base::InputError(fmt::format("{} is \"{}\"; must be {}", option, vessel::quoted(text), allowed));
  return number;
}

int whole_of(const std::string& text, const char* option, double low, double high) {
  const std::string allowed = fmt::format("a whole number, {} … {}", low, high);
  const double number = number_of(text, option, allowed.c_str());
  if (number != std::floor(number) || number < low || number > high)
    throw base::InputError(fmt::format("{} is \"{}\"; must be {}", option, text, allowed));
  return static_cast<int>(number);
}

io::VolumeOptions volume_options(const VesselInput& input) {
  io::VolumeOptions options;
  if (!input.threshold.empty()) {
    const std::size_t colon = input.threshold.find(':');
    constexpr const char* allowed = "a number, or two as LOW:HIGH";
    options.threshold = number_of(input.threshold.substr(0, colon), "--threshold", allowed);
    if (colon != std::string::npos)
      options.threshold_high = number_of(input.threshold.substr(colon + 1), "--threshold", allowed);
  }
  if (!input.label.empty()) options.label = whole_of(input.label, "--label", 1, 1e9);
  if (!input.smooth.empty()) options.smooth = whole_of(input.smooth, "--smooth", 0, io::max_smoothing_passes);
  if (input.keep != "largest" && input.keep != "all")
    throw base::InputError(
        fmt::format("--keep is \"{}\"; must be largest or all", vessel::quoted(input.keep)));
  options.keep_all = input.keep == "all";
  return options;
}

std::string place(const Eigen::Vector3d& point) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", point.x(), point.y(), point.z());
}

void row(const char* name, const std::string& text) {
  fmt::print("  {:<22} {}\n", name, text);
}

void print_volume(const io::VolumeReport& report) {
  row("image",
      fmt::format("{} x {} x {} voxels of {:.3g} x {:.3g} x {:.3g} mm", report.size[0], report.size[1],
                  report.size[2], report.spacing_mm.x(), report.spacing_mm.y(), report.spacing_mm.z()));
  row("frame", report.frame + "; here LPS in mm: x to the patient's left, y to the back, z to the head");
  if (report.label_map) {
    row("lumen", fmt::format("label {} of a label map", *report.label));
  } else {
    row("lumen", fmt::format("above {:.4g}{}{}", *report.threshold,
                             report.threshold_high ? fmt::format(", to {:.4g}", *report.threshold_high) : "",
                             report.threshold_found
                                 ? ", where the image's only sharp surface is (--threshold VALUE for another)"
                                 : ", as given"));
  }
  const double voxel_mm3 = report.spacing_mm.prod();
  row("pieces",
      fmt::format("{} of {} kept, {:.0f} mm3{}", report.pieces_kept, report.pieces,
                  voxel_mm3 * static_cast<double>(report.voxels_kept),
                  report.largest_dropped > 0
                      ? fmt::format("; the largest of the others has {:.0f} mm3 (--keep all keeps them)",
                                    voxel_mm3 * static_cast<double>(report.largest_dropped))
                      : ""));
  if (report.cavity_voxels > 0)
    row("holes", fmt::format("{} voxels within the lumen filled", report.cavity_voxels));
  row("surface",
      fmt::format("{} triangles{}, {} passes of smoothing (--smooth PASSES)", report.surface_triangles,
                  report.surface_triangles < report.surface_triangles_before
                      ? fmt::format(", made of {}", report.surface_triangles_before)
                      : "",
                  report.smoothing_passes));
}

}  // namespace

void add_vessel_options(CLI::App& command, VesselInput& input) {
  command
      .add_option(
          "VESSEL", input.file,
          "surface (STL, PLY, OBJ, VTP, VTU, VTK) or image (NIfTI, MetaImage, NRRD, folder of DICOM files)")
      ->required();
  command.add_option("--unit", input.unit,
                     "unit of the lengths in the file: mm, cm or m; without it that of an image's header, of "
                     "a surface the likely one");
  command.add_option("--threshold", input.threshold, "of an image: the lumen is brighter, LOW or LOW:HIGH");
  command.add_option("--label", input.label, "of a label map: the number of the lumen");
  command.add_option("--smooth", input.smooth, "of an image: passes that smooth the surface, 0 for none");
  command.add_option("--keep", input.keep, "of an image: the largest piece of lumen, or all")
      ->capture_default_str();
}

io::VesselMesh read_vessel(const VesselInput& input) {
  std::optional<vessel::LengthUnit> unit;
  if (!input.unit.empty()) unit = vessel::parse_length_unit(input.unit, "--unit");
  return io::read_vessel_file(input.file, unit, volume_options(input));
}

void print_vessel(const io::VesselMesh& mesh) {
  const vessel::MeshReport& report = mesh.repaired.report;
  const Eigen::Vector3d size = report.bounds_mm.sizes();
  fmt::print("{}\n", mesh.source);
  row("unit", mesh.unit_text);
  if (mesh.volume) print_volume(*mesh.volume);
  row("triangles", fmt::format("{} in the {}, {} used, {} vertices, {} component{}", report.triangles_in_file,
                               mesh.volume ? "surface" : "file", report.triangles, report.vertices,
                               report.components, report.components == 1 ? "" : "s"));
  row("size", fmt::format("{:.1f} x {:.1f} x {:.1f} mm, from {} to {}", size.x(), size.y(), size.z(),
                          place(report.bounds_mm.min()), place(report.bounds_mm.max())));
  row("area", fmt::format("{:.0f} mm2, volume {:.0f} mm3", report.area_mm2, report.volume_mm3));
  const char* name = "repaired";
  for (const std::string& remark : vessel::repair_remarks(mesh.repaired)) {
    row(name, remark);
    name = "";
  }
  if (*name != '\0') row(name, "nothing: the mesh is sound");
}

void print_ends(const std::vector<vessel::VesselEnd>& ends) {
  if (ends.empty()) {
    row("ends", "none were found");
    return;
  }
  row("ends", fmt::format("{}; opening = N of [access] and [target] in a scene", ends.size()));
  fmt::print("    {:>3}  {:<8} {:>11}  {:<24} {:<22} {}\n", "N", "", "diameter/mm", "centre/mm", "facing",
             "branch");
  for (const vessel::VesselEnd& end : ends)
    fmt::print(
        "    {:>3}  {:<8} {:>11.2f}  {:<24} {:<22} {}\n", end.number, end.open ? "opening" : "closed",
        end.diameter_mm, place(end.centre_mm),
        fmt::format("({:.2f}, {:.2f}, {:.2f})", end.direction.x(), end.direction.y(), end.direction.z()),
        end.branch.empty() ? "-" : end.branch);
}

}  // namespace endowire::cli

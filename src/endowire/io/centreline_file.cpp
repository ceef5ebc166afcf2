#include "endowire/io/centreline_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include "endowire/io/vtk_poly_data.hpp"
#endif

namespace endowire::io {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
using vessel::CentrelineBranch;
using vessel::CentrelinePoint;
using vessel::CentrelineTree;

namespace {

constexpr std::uintmax_t max_tree_bytes = std::uintmax_t{256} << 20;  // two million points

json vector_json(const Eigen::Vector3d& value) {
  return json::array({value.x(), value.y(), value.z()});
}

json index_or_null(std::int32_t index) {
  return index < 0 ? json(nullptr) : json(index);
}

}  // namespace

std::shared_ptr<const CentrelineTree> prepare_centrelines(const VesselMesh& mesh,
                                                          const fs::path& cache_folder,
                                                          const vessel::CentrelineParameters& parameters) {
  const std::uint64_t key = vessel::centreline_key(mesh.repaired, parameters);
  const fs::path file = cache_folder / centreline_cache_name(key);
  std::error_code error;
  if (!cache_folder.empty() && fs::is_regular_file(file, error)) {
    try {
      const std::string bytes = read_file(file, max_tree_bytes);
      return std::make_shared<const CentrelineTree>(
          CentrelineTree::deserialise(std::as_bytes(std::span(bytes)), key, one_line(file.string())));
    } catch (const base::InputError&) {
      // Damaged or of an older version: no fault of the user's input, and computed anew below.
    }
  }
  auto tree = std::make_shared<const CentrelineTree>(vessel::extract_centrelines(mesh.repaired, parameters));
  if (cache_folder.empty()) return tree;
  try {
    fs::create_directories(cache_folder, error);
    const std::vector<std::byte> bytes = tree->serialise(key);
    write_file_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const base::InputError&) {
    // A full or read-only disk costs time, never the run.
  }
  return tree;
}

std::string centreline_cache_name(std::uint64_t key) {
  return "centreline-" + hash_text(key) + ".bin";
}

std::string name_of(const vessel::CentrelineEnd& end) {
  switch (end.kind) {
    case vessel::CentrelineEndKind::opening:
      return fmt::format("opening {}", end.opening);
    case vessel::CentrelineEndKind::cut:
      return "cut";
    case vessel::CentrelineEndKind::cap:
      break;
  }
  return "cap";
}

json centrelines_json(const CentrelineTree& tree) {
  json branches = json::array();
  for (const CentrelineBranch& b : tree.branches())
    branches.push_back(
        {{"name", b.name},
         {"vessel", b.vessel},
         {"parent",
          b.parent < 0 ? json(nullptr) : json(tree.branches()[static_cast<std::size_t>(b.parent)].name)},
         {"from_bifurcation", index_or_null(b.from_bifurcation)},
         {"to_bifurcation", index_or_null(b.to_bifurcation)},
         {"from_root_mm", b.from_root_mm},
         {"length_mm", b.length_mm},
         {"tortuosity", b.tortuosity},
         {"ostium_arc_mm", b.ostium_arc_mm},
         {"radius_mm", {{"min", b.min_radius_mm}, {"mean", b.mean_radius_mm}, {"max", b.max_radius_mm}}}});
  json bifurcations = json::array();
  for (const vessel::CentrelineBifurcation& f : tree.bifurcations())
    bifurcations.push_back({{"position_mm", vector_json(f.position_mm)}, {"radius_mm", f.radius_mm}});
  json ends = json::array();
  for (const vessel::CentrelineEnd& e : tree.ends())
    ends.push_back(
        {{"kind", name_of(e)},
         {"branch", tree.branches()[static_cast<std::size_t>(e.branch)].name},
         {"root", e.root},
         {"position_mm", vector_json(e.position_mm)},
         {"radius_mm", e.radius_mm},
         {"rejoins",
          e.rejoins < 0 ? json(nullptr) : json(tree.branches()[static_cast<std::size_t>(e.rejoins)].name)}});
  return {{"branches", branches}, {"bifurcations", bifurcations}, {"ends", ends}};
}

#ifdef ENDOWIRE_WITH_VTK

void write_centrelines_vtp(const fs::path& path, const CentrelineTree& tree) {
  const std::vector<CentrelinePoint>& all = tree.points();
  const std::vector<CentrelineBranch>& branches = tree.branches();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), all[i].position_mm.data());
  vtkNew<vtkCellArray> lines;
  std::vector<int> branch_of(all.size());
  for (std::size_t b = 0; b < branches.size(); ++b) {
    lines->InsertNextCell(static_cast<int>(branches[b].points));
    for (std::size_t i = 0; i < branches[b].points; ++i) {
      branch_of[branches[b].first_point + i] = static_cast<int>(b);
      lines->InsertCellPoint(static_cast<vtkIdType>(branches[b].first_point + i));
    }
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetLines(lines);
  vtkPointData& at = *poly->GetPointData();
  add_array<vtkDoubleArray>(at, "radius_mm", all.size(), [&](std::size_t i) { return all[i].radius_mm; });
  add_array<vtkDoubleArray>(at, "arc_mm", all.size(), [&](std::size_t i) { return all[i].arc_mm; });
  add_array<vtkDoubleArray>(at, "from_root_mm", all.size(), [&](std::size_t i) {
    return branches[static_cast<std::size_t>(branch_of[i])].from_root_mm + all[i].arc_mm;
  });
  add_array<vtkDoubleArray>(at, "curvature_per_mm", all.size(),
                            [&](std::size_t i) { return all[i].curvature_per_mm.norm(); });
  add_array<vtkIntArray>(at, "branch", all.size(), [&](std::size_t i) { return branch_of[i]; });
  vtkCellData& of = *poly->GetCellData();
  add_array<vtkIntArray>(of, "branch", branches.size(), [&](std::size_t b) { return static_cast<int>(b); });
  add_array<vtkIntArray>(of, "parent", branches.size(), [&](std::size_t b) { return branches[b].parent; });
  add_array<vtkDoubleArray>(of, "ostium_arc_mm", branches.size(),
                            [&](std::size_t b) { return branches[b].ostium_arc_mm; });
  add_array<vtkDoubleArray>(of, "length_mm", branches.size(),
                            [&](std::size_t b) { return branches[b].length_mm; });
  add_array<vtkDoubleArray>(of, "mean_radius_mm", branches.size(),
                            [&](std::size_t b) { return branches[b].mean_radius_mm; });
  vtkNew<vtkStringArray> names;
  names->SetName("branch_name");
  for (const CentrelineBranch& b : branches) names->InsertNextValue(b.name);
  poly->GetFieldData()->AddArray(names);

  write_vtp(path, *poly);
}

#else

void write_centrelines_vtp(const fs::path& path, const CentrelineTree&) {
  throw base::InputError(
      fmt::format("{}: cannot be written; this build has no VTK (ENDOWIRE_WITH_VTK is off)", path.string()));
}

#endif

}  // namespace endowire::io

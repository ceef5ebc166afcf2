// Centrelines beside those that others made of the same anatomies.
//
// aortoiliac        aorta-centerline.vtp was computed on this very surface (VMTK, maximal inscribed balls).
// femoral_to_neuro  the curves of 3D Slicer were computed on another, finer segmentation. They are in the frame of
//                   lumen_mm.stl as they stand (the table of README.md is in another one: its (a, b, c) is
//                   (−c, a, −b) here), but the mesh is a collision mesh made from it by hand: its aorta is 2 mm
//                   narrower, its carotids up to twice as wide, and a tenth of the curves' end pieces lies outside.
//                   So the curves tell whether a branch is missing, not how exact a centreline is: where the mesh
//                   has 0.7 times the stated radius around a curve, the curve is not in its middle.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "endowire/io/vessel_file.hpp"
#include "endowire/vessel/centreline.hpp"
#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/surface.hpp"

namespace endowire {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

struct ReferencePoint {
  Vector3d position_mm;
  double radius_mm;
};
using Reference = std::vector<ReferencePoint>;

fs::path shared(const std::string& name) {
  return fs::path(ENDOWIRE_SHARED_DIR) / "vessels" / name;
}

Reference read_vtp(const fs::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData& poly = *reader->GetOutput();
  vtkDataArray* radius = poly.GetPointData()->GetArray("MaximumInscribedSphereRadius");
  Reference points;
  for (vtkIdType i = 0; radius != nullptr && i < poly.GetNumberOfPoints(); ++i)
    points.push_back({Vector3d(poly.GetPoint(i)), radius->GetTuple1(i)});
  return points;
}

Reference read_markup(const fs::path& path) {
  const nlohmann::json file = nlohmann::json::parse(std::ifstream(path));
  const nlohmann::json& curve = file.at("markups").at(0);
  Reference points;
  for (const auto& point : curve.at("controlPoints")) {
    const auto p = point.at("position").get<std::array<double, 3>>();
    points.push_back({Vector3d(p[0], p[1], p[2]), 0.0});
  }
  for (const auto& measurement : curve.at("measurements")) {
    if (measurement.at("name") != "Radius") continue;
    const auto radii = measurement.at("controlPointValues").get<std::vector<double>>();
    for (std::size_t i = 0; i < points.size(); ++i) points[i].radius_mm = radii.at(i);
  }
  return points;
}

struct Distance {
  double mean_mm = 0.0;
  double mean_part = 0.0;  ///< of the reference's radius
  double worst_part = 0.0;
};

/// How far reference points are from the nearest point of the tree, whatever its branch.
Distance distance_from(const vessel::CentrelineTree& tree, const Reference& reference) {
  Distance d;
  for (const ReferencePoint& r : reference) {
    double least = 1e9;
    for (std::size_t b = 0; b < tree.branches().size(); ++b) {
      const auto p = tree.points_of(static_cast<std::int32_t>(b));
      for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        const Vector3d chord = p[i + 1].position_mm - p[i].position_mm;
        const double f =
            std::clamp((r.position_mm - p[i].position_mm).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (r.position_mm - p[i].position_mm - f * chord).norm());
      }
    }
    const auto count = static_cast<double>(reference.size());
    d.mean_mm += least / count;
    d.mean_part += least / r.radius_mm / count;
    d.worst_part = std::max(d.worst_part, least / r.radius_mm);
  }
  return d;
}

class AortoiliacReference : public testing::TestWithParam<const char*> {};

TEST_P(AortoiliacReference, IsWithinATenthOfTheRadius) {
  const fs::path mesh = shared("aortoiliac") / GetParam();
  const fs::path curve = shared("aortoiliac") / "aorta-centerline.vtp";
  if (!fs::exists(mesh) || !fs::exists(curve))
    GTEST_SKIP() << "no " << mesh << ": the shared vessels are not here";
  const vessel::CentrelineTree tree =
      vessel::extract_centrelines(io::read_vessel_file(mesh, vessel::LengthUnit::millimetre).repaired);
  const Reference reference = read_vtp(curve);
  ASSERT_GT(reference.size(), 300U);
  const Distance d = distance_from(tree, reference);
  std::printf("%s: %zu reference points, mean distance %.3f mm, %.3f of the radius, at most %.2f of it\n",
              GetParam(), reference.size(), d.mean_mm, d.mean_part, d.worst_part);
  EXPECT_LT(d.mean_part, 0.1);
  EXPECT_LT(d.worst_part, 0.75);  // near the bifurcation, where lines part sooner or later
  double radius_error = 0.0;
  for (const ReferencePoint& r : reference)
    radius_error += std::abs(tree.nearest(r.position_mm).radius_mm / r.radius_mm - 1.0);
  EXPECT_LT(radius_error / static_cast<double>(reference.size()), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Both, AortoiliacReference,
                         testing::Values("lumen_mm.stl", "aorta-surface-open-ends.stl"),
                         [](const auto& instance) {
                           return std::string(instance.index == 0 ? "Closed" : "Open");
                         });

class FemoralReference : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path mesh = shared("femoral_to_neuro") / "lumen_mm.stl";
    if (!fs::exists(mesh)) GTEST_SKIP() << "no " << mesh << ": the shared vessels are not here";
    repaired = io::read_vessel_file(mesh, vessel::LengthUnit::millimetre).repaired;
    for (const auto& entry : fs::directory_iterator(shared("femoral_to_neuro") / "centrelines"))
      curves.emplace_back(entry.path().filename().string(), read_markup(entry.path()));
    std::sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  vessel::RepairedMesh repaired;
  std::vector<std::pair<std::string, Reference>> curves;
};

TEST_F(FemoralReference, CurvesAreInTheFrameOfTheMeshAsTheyStand) {
  const vessel::ClosedSurface closed = vessel::close_surface(repaired, 1.0);
  const vessel::ExactSurface surface(closed.mesh);
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (std::size_t order = 0; order < orders.size(); ++order) {
    for (unsigned signs = 0; signs < 8; ++signs) {
      double inside = 0.0;
      double points = 0.0;
      for (const auto& [name, curve] : curves) {
        for (const ReferencePoint& r : curve) {
          Vector3d p;
          for (std::size_t k = 0; k < 3; ++k)
            p[static_cast<Eigen::Index>(k)] =
                ((signs >> k & 1U) != 0 ? -1.0 : 1.0) * r.position_mm[orders[order][k]];
          inside += surface.at(p).distance_mm > 0.0 ? 1.0 : 0.0;
          points += 1.0;
        }
      }
      if (order == 0 && signs == 0)
        EXPECT_GT(inside / points, 0.95);
      else
        EXPECT_LT(inside / points, 0.2) << "order " << order << ", signs " << signs;
    }
  }
}

TEST_F(FemoralReference, EveryBranchHasItsCounterpart) {
  const vessel::CentrelineTree tree = vessel::extract_centrelines(repaired);
  ASSERT_EQ(curves.size(), 25U);
  double sum_mm = 0.0;
  double points = 0.0;
  for (const auto& [name, curve] : curves) {
    const Distance d = distance_from(tree, curve);
    std::printf("%-34s %4zu points, mean distance %.2f mm, %.2f of the radius\n", name.c_str(), curve.size(),
                d.mean_mm, d.mean_part);
    // A branch of the tree runs along the curve: at the iliac ends mesh and anatomy are up to 6 mm apart.
    EXPECT_LT(d.mean_mm, curve.size() > 90 ? 3.0 : 8.0) << name;
    sum_mm += d.mean_mm * static_cast<double>(curve.size());
    points += static_cast<double>(curve.size());
  }
  std::printf("all: mean distance %.2f mm\n", sum_mm / points);
  EXPECT_LT(sum_mm / points, 2.2);  // as far as the collision mesh is from the anatomy
}

}  // namespace
}  // namespace endowire

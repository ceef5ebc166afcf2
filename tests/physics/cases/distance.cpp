// V15  Distance fields.
//
// Those of a sphere, a tube and a torus are exact: their gradient has length one, and from anywhere the wall lies at the distance they say,
// against it. Of a mesh, the field is that of its facets, which lie inside a round tube by up to the sagitta R(1 − cos π/n) of n facets
// round; the interpolant adds an error that it states.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "cases.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/random.hpp"
#include "facets.hpp"
#include "figures.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::test {

namespace {

using Eigen::Vector3d;

constexpr double kMicron = 1e3;
constexpr double kBillion = 1e9;
constexpr double kPi = std::numbers::pi;

Vector3d random_in(vessel::SplitMix& random, const Eigen::AlignedBox3d& box) {
  const double x = random.uniform();
  const double y = random.uniform();
  return box.min() + box.sizes().cwiseProduct(Vector3d(x, y, random.uniform()));
}

/// Between here and there a wire may touch the wall.
bool near_wall(double distance_mm) {
  return distance_mm > -0.3 && distance_mm < 1.0;
}

Facets compare(const TriangleMesh& mesh, const vessel::Field& exact, double sagitta_mm) {
  const vessel::RepairedMesh repaired = vessel::repair(mesh, "mesh");
  const vessel::MeshField field = vessel::MeshField::build(repaired);
  Facets result;
  result.sagitta_mm = sagitta_mm;
  result.stated_mm = field.error_mm();
  vessel::SplitMix random(1);
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : repaired.mesh.vertices_mm) box.extend(v);
  constexpr int kPoints = 20000;
  int near = 0;
  for (int n = 0; n < kPoints; ++n) {
    const Vector3d p = random_in(random, box);
    const double truth = exact.at(p).distance_mm;
    if (!near_wall(truth)) continue;
    ++near;
    const vessel::WallDistance found = field.at(p);
    result.error_mm = std::max(result.error_mm, std::abs(found.distance_mm - truth));
    result.slope_error += std::abs(found.gradient.norm() - 1.0);
  }
  result.slope_error /= near;
  return result;
}

}  // namespace

Facets facets_of_a_tube(int around) {
  constexpr double kRadius_mm = 3.0;
  return compare(open_tube(kRadius_mm, 30.0, static_cast<std::size_t>(around), 30),
                 vessel::TubeField(Vector3d::Zero(), Vector3d::UnitZ(), kRadius_mm),
                 kRadius_mm * (1.0 - std::cos(kPi / around)));
}

Checks analytic_fields() {
  struct Shape {
    const char* name;
    std::shared_ptr<vessel::Field> field;
  };
  Checks checks;
  for (const Shape& shape :
       {Shape{"sphere", std::make_shared<vessel::SphereField>(Vector3d(1, 2, 3), 9.0)},
        {"tube", std::make_shared<vessel::TubeField>(Vector3d(1, 2, 3), Vector3d(1, 2, 1), 4.0)},
        {"torus", std::make_shared<vessel::TorusField>(Vector3d(1, 2, 3), Vector3d(0, 1, 2), 25.0, 4.0)}}) {
    vessel::SplitMix random(1);
    const Eigen::AlignedBox3d box(Vector3d::Constant(-40.0), Vector3d::Constant(40.0));
    double slope = 0.0;
    double miss_mm = 0.0;
    constexpr int kPoints = 2000;
    for (int n = 0; n < kPoints; ++n) {
      const Vector3d p = random_in(random, box);
      const vessel::WallDistance w = shape.field->at(p);
      slope = std::max(slope, std::abs(w.gradient.norm() - 1.0));
      miss_mm = std::max(miss_mm, std::abs(shape.field->at(p - w.distance_mm * w.gradient).distance_mm));
    }
    const std::string name = shape.name;
    checks.push_back({"V15", name + ": largest error of the length of ∇φ [10⁻⁹]", "0", 0.0, kBillion * slope,
                      1.0, ErrorKind::absolute, "geometry"});
    checks.push_back({"V15", name + ": largest distance left at p − φ∇φ [10⁻⁹ mm]", "0", 0.0,
                      kBillion * miss_mm, 1.0, ErrorKind::absolute, "geometry"});
  }
  return checks;
}

Checks faceted_vessels() {
  constexpr double kBend_mm = 20.0;
  constexpr double kRadius_mm = 4.0;
  constexpr double kSphere_mm = 8.0;
  struct Mesh {
    std::string name;
    Facets facets;
  };
  const TriangleMesh ball = sphere(kSphere_mm, 4);
  double depth_mm = 0.0;  // of the flattest facet: its middle lies deepest under the sphere
  for (const auto& t : ball.triangles) {
    const auto corner = [&](std::size_t k) { return ball.vertices_mm[static_cast<std::size_t>(t[k])]; };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    depth_mm = std::max(depth_mm, kSphere_mm - std::abs(normal.dot(corner(0))));
  }
  Checks checks;
  for (const Mesh& mesh :
       {Mesh{"tube of 16 facets round", facets_of_a_tube(16)},
        {"tube of 32 facets round", facets_of_a_tube(32)},
        {"tube of 64 facets round", facets_of_a_tube(64)},
        {"sphere of 2048 facets", compare(ball, vessel::SphereField(Vector3d::Zero(), kSphere_mm), depth_mm)},
        {"torus of 96 × 32 facets",
         compare(torus(kBend_mm, kRadius_mm, 96, 32),
                 vessel::TorusField(Vector3d::Zero(), Vector3d::UnitZ(), kBend_mm, kRadius_mm),
                 kRadius_mm * (1.0 - std::cos(kPi / 32)) +
                     (kBend_mm + kRadius_mm) * (1.0 - std::cos(kPi / 96)))}}) {
    const Facets& f = mesh.facets;
    checks.push_back({"V15", mesh.name + ": largest error of φ [µm]", "≤ sagitta + stated error", 0.0,
                      kMicron * f.error_mm, kMicron * (f.sagitta_mm + f.stated_mm), ErrorKind::absolute,
                      "geometry"});
    checks.push_back({"V15", mesh.name + ": mean error of the length of ∇φ [%]", "0", 0.0,
                      1e2 * f.slope_error, 2.0, ErrorKind::absolute, "geometry"});
  }
  return checks;
}

Figure facets_figure() {
  Figure figure{"v15",
                "V15  Error of the field of a faceted tube, within sagitta and stated error",
                "facets round",
                "largest error [µm]",
                {},
                false,
                true,
                true};
  Series sagitta{Mark::line, {}, "sagitta"};
  Series stated{Mark::guide, {}, "and stated"};
  Series ours{Mark::rings, {}, ""};
  for (const int around : {8, 12, 16, 24, 32, 48, 64}) {
    const Facets f = facets_of_a_tube(around);
    sagitta.points.push_back({static_cast<double>(around), kMicron * f.sagitta_mm});
    stated.points.push_back({static_cast<double>(around), kMicron * (f.sagitta_mm + f.stated_mm)});
    ours.points.push_back({static_cast<double>(around), kMicron * f.error_mm});
  }
  figure.series = {sagitta, stated, ours};
  return figure;
}

}  // namespace endowire::test

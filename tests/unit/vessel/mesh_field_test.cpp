#include "endowire/vessel/mesh_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "endowire/vessel/inspect.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/surface.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

Vector3d random_in(SplitMix& random, const Eigen::AlignedBox3d& box) {
  return box.min() + box.sizes().cwiseProduct(Vector3d(random.uniform(), random.uniform(), random.uniform()));
}

/// The faceted surface lies inside the smooth one by at most `sagitta_mm`; the field adds its own error.
void expect_close_to(const Field& exact, const MeshField& field, const Eigen::AlignedBox3d& box,
                     double sagitta_mm) {
  SplitMix random(1);
  int near = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vector3d p = random_in(random, box);
    const double truth = exact.at(p).distance_mm;
    if (truth > 1.0 || truth < -0.3) continue;
    ++near;
    const double found = field.at(p).distance_mm;
    ASSERT_LE(found, truth + field.error_mm()) << p.transpose();
    ASSERT_GE(found, truth - sagitta_mm - field.error_mm()) << p.transpose();
  }
  EXPECT_GT(near, 500);
}

TEST(MeshField, SphereWithinTheSagitta) {
  const double radius = 8.0;
  const RepairedMesh mesh = repair(test::sphere(radius, 4), "sphere");
  const MeshField field = MeshField::build(mesh);
  EXPECT_LT(field.error_mm(), 0.03);
  // largest edge of the split octahedron: the arc between vertices spans at most 90°/2⁴ · 1.4
  const double sagitta = radius * (1.0 - std::cos(1.4 * 0.5 * std::numbers::pi / 16.0 / std::sqrt(3.0)));
  expect_close_to(SphereField(Vector3d::Zero(), radius), field, bounds_mm(mesh.mesh), sagitta);
  EXPECT_NEAR(field.lumen_radius_mm(Vector3d(7.0, 0.5, 0.3)), radius, 0.15);
}

TEST(MeshField, TubeWithinTheSagitta) {
  const double radius = 3.0;
  const RepairedMesh mesh = repair(test::open_tube(radius, 30.0, 32, 30), "tube");
  const MeshField field = MeshField::build(mesh);
  EXPECT_LT(field.error_mm(), 0.03);
  expect_close_to(TubeField(Vector3d::Zero(), Vector3d::UnitZ(), radius), field, bounds_mm(mesh.mesh),
                  radius * (1.0 - std::cos(std::numbers::pi / 32)));
  EXPECT_NEAR(field.lumen_radius_mm(Vector3d(1.0, 0.5, 12.0)), radius, 0.05);
}

TEST(MeshField, TorusWithinTheSagitta) {
  const double bend = 20.0;
  const double radius = 4.0;
  const RepairedMesh mesh = repair(test::torus(bend, radius, 96, 32), "torus");
  const MeshField field = MeshField::build(mesh);
  EXPECT_LT(field.error_mm(), 0.03);
  const double sagitta = radius * (1.0 - std::cos(std::numbers::pi / 32)) +
                         (bend + radius) * (1.0 - std::cos(std::numbers::pi / 96));
  const TorusField exact(Vector3d::Zero(), Vector3d::UnitZ(), bend, radius);
  // Inside the bend the facets' chords lie outside the torus instead: allow the sagitta there, too.
  SplitMix random(2);
  int near = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vector3d p = random_in(random, bounds_mm(mesh.mesh));
    const double truth = exact.at(p).distance_mm;
    if (truth > 1.0 || truth < -0.3) continue;
    ++near;
    ASSERT_NEAR(field.at(p).distance_mm, truth, sagitta + field.error_mm()) << p.transpose();
  }
  EXPECT_GT(near, 500);
}

TEST(MeshField, GradientIsTheDerivativeOfTheValueAndHasLengthOne) {
  const RepairedMesh mesh = repair(test::torus(20.0, 4.0, 96, 32), "torus");
  const MeshField field = MeshField::build(mesh);
  const TorusField exact(Vector3d::Zero(), Vector3d::UnitZ(), 20.0, 4.0);
  SplitMix random(3);
  int tested = 0;
  double norm_error = 0.0;
  for (int n = 0; n < 40000; ++n) {
    const Vector3d p = random_in(random, bounds_mm(mesh.mesh));
    if (std::abs(exact.at(p).distance_mm - 0.35) > 0.65) continue;
    const double h = 1e-3;
    // Both sides in one brick: across a border the interpolants differ by their errors.
    if (field.spacing_mm(p) > 0.9) continue;
    Vector3d difference;
    bool smooth = true;
    const double curvature_scale = 4.0 * field.error_mm() / (field.spacing_mm(p) * field.spacing_mm(p));
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      const WallDistance ahead = field.at(p + step);
      const WallDistance behind = field.at(p - step);
      difference[k] = (ahead.distance_mm - behind.distance_mm) / (2.0 * h);
      smooth = smooth && (ahead.gradient - behind.gradient).norm() < 2.0 * h * (curvature_scale + 1.0);
    }
    if (!smooth) continue;
    ++tested;
    const Vector3d gradient = field.at(p).gradient;
    ASSERT_LT((gradient - difference).norm(), 5e-3) << p.transpose();
    norm_error += std::abs(gradient.norm() - 1.0);
  }
  EXPECT_GT(tested, 1000);
  EXPECT_LT(norm_error / tested, 0.02);
}

TEST(MeshField, ContinuousAcrossBricks) {
  const MeshField field = MeshField::build(repair(test::torus(20.0, 4.0, 96, 32), "torus"));
  SplitMix random(4);
  for (int n = 0; n < 20000; ++n) {  // along short paths near the wall a jump cannot hide
    const double u = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double v = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double r = 4.0 - random.uniform(-0.3, 1.0);
    const Vector3d p((20.0 + r * std::cos(v)) * std::cos(u), (20.0 + r * std::cos(v)) * std::sin(u),
                     r * std::sin(v));
    const Vector3d q =
        p + 1e-5 * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    ASSERT_NEAR(field.at(p).distance_mm, field.at(q).distance_mm, 2.0 * field.error_mm() + 1e-4);
  }
}

TEST(MeshField, EitherOrientationAndAnyOrderGiveTheSameField) {
  const TriangleMesh mesh = test::closed_tube(3.0, 20.0, 16, 10);
  TriangleMesh inward = mesh;
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  const std::vector<std::byte> expected = MeshField::build(repair(mesh, "m")).serialise();
  EXPECT_EQ(MeshField::build(repair(inward, "m")).serialise(), expected);
  EXPECT_EQ(MeshField::build(repair(test::shuffled(mesh, 9), "m")).serialise(), expected);
}

TEST(MeshField, OpeningsContinueAsVirtualTubes) {
  const RepairedMesh mesh = repair(test::open_tube(3.0, 30.0, 32, 30), "tube");
  const MeshField field = MeshField::build(mesh);
  ASSERT_EQ(mesh.openings.size(), 2U);
  for (const Opening& o : mesh.openings) {
    EXPECT_EQ(field.exit_at(o.centre_mm - 1.0 * o.direction), 0);
    for (double along : {0.5, 10.0, 55.0}) {
      const Vector3d p = o.centre_mm + along * o.direction;
      EXPECT_EQ(field.exit_at(p), o.number);
      EXPECT_NEAR(field.at(p + Vector3d(2.5, 0.0, 0.0)).distance_mm, 0.5, 0.05);
      EXPECT_NEAR(field.at(p + Vector3d(3.2, 0.0, 0.0)).distance_mm, -0.2, 0.05);
    }
    EXPECT_GT(field.at(o.centre_mm).distance_mm, 2.5);
  }
}

TEST(MeshField, PinHolesAreWall) {
  TriangleMesh mesh = test::closed_tube(5.0, 40.0, 24, 40);
  Vector3d hole = Vector3d::Zero();
  for (std::size_t t = 900; t < 902; ++t)
    for (std::size_t k = 0; k < 3; ++k) hole += mesh.corner(t, k) / 6.0;
  mesh.triangles.erase(mesh.triangles.begin() + 900, mesh.triangles.begin() + 902);
  const MeshField field = MeshField::build(repair(mesh, "m"));
  const Vector3d outward = Vector3d(hole.x(), hole.y(), 0.0).normalized();
  EXPECT_NEAR(field.at(hole).distance_mm, 0.0, 0.05);
  EXPECT_NEAR(field.at(hole + outward).distance_mm, -1.0, 0.1);
  EXPECT_NEAR(field.at(hole - outward).distance_mm, 1.0, 0.1);
  EXPECT_EQ(field.exit_at(hole + outward), 0);
}

TEST(MeshField, FarAwayIsBoundedNegativeAndLeadsBack) {
  const MeshField field = MeshField::build(repair(test::closed_tube(3.0, 30.0, 24, 10), "m"));
  for (const Vector3d& p : {Vector3d(200.0, 0.0, 15.0), Vector3d(-9.0, 8.0, 3.0), Vector3d(0.0, 0.0, -1e6)}) {
    const WallDistance w = field.at(p);
    EXPECT_LE(w.distance_mm, -2.5);
    EXPECT_TRUE(std::isfinite(w.distance_mm));
    EXPECT_GT(w.gradient.dot(Vector3d(0.0, 0.0, 15.0) - p), 0.0);
    EXPECT_GT(field.lumen_radius_mm(p), 0.0);
  }
}

TEST(MeshField, TissueBetweenTwoLumens) {
  TriangleMesh mesh = test::closed_tube(3.0, 30.0, 24, 30);
  const TriangleMesh copy = mesh;
  const auto shift = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (const auto& v : copy.vertices_mm)
    mesh.vertices_mm.push_back(v + Vector3d(8.0, 0.0, 0.0));  // 2 mm apart
  for (const auto& t : copy.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  const MeshField field = MeshField::build(repair(mesh, "two"));
  EXPECT_NEAR(field.tissue_to_next_lumen_mm(Vector3d(2.9, 0.0, 15.0)), 2.0, 0.1);
  EXPECT_NEAR(field.tissue_to_next_lumen_mm(Vector3d(5.1, 0.0, 15.0)), 2.0, 0.1);
  EXPECT_TRUE(std::isinf(field.tissue_to_next_lumen_mm(Vector3d(-2.9, 0.0, 15.0))));
}

class StoredField : public testing::Test {
 protected:
  RepairedMesh mesh = repair(test::open_tube(3.0, 12.0, 16, 8), "m");
  MeshField field = MeshField::build(mesh);
  std::uint64_t key = MeshField::key(mesh);
  std::vector<std::byte> bytes = field.serialise();
};

TEST_F(StoredField, RoundTripIsBitIdentical) {
  const MeshField loaded = MeshField::deserialise(bytes, key, "cache");
  EXPECT_EQ(loaded.serialise(), bytes);
  SplitMix random(6);
  for (int n = 0; n < 1000; ++n) {
    const Vector3d p(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-70, 80));
    EXPECT_EQ(field.at(p).distance_mm, loaded.at(p).distance_mm);
    EXPECT_EQ(field.at(p).gradient, loaded.at(p).gradient);
    EXPECT_EQ(field.exit_at(p), loaded.exit_at(p));
    EXPECT_EQ(field.lumen_radius_mm(p), loaded.lumen_radius_mm(p));
  }
  EXPECT_EQ(loaded.error_mm(), field.error_mm());
}

TEST_F(StoredField, DamageAndForeignBytesAreRefused) {
  EXPECT_THROW(static_cast<void>(MeshField::deserialise(bytes, key + 1, "cache")), base::InputError);
  EXPECT_THROW(static_cast<void>(MeshField::deserialise({}, key, "cache")), base::InputError);
  const std::vector<std::byte> noise(1000, std::byte{0x5a});
  EXPECT_THROW(static_cast<void>(MeshField::deserialise(noise, key, "cache")), base::InputError);
  for (std::size_t part = 1; part < 20; ++part) {
    const std::vector<std::byte> cut(bytes.begin(),
                                     bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * part / 20));
    EXPECT_THROW(static_cast<void>(MeshField::deserialise(cut, key, "cache")), base::InputError);
  }
  SplitMix random(7);
  for (int n = 0; n < 50; ++n) {
    std::vector<std::byte> flipped = bytes;
    flipped[random.next() % bytes.size()] ^= static_cast<std::byte>(1U << (random.next() % 8));
    EXPECT_THROW(static_cast<void>(MeshField::deserialise(flipped, key, "cache")), base::InputError);
  }
}

TEST_F(StoredField, TheKeyFollowsMeshAndParameters) {
  FieldParameters other;
  other.error_target_mm *= 2.0;
  EXPECT_NE(MeshField::key(mesh, other), key);
  EXPECT_NE(MeshField::key(repair(test::open_tube(3.0, 12.1, 16, 8), "m")), key);
  EXPECT_EQ(MeshField::key(repair(test::shuffled(test::open_tube(3.0, 12.0, 16, 8), 3), "m")), key);
}

TEST(Inspect, SaysWhatWasFoundAndDone) {
  const RepairedMesh mesh = repair(test::open_tube(3.0, 30.0, 32, 30), "tube.stl");
  const VesselReport report = inspect("tube.stl", mesh, MeshField::build(mesh));
  ASSERT_EQ(report.openings.size(), 2U);
  EXPECT_NEAR(report.openings[1].virtual_tube_mm, 60.0, 1e-9);
  EXPECT_NEAR(report.field.lumen_diameter_percentiles_mm[2], 6.0, 0.1);
  EXPECT_EQ(report.mesh.triangles, 32U * 30U * 2U);
  EXPECT_GT(report.field.bricks, 0U);
}

}  // namespace
}  // namespace endowire::vessel

// Samples are close together where the wall is uneven along the wire, so that forces do not depend on where they lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "endowire/contact/contact_set.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "support/chain_states.hpp"
#include "support/fields.hpp"
#include "support/wires.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector3d;

constexpr double kRadius_mm = 0.4445;

/// A straight wire along z over a carina whose edge crosses it at z = 0.
class OverAnEdge : public testing::Test {
 protected:
  OverAnEdge() : line_(test::curved_tip_wire(0.0)), arcs_(test::even_arcs(12, 4.0)) {
    rod::fill_material(line_, arcs_, 0.0, 0.0, material_);
    set_.reserve(12, 1000);
  }
  /// @param beyond_mm  length of wire beyond the edge, towards the tip
  /// @param height_mm  of the axis above the edge
  void lay(double beyond_mm, double height_mm, const Vector3d& direction = Vector3d::UnitZ()) {
    const Vector3d over(height_mm, 0.0, 0.0);
    shape_ = test::straight_chain(arcs_, over - (48.0 - beyond_mm) * direction, direction);
  }
  void detect() {
    set_.begin(wire(), {});
    set_.place(wire(), 11, field_, spec_);
    set_.detect(wire(), field_, spec_);
    static_cast<void>(set_.energy_mj(shape_));
  }
  [[nodiscard]] Vector3d total_force() const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < set_.samples().size(); ++i) sum += set_.normal_force_n(shape_, i);
    return sum;
  }
  /// Force of the wall on a straight wire whose axis passes the edge at this height: of all its length, in the direction away from it.
  [[nodiscard]] double force_over_edge_n(double height_mm) const {
    const Sample& any = set_.samples()[set_.samples().size() / 2];
    constexpr double kStep_mm = 1e-4;
    double force = 0.0;
    for (double s = -1.0; s < 1.0; s += kStep_mm) {
      const double distance = std::hypot(height_mm, s);
      const WallResponse w =
          wall_response(wall_stiffness_n_per_mm2(spec_.wall, any.lumen_radius_mm, kRadius_mm), any.cap_mm,
                        kRadius_mm - distance);
      force += w.force_n * kStep_mm * height_mm / distance;
    }
    return force;
  }
  [[nodiscard]] Wire wire() const { return {line_, material_, shape_}; }

  test::CarinaField field_{0.6, 8.0};
  rod::MaterialLine line_;
  std::vector<double> arcs_;
  rod::ChainMaterial material_;
  rod::ChainShape shape_;
  ContactSet set_;
  ContactSpec spec_;
};

// Wherever the edge lies between samples, the wall pushes with the force of the law integrated along the wire, and not along it.
// Breaks with samples as far apart as the lumen alone asks for: they feel the edge, or not, by where they lie.
TEST_F(OverAnEdge, TheForceIsTheIntegralOfTheLaw) {
  // The wire touches 0.27 and 0.42 mm of its length: two and three of the closest samples.
  for (const auto& [depth, tolerance] : {std::pair{0.02, 0.16}, std::pair{0.05, 0.05}}) {
    const double height = kRadius_mm - depth;
    double mean = 0.0;
    int places = 0;
    for (double beyond = 20.2; beyond < 24.0; beyond += 0.0171) {
      lay(beyond, height);
      detect();
      const Vector3d force = total_force();
      const double expected = force_over_edge_n(height);
      EXPECT_NEAR(force.x(), expected, tolerance * expected) << depth << " " << beyond;
      EXPECT_LT(std::abs(force.z()), tolerance * expected) << "a frictionless edge pushes along the wire";
      mean += force.x() / expected;
      ++places;
    }
    EXPECT_NEAR(mean / places, 1.0, 0.01) << depth;
  }
}

// Close together at the edge only: a straight wire touches nothing else.
TEST_F(OverAnEdge, SamplesAreCloseWhereTheWireTouches) {
  lay(21.3, kRadius_mm - 0.02);
  detect();
  double widest_at_edge = 0.0;
  int close = 0;
  for (std::size_t i = 1; i < set_.samples().size(); ++i) {
    const double from = set_.samples()[i - 1].arc_mm;
    const double gap = set_.samples()[i].arc_mm - from;
    if (std::abs(from + 0.5 * gap - 21.3) < 0.2) widest_at_edge = std::max(widest_at_edge, gap);
    if (gap < 0.5) ++close;
  }
  EXPECT_LE(widest_at_edge, ContactSet::kFinest_mm * (1.0 + 1e-9));
  EXPECT_LE(close, 20);
  lay(21.3, kRadius_mm + 0.2);
  detect();
  for (std::size_t i = 1; i < set_.samples().size(); ++i)
    EXPECT_GT(set_.samples()[i].arc_mm - set_.samples()[i - 1].arc_mm, 1.0);
}

// Along a flat or hollow wall the clearance is the same all along, and the lumen alone sets the spacing.
TEST_F(OverAnEdge, AnEvenWallNeedsNoCloseSamples) {
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 3.0);
  lay(22.0, 3.0 - kRadius_mm + 0.02);
  set_.begin(wire(), {});
  set_.place(wire(), 11, tube, spec_);
  for (std::size_t i = 1; i < set_.samples().size(); ++i)
    EXPECT_NEAR(set_.samples()[i].arc_mm - set_.samples()[i - 1].arc_mm, 1.0, 1e-9);
}

// Memory is bounded: where room is short the samples stay that the lumen asks for.
TEST_F(OverAnEdge, ShortRoomIsLeftToTheWholeWire) {
  lay(21.3, kRadius_mm - 0.02);
  detect();
  const std::size_t wanted = set_.samples().size();
  ContactSet small;
  small.reserve(12, 30);
  small.begin(wire(), {});
  small.place(wire(), 11, field_, spec_);
  EXPECT_LT(small.samples().size(), wanted);
  EXPECT_GE(small.samples().size(), 22u);
  EXPECT_EQ(small.samples().back().arc_mm, set_.samples().back().arc_mm);
}

// A step begins where the last one ended: samples that lie elsewhere on the wire find where they were, and what was in the sheath
// comes from its end.
TEST_F(OverAnEdge, SamplesStartWhereTheirMaterialWas) {
  lay(21.3, kRadius_mm - 0.02);
  set_.begin(wire(), {});
  for (Vector3d& x : shape_.joints_mm) x.z() += 0.7;
  set_.place(wire(), 11, field_, spec_);
  for (const Sample& s : set_.samples())
    EXPECT_LT((s.position_mm(shape_) - s.start_mm - 0.7 * Vector3d::UnitZ()).norm(), 1e-12);
}

// Close samples, and those that are added over ridges, divide the wire among them: stretches follow each other, none is
// negative, each holds its sample. Breaks when an added sample takes a stretch that another still uses.
TEST_F(OverAnEdge, StretchesPartitionTheWire) {
  for (double beyond = 20.0; beyond < 24.0; beyond += 0.13) {
    for (const double tilt : {-0.06, 0.0, 0.06}) {
      lay(beyond, kRadius_mm + 0.5, Vector3d(tilt, 0.3 * tilt, 1.0).normalized());
      detect();
      int added = 0;
      for (int k = 0; k < 12; ++k) {
        for (Vector3d& x : shape_.joints_mm) x += Vector3d(-0.05, 0.0, 0.08);
        static_cast<void>(set_.verify(wire(), field_, spec_));
        added += set_.add_over_ridges(wire(), field_);
        set_.redetect(wire(), field_, spec_);
      }
      double end = 0.0;
      for (const Sample& s : set_.samples()) {
        EXPECT_EQ(s.from_mm, end);
        EXPECT_GT(s.share_mm(), 0.0);
        EXPECT_LE(s.from_mm, s.arc_mm);
        EXPECT_GE(s.to_mm, s.arc_mm);
        EXPECT_GE(s.stiffness_n_per_mm, 0.0);
        end = s.to_mm;
      }
    }
  }
}

}  // namespace
}  // namespace endowire::contact

// Samples follow the crest of the wall: a straight wire over an edge is the contact of a line with an edge.
#include "endowire/contact/crest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  }
  /// @param beyond_mm  length of wire beyond the edge, towards the tip
  /// @param height_mm  of the axis above the edge
  void lay(double beyond_mm, double height_mm, const Vector3d& direction = Vector3d::UnitZ()) {
    const Vector3d over(height_mm, 0.0, 0.0);
    shape_ = test::straight_chain(arcs_, over - (48.0 - beyond_mm) * direction, direction);
  }
  void detect() {
    set_.place(wire(), 11, field_, spec_, {});
    set_.detect(wire(), field_, spec_);
    static_cast<void>(set_.energy_mj(shape_));
  }
  [[nodiscard]] Vector3d total_force() const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < set_.samples().size(); ++i) sum += set_.normal_force_n(shape_, i);
    return sum;
  }
  [[nodiscard]] const Sample& pressed() const {
    return *std::max_element(set_.samples().begin(), set_.samples().end(),
                             [](const Sample& a, const Sample& b) { return a.normal_n < b.normal_n; });
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

// Wherever the edge lies between two samples, it is felt at the edge, square to the wire, with one and the same force.
// Breaks with samples that stay at their places: between two of them the force would fall to nothing.
TEST_F(OverAnEdge, FeelsTheEdgeWhereItIs) {
  std::vector<double> forces;
  for (double beyond = 20.2; beyond < 24.0; beyond += 0.171) {
    lay(beyond, kRadius_mm - 0.05);
    detect();
    const Sample& s = pressed();
    if (std::abs(s.nominal_mm - beyond) < 0.05) continue;
    EXPECT_TRUE(s.at_crest);
    EXPECT_NEAR(s.arc_mm, beyond, 0.05);
    EXPECT_LT((s.crest_normal.normalized() - Vector3d::UnitX()).norm(), 0.05);
    EXPECT_LE(s.from_mm, s.arc_mm);
    EXPECT_GE(s.to_mm, s.arc_mm);
    const Vector3d force = total_force();
    EXPECT_LT(std::abs(force.z()), 0.02 * force.x()) << "a frictionless edge pushes along the wire";
    forces.push_back(force.x());
  }
  ASSERT_GE(forces.size(), 15u);
  const auto [least, most] = std::minmax_element(forces.begin(), forces.end());
  EXPECT_GT(*least, 0.01);
  EXPECT_LT(*most, 1.02 * *least);
}

// As the wire slides over the edge its contact stays with the edge and moves along the wire, detection by detection.
TEST_F(OverAnEdge, TheContactStaysWithTheEdge) {
  lay(21.3, kRadius_mm - 0.05);
  detect();
  const double first = pressed().arc_mm;
  for (int k = 0; k < 4; ++k) {
    for (Vector3d& x : shape_.joints_mm) x.z() += 0.2;
    set_.mark_outside(shape_, 0.1);
    EXPECT_GT(set_.redetect(wire(), field_, spec_), 0);
    static_cast<void>(set_.energy_mj(shape_));
    EXPECT_LT(std::abs(pressed().position_mm(shape_).z()), 0.05) << k;
  }
  EXPECT_NEAR(pressed().arc_mm - first, 0.8, 0.1);
}

// The tip is a point that meets walls head-on: it stays the tip.
TEST_F(OverAnEdge, TheTipStaysTheTip) {
  lay(0.4, kRadius_mm - 0.05);
  detect();
  EXPECT_EQ(set_.samples().front().arc_mm, 0.0);
  EXPECT_FALSE(set_.samples().front().at_crest);
}

// Along a flat or hollow wall nothing is nearer than anything else.
TEST_F(OverAnEdge, ThereIsNoCrestInATube) {
  const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), 3.0);
  lay(22.0, 3.0 - kRadius_mm + 0.02);
  set_.place(wire(), 11, tube, spec_, {});
  set_.detect(wire(), tube, spec_);
  for (const Sample& s : set_.samples()) {
    EXPECT_FALSE(s.at_crest);
    EXPECT_EQ(s.arc_mm, s.nominal_mm);
  }
}

// Samples that are added over ridges and samples at crests divide the wire among them: stretches follow each other, none is
// negative, each holds its sample and its nominal place. Breaks when an added sample takes a stretch that another still uses.
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
        EXPECT_LE(s.from_mm, s.nominal_mm);
        EXPECT_GE(s.to_mm, s.nominal_mm);
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

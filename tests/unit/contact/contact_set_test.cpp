#include "endowire/contact/contact_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>

#include "endowire/vessel/analytic_field.hpp"
#include "support/chain_states.hpp"
#include "support/fields.hpp"
#include "support/taylor.hpp"
#include "support/wires.hpp"

namespace endowire::contact {
namespace {

using Eigen::Vector3d;

/// A wire laid along the wall of a vessel, pressed into it a little more or less along its length.
class PressedWire : public testing::Test {
 protected:
  PressedWire() : line_(test::curved_tip_wire(0.2)), arcs_(test::even_arcs(10, 3.0)) {
    rod::fill_material(line_, arcs_, 0.0, 0.0, material_);
  }

  /// Every joint at its own depth, along a curve on the wall of the torus or tube.
  void lay(const vessel::Field& field, const std::function<Vector3d(double)>& axis, test::Random& random) {
    std::vector<Vector3d> joints;
    for (const double arc : arcs_) {
      Vector3d p = axis(arc);
      for (int k = 0; k < 50; ++k) {
        const vessel::WallDistance w = field.at(p);
        p += (0.4445 - 0.03 - w.distance_mm) * w.gradient;
      }
      joints.push_back(p + 0.01 * random.vector());
    }
    shape_ = test::straight_chain(arcs_, Vector3d::Zero(), Vector3d::UnitZ());
    std::vector<double> d(4 * arcs_.size(), 0.0);
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto k = static_cast<Eigen::Index>(c);
        d[4 * i + c] = joints[i][k] - shape_.joints_mm[i][k];
      }
      d[4 * i + 3] = 0.3 * random.normal();
    }
    shape_ = test::moved_chain(shape_, d, 1.0);
  }

  void place_and_detect(const vessel::Field& field) {
    set_.reserve(20, 1000);
    const FrictionMemory none;
    set_.begin(wire(), none);
    set_.place(wire(), static_cast<int>(arcs_.size()) - 1, field, spec_);
    set_.detect(wire(), field, spec_);
    static_cast<void>(set_.energy_mj(shape_));
    set_.renew_lagged();
  }

  [[nodiscard]] Wire wire() const { return {line_, material_, shape_}; }
  [[nodiscard]] Wire wire_at(const rod::ChainShape& shape) const { return {line_, material_, shape}; }

  /// Taylor slopes of the energy in random directions of all unknowns at `at`.
  void check_derivatives(const rod::ChainShape& at, test::Random& random, const std::string& what,
                         double step) {
    math::BandMatrix hessian;
    hessian.resize(static_cast<int>(4 * arcs_.size()));
    for (int trial = 0; trial < 8; ++trial) {
      std::vector<double> d = test::random_direction(4 * arcs_.size(), random);
      hessian.set_zero();
      std::vector<double> gradient(d.size(), 0.0);
      ContactModel model;
      const double energy = set_.linearise(at, {}, hessian, gradient, model);
      // What the walls' curvature gives, and what the model gives without any motion, make the whole Hessian.
      std::vector<double> model_gradient(d.size(), 0.0);
      const ModelPart part = model.add_derivatives(
          std::vector<double>(d.size(), 0.0), solve::ContactHessian::present, {}, hessian, model_gradient);
      EXPECT_GT(part.energy_mj, 0.0);
      for (std::size_t i = 0; i < d.size(); ++i) EXPECT_NEAR(model_gradient[i], gradient[i], 1e-12) << i;
      EXPECT_NEAR(energy, set_.energy_mj(at), 1e-12 * (1.0 + energy));
      const double curvature = test::quadratic(hessian, d);
      EXPECT_GT(std::abs(curvature), 1e-3) << what;
      EXPECT_GT(std::sqrt(test::dot(gradient, gradient)), 1e-3) << what;
      test::expect_taylor([&](double h) { return set_.energy_mj(test::moved_chain(at, d, h)); },
                          test::dot(gradient, d), curvature,
                          energy + std::sqrt(test::dot(gradient, gradient)), what, step);
    }
  }

  int touching() const {
    return static_cast<int>(std::count_if(set_.samples().begin(), set_.samples().end(),
                                          [](const Sample& s) { return s.normal_n > 0.0; }));
  }

  rod::MaterialLine line_;
  std::vector<double> arcs_;
  rod::ChainMaterial material_;
  rod::ChainShape shape_;
  ContactSet set_;
  ContactSpec spec_;
};

const auto kTube = std::make_shared<vessel::TubeField>(Vector3d::Zero(), Vector3d::UnitZ(), 3.0);
const auto kTorus = std::make_shared<vessel::TorusField>(Vector3d::Zero(), Vector3d::UnitY(), 25.0, 3.0);

Vector3d along_tube(double arc) {
  return {2.0, 0.5, 30.0 - arc};
}
Vector3d along_torus(double arc) {
  const double angle = arc / 27.0;
  return {27.0 * std::cos(angle), 0.4, 27.0 * std::sin(angle)};
}

// Walls alone, then walls with friction that sticks, slides along and slides round. Breaks with any missing product rule
// between sample, rod and spin.
TEST_F(PressedWire, TaylorSlopes) {
  test::Random random(71);
  for (const bool curved : {false, true}) {
    const vessel::Field& field = curved ? static_cast<const vessel::Field&>(*kTorus) : *kTube;
    lay(field, curved ? along_torus : along_tube, random);
    place_and_detect(field);
    ASSERT_GE(touching(), 8);
    check_derivatives(shape_, random, "walls, anchors at rest", 1e-4);
    // Everything moved by a part of the stick length, and by many of them, along the wire and about it.
    for (const auto& [name, along, spin] :
         {std::tuple{"sticks", 1e-3, 1e-3}, std::tuple{"slides along", 0.2, 0.0},
          std::tuple{"turns", 0.0, 0.6}, std::tuple{"slides and turns", 0.1, 0.3}}) {
      std::vector<double> d(4 * arcs_.size(), 0.0);
      for (std::size_t i = 0; i < arcs_.size(); ++i) {
        const Vector3d e = shape_.frames[std::min(i, arcs_.size() - 2)].col(2);
        for (std::size_t c = 0; c < 3; ++c) d[4 * i + c] = along * e[static_cast<Eigen::Index>(c)];
        d[4 * i + 3] = spin;
      }
      check_derivatives(test::moved_chain(shape_, d, 1.0), random, name, 1e-4);
    }
  }
}

// Every millimetre of wire is stood for once, so that forces do not depend on the sampling. The half interval before the
// last joint, which lies in the sheath, is left out.
TEST_F(PressedWire, SharesAddUpToTheLength) {
  test::Random random(72);
  for (const double lumen : {0.7, 1.5, 3.0, 12.0}) {
    const vessel::TubeField tube(Vector3d::Zero(), Vector3d::UnitZ(), lumen);
    shape_ = test::straight_chain(arcs_, Vector3d::Zero(), Vector3d::UnitZ());
    set_.begin(wire(), {});
    set_.place(wire(), 10, tube, spec_);
    double sum = 0.0;
    double last_arc = -1.0;
    for (const Sample& s : set_.samples()) {
      sum += s.share_mm();
      EXPECT_GT(s.arc_mm, last_arc);
      EXPECT_LE(s.arc_mm - std::max(0.0, last_arc), std::min(0.5 * lumen, spec_.max_share_mm) + 1e-9);
      last_arc = s.arc_mm;
      EXPECT_NEAR((s.position_mm(shape_) - Vector3d(0, 0, 30.0 - s.arc_mm)).norm(), 0.0, 1e-12);
    }
    EXPECT_NEAR(sum, 30.0 - 0.5 * (30.0 - last_arc), 1e-12) << lumen;
    EXPECT_EQ(set_.samples().front().arc_mm, 0.0);
  }
}

// The wall's force per length does not depend on how many samples it is measured with.
TEST_F(PressedWire, TotalForceDoesNotDependOnTheSampling) {
  std::vector<double> totals;
  for (const double share : {2.0, 1.0, 0.5}) {
    spec_.max_share_mm = share;
    shape_ = test::straight_chain(arcs_, Vector3d(3.0 - 0.4445 + 0.03, 0.0, 0.0), Vector3d::UnitZ());
    place_and_detect(*kTube);
    double total = 0.0;
    for (const Sample& s : set_.samples()) total += s.normal_n;
    // By length: the half interval at the sheath is not stood for.
    double length = 0.0;
    for (const Sample& s : set_.samples()) length += s.share_mm();
    const Sample& tip = set_.samples().front();
    const double cap_force =
        tip.normal_n * tip_cap_stiffness_n_per_mm(spec_.wall, tip.radius_mm) / tip.stiffness_n_per_mm;
    totals.push_back((total - cap_force) / length);
  }
  EXPECT_GT(totals[0], 0.01);
  EXPECT_NEAR(totals[1], totals[0], 1e-9 * totals[0]);
  EXPECT_NEAR(totals[2], totals[0], 1e-9 * totals[0]);
}

/// Largest differences between the walls' forces after a displacement and those that the field asks for there.
struct Correction {
  double worst_gap_mm = 0.0;
  double worst_force_n = 0.0;
  double largest_force_n = 0.0;
  double largest_change_n = 0.0;  ///< against the force before the displacement
};

// Force correction against re-detection on the same state (design, section 4): the step moves, the walls do not, and the
// forces agree with those that the wall distance at the new place gives. Breaks when the gaps do not follow the displacement
// (the change of force is tenfold the difference allowed) or follow a plane.
TEST_F(PressedWire, CorrectedForcesAgreeWithTheFieldAfterADisplacement) {
  test::Random random(73);
  for (const bool curved : {false, true}) {
    const vessel::Field& field = curved ? static_cast<const vessel::Field&>(*kTorus) : *kTube;
    Correction found;
    for (int trial = 0; trial < 20; ++trial) {
      lay(field, curved ? along_torus : along_tube, random);
      place_and_detect(field);
      // Slides along and round the wall by up to 0.5 mm, and in or out a little.
      rod::ChainShape there = shape_;
      const double round = random.uniform(-0.35, 0.35);
      const double along = random.uniform(-0.35, 0.35);
      for (std::size_t i = 0; i < arcs_.size(); ++i) {
        const Vector3d n = field.at(shape_.joints_mm[i]).gradient;
        const Vector3d e = shape_.frames[std::min(i, arcs_.size() - 2)].col(2);
        const double target = field.at(shape_.joints_mm[i]).distance_mm + 0.02 * random.normal();
        Vector3d p = shape_.joints_mm[i] + along * e + round * n.cross(e);
        for (int k = 0; k < 20; ++k) {
          const vessel::WallDistance w = field.at(p);
          p += (target - w.distance_mm) * w.gradient;
        }
        there.joints_mm[i] = p;
      }
      for (std::size_t i = 0; i < set_.samples().size(); ++i) {
        const Sample& s = set_.samples()[i];
        double model = HUGE_VAL;
        const Vector3d u = s.position_mm(there) - s.detected_at_mm;
        for (int w = 0; w < s.walls; ++w)
          model = std::min(model, local_height_mm(s.wall[static_cast<std::size_t>(w)], u));
        const vessel::WallDistance exact = field.at(s.position_mm(there));
        const double gap = std::abs(model - exact.distance_mm);
        if (std::min(model, exact.distance_mm) < s.radius_mm)
          found.worst_gap_mm = std::max(found.worst_gap_mm, gap);
        const auto force_at = [&](double height) {
          return wall_response(s.stiffness_n_per_mm, s.cap_mm, s.radius_mm - height).force_n;
        };
        const Vector3d asked = force_at(exact.distance_mm) * exact.gradient;
        const double difference = (set_.normal_force_n(there, i) - asked).norm();
        found.worst_force_n = std::max(found.worst_force_n, difference);
        found.largest_force_n = std::max(found.largest_force_n, asked.norm());
        found.largest_change_n =
            std::max(found.largest_change_n, (asked - set_.normal_force_n(shape_, i)).norm());
        // What the allowed error of a gap makes of the force there.
        const double stiffness = wall_response(s.stiffness_n_per_mm, s.cap_mm,
                                               s.radius_mm - exact.distance_mm + spec_.gap_error_mm)
                                     .stiffness_n_per_mm;
        EXPECT_LE(difference, stiffness * spec_.gap_error_mm + 0.1 * asked.norm() + 1e-9) << i;
      }
    }
    EXPECT_LE(found.worst_gap_mm, curved ? spec_.gap_error_mm : 5e-4);
    if (!curved) {
      EXPECT_LT(found.worst_force_n, 0.02 * found.largest_force_n);
    }
    EXPECT_GT(found.largest_force_n, 0.02);
    EXPECT_GT(found.largest_change_n, 10.0 * found.worst_force_n);
    RecordProperty(curved ? "torus_gap_um" : "tube_gap_um", static_cast<int>(1000.0 * found.worst_gap_mm));
    RecordProperty(curved ? "torus_force_mn" : "tube_force_mn",
                   static_cast<int>(1000.0 * found.worst_force_n));
  }
}

// What is remembered at one state is recalled at the next: tractions and forces by material arc, whatever the sampling.
TEST_F(PressedWire, FrictionIsRememberedByMaterialArc) {
  test::Random random(74);
  lay(*kTube, along_tube, random);
  place_and_detect(*kTube);
  std::vector<double> d(4 * arcs_.size(), 0.0);
  for (std::size_t i = 0; i < arcs_.size(); ++i) d[4 * i + 2] = 0.004;
  const rod::ChainShape there = test::moved_chain(shape_, d, 1.0);
  static_cast<void>(set_.energy_mj(there));
  FrictionMemory memory;
  set_.remember(there, memory);
  ASSERT_EQ(memory.arc_mm.size(), set_.samples().size());
  double largest = 0.0;
  for (const Eigen::Vector2d& t : memory.traction_n_per_mm) largest = std::max(largest, t.norm());
  EXPECT_GT(largest, 1e-4);
  ContactSet next;
  next.reserve(20, 1000);
  next.begin(wire_at(there), memory);
  next.place(wire_at(there), 10, *kTube, spec_);
  ASSERT_EQ(next.samples().size(), memory.arc_mm.size());
  for (std::size_t i = 0; i < memory.arc_mm.size(); ++i) {
    EXPECT_EQ(next.samples()[i].traction_n_per_mm, memory.traction_n_per_mm[i]);
    EXPECT_NEAR(next.samples()[i].lagged_normal_n, set_.samples()[i].normal_n, 1e-12);
  }
  // Nothing moves for many steps: the tractions stay to the last digits, also those at the limit.
  FrictionMemory now = memory;
  for (int step = 0; step < 1000; ++step) {
    next.begin(wire_at(there), now);
    next.place(wire_at(there), 10, *kTube, spec_);
    next.detect(wire_at(there), *kTube, spec_);
    static_cast<void>(next.energy_mj(there));
    next.remember(there, now);
  }
  for (std::size_t i = 0; i < memory.arc_mm.size(); ++i) {
    EXPECT_LT((now.traction_n_per_mm[i] - memory.traction_n_per_mm[i]).norm(), 1e-9) << i;
  }
}

// Lag: an estimate of nothing while nothing changes, large after the forces have doubled, zero again once renewed.
TEST_F(PressedWire, LagErrorSeesChangedForces) {
  test::Random random(75);
  lay(*kTube, along_tube, random);
  place_and_detect(*kTube);
  EXPECT_LT(set_.lag_error(), 1e-12);
  rod::ChainShape deeper = shape_;
  for (Vector3d& x : deeper.joints_mm) x -= 0.03 * kTube->at(x).gradient;
  static_cast<void>(set_.energy_mj(deeper));
  EXPECT_GT(set_.lag_error(), 0.3);
  set_.renew_lagged();
  EXPECT_LT(set_.lag_error(), 1e-12);
}

// Turning the wire while it slides takes the axial part of its friction away: the easing of a stuck wire.
TEST_F(PressedWire, TurningEasesSliding) {
  test::Random random(76);
  lay(*kTube, along_tube, random);
  place_and_detect(*kTube);
  const auto axial_force = [&](double along, double spin) {
    std::vector<double> d(4 * arcs_.size(), 0.0);
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      d[4 * i + 2] = along;
      d[4 * i + 3] = spin;
    }
    const rod::ChainShape there = test::moved_chain(shape_, d, 1.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < set_.samples().size(); ++i) sum += set_.friction_force_n(there, i).z();
    return sum;
  };
  const double sliding = axial_force(0.5, 0.0);
  const double turning = axial_force(0.5, 5.0);
  EXPECT_LT(sliding, -0.01) << "friction acts against the motion";
  double normal = 0.0;
  for (const Sample& s : set_.samples()) normal += s.lagged_normal_n;
  EXPECT_NEAR(sliding, -0.2 * normal, 0.01 * 0.2 * normal);
  EXPECT_NEAR(turning / sliding, 0.5 / std::hypot(0.5, 5.0 * 0.4445), 0.03);
}

}  // namespace
}  // namespace endowire::contact

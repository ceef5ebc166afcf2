// What wires leak through elsewhere: curved tips turned against a wall and in a narrowing, dead ends, lumens hardly wider than the wire,
// lumens side by side, carinas head-on, ostia, coarse facets, enormous commands, wires of every stiffness. The judge finds no
// crossing in any of it, and a step that does not converge says so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "support/generated_meshes.hpp"
#include "support/swept_meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thin_wire.hpp"
#include "support/wires.hpp"
#include "vessel_run.hpp"

namespace endowire {
namespace {

using Eigen::Vector3d;
constexpr double kDegree = std::numbers::pi / 180.0;

/// A vessel, a wire and what the hand does.
struct Ordeal {
  vessel::TriangleMesh mesh;
  sim::Access access;
  rod::Instrument wire = test::hydrophilic_wire();
  std::vector<sim::Command> commands;
};

void repeat(std::vector<sim::Command>& commands, int times, const sim::Command& command) {
  commands.insert(commands.end(), static_cast<std::size_t>(times), command);
}

/// A catheter of 2.3 mm radius, its last 30 mm bent by 60°.
rod::Instrument thick_catheter() {
  rod::Instrument catheter = test::uniform_wire(600.0, 460.0, 30.0);
  rod::Section& tip = catheter.sections[0];
  tip.radius_mm = {2.3, 2.3};
  tip.axial_rigidity_n = {3000.0, 3000.0};
  tip.linear_density_g_per_mm = 0.02;
  tip.friction = 0.1;
  tip.rest_curvature_per_mm = 60.0 * kDegree / tip.length_mm;
  catheter.sections.push_back(tip);
  catheter.sections[1].length_mm = 600.0;
  catheter.sections[1].rest_curvature_per_mm = 0.0;
  catheter.grip_force_n = 10.0;
  catheter.grip_torque_n_mm = 50.0;
  return catheter;
}

/// The axis of a bend with its radius [mm] at every point, from what a function of the share of its length says.
vessel::TriangleMesh bent(double straight_mm, double bend_mm, double angle_rad, std::size_t around,
                          double step_mm, const std::function<double(double)>& radius_mm) {
  const std::vector<Vector3d> curve = test::bent_curve(straight_mm, bend_mm, angle_rad, step_mm);
  std::vector<double> radius;
  for (std::size_t i = 0; i < curve.size(); ++i)
    radius.push_back(radius_mm(static_cast<double>(i) / static_cast<double>(curve.size() - 1)));
  return test::swept_tube(curve, radius, around, true);
}

/// On the axis, a little way in.
sim::Access along_z(double z_mm = 4.0) {
  return {{0.0, 0.0, z_mm}, Vector3d::UnitZ()};
}

/// A thick catheter pushed round a bend of 25 mm whose lumen is 4.5 mm at its sharpest and 9 mm at its ends, and turned everywhere on the way.
Ordeal tip_turned_in_a_narrowing() {
  Ordeal o;
  o.mesh = bent(60.0, 25.0, 100.0 * kDegree, 32, 2.0,
                [](double t) { return 9.0 - 4.5 * std::exp(-std::pow((t - 0.5) / 0.15, 2.0)); });
  o.access = along_z();
  o.wire = thick_catheter();
  repeat(o.commands, 45, {1.0, 0.0});
  for (int k = 0; k < 6; ++k) {
    repeat(o.commands, 72, {0.0, 10.0 * kDegree});
    repeat(o.commands, 12, {1.0, 0.0});
    repeat(o.commands, 36, {0.0, -10.0 * kDegree});
  }
  return o;
}

Ordeal tip_turned_in_a_chamber() {
  Ordeal o;
  o.mesh = bent(50.0, 60.0, 60.0 * kDegree, 32, 2.5,
                [](double t) { return 5.0 + 20.0 * std::exp(-std::pow((t - 0.6) / 0.15, 2.0)); });
  o.access = along_z();
  o.wire = thick_catheter();
  repeat(o.commands, 110, {1.0, 0.0});
  for (int k = 0; k < 5; ++k) {
    repeat(o.commands, 72, {0.0, 10.0 * kDegree});
    repeat(o.commands, 8, {1.0, 5.0 * kDegree});
  }
  return o;
}

Ordeal three_metres_into_a_dead_end() {
  Ordeal o;
  o.mesh = test::closed_tube(4.0, 120.0, 24, 40);
  o.access = along_z();
  repeat(o.commands, 300, {10.0, 0.0});
  return o;
}

/// A lumen of 0.55 mm through two bends.
Ordeal lumen_of_half_a_millimetre() {
  Ordeal o;
  o.mesh = bent(30.0, 8.0, 120.0 * kDegree, 16, 0.7, [](double) { return 0.55; });
  o.access = along_z(1.0);
  o.wire = test::thin_wire();
  repeat(o.commands, 70, {1.0, 0.0});
  repeat(o.commands, 72, {0.0, 10.0 * kDegree});
  repeat(o.commands, 40, {-1.0, 5.0 * kDegree});
  repeat(o.commands, 40, {1.0, -5.0 * kDegree});
  return o;
}

/// A hairpin whose legs, of 1.5 mm, run 0.2 mm apart.
Ordeal lumens_side_by_side() {
  Ordeal o;
  o.mesh = bent(60.0, 1.6, std::numbers::pi, 24, 0.8, [](double) { return 1.5; });
  o.access = along_z();
  o.wire = test::thin_wire();
  repeat(o.commands, 130, {1.0, 0.0});
  repeat(o.commands, 72, {0.0, 10.0 * kDegree});
  repeat(o.commands, 60, {-1.0, 10.0 * kDegree});
  repeat(o.commands, 60, {1.0, -10.0 * kDegree});
  return o;
}

struct Pipe {
  Vector3d from_mm, to_mm;
  double radius_mm;
};

/// A lumen of pipes with round ends, by marching tetrahedra.
vessel::TriangleMesh tree(const std::vector<Pipe>& pipes) {
  constexpr double kSpacing_mm = 0.9;
  Eigen::AlignedBox3d box;
  for (const Pipe& pipe : pipes) {
    const Vector3d margin = Vector3d::Constant(pipe.radius_mm + 2.0 * kSpacing_mm);
    for (const Vector3d& end : {pipe.from_mm, pipe.to_mm}) {
      box.extend(end + margin);
      box.extend(end - margin);
    }
  }
  return test::surface_of(
      [&](const Vector3d& p) {
        double least = HUGE_VAL;
        for (const Pipe& pipe : pipes)
          least = std::min(least, test::capsule(p, pipe.from_mm, pipe.to_mm, pipe.radius_mm));
        return least;
      },
      box, kSpacing_mm);
}

/// A straight wire pushed at the carina between two equal branches, again and again.
Ordeal carina_head_on() {
  Ordeal o;
  const Vector3d fork(0.0, 0.0, 60.0);
  o.mesh = tree(
      {{Vector3d::Zero(), fork, 4.0}, {fork, {25.0, 0.0, 110.0}, 3.0}, {fork, {-25.0, 0.0, 110.0}, 3.0}});
  o.access = along_z();
  o.wire.sections[0].rest_curvature_per_mm = 0.0;
  for (int k = 0; k < 6; ++k) {
    repeat(o.commands, 95, {1.0, 0.0});
    repeat(o.commands, 60, {-1.0, 0.0});
    repeat(o.commands, 3, {0.0, 10.0 * kDegree});
    repeat(o.commands, 35, {-1.0, 0.0});
  }
  return o;
}

/// A curved tip swept past side branches, to and fro, turning.
Ordeal ostia_swept_past() {
  Ordeal o;
  o.mesh = tree({{Vector3d::Zero(), {0.0, 0.0, 140.0}, 4.5},
                 {{0.0, 0.0, 40.0}, {25.0, 0.0, 55.0}, 2.5},
                 {{0.0, 0.0, 75.0}, {0.0, 25.0, 70.0}, 1.5},
                 {{0.0, 0.0, 105.0}, {-20.0, -10.0, 120.0}, 2.0}});
  o.access = along_z();
  repeat(o.commands, 20, {1.0, 0.0});
  for (int k = 0; k < 4; ++k) {
    repeat(o.commands, 110, {1.0, 7.0 * kDegree});
    repeat(o.commands, 110, {-1.0, 3.0 * kDegree});
  }
  return o;
}

/// Six facets round a bend, each 5 mm long.
Ordeal coarse_facets() {
  Ordeal o;
  o.mesh = bent(40.0, 25.0, 120.0 * kDegree, 6, 5.0, [](double) { return 3.5; });
  o.access = along_z();
  repeat(o.commands, 110, {1.0, 0.0});
  repeat(o.commands, 72, {0.0, 10.0 * kDegree});
  repeat(o.commands, 80, {-1.0, 5.0 * kDegree});
  return o;
}

/// Ten millimetres and ten turns in one command, forward and back.
Ordeal enormous_commands() {
  Ordeal o;
  o.mesh = bent(40.0, 25.0, 120.0 * kDegree, 24, 2.0, [](double) { return 3.5; });
  o.access = along_z();
  for (const double advance_mm : {10.0, 10.0, 10.0, 10.0, -10.0, 10.0, 10.0, 10.0, 10.0, -10.0})
    repeat(o.commands, 1, {advance_mm, 20.0 * std::numbers::pi});
  return o;
}

/// A wire of one bending stiffness, its tip bent by 45°, round a bend of 40 mm.
Ordeal wire_of_stiffness(double flexural_n_mm2) {
  Ordeal o;
  o.mesh = bent(50.0, 40.0, 120.0 * kDegree, 24, 2.0, [](double) { return 4.0; });
  o.access = along_z();
  o.wire = test::curved_tip_wire(0.1);
  for (rod::Section& section : o.wire.sections) {
    section.flexural_rigidity_n_mm2 = {flexural_n_mm2, flexural_n_mm2};
    section.torsional_rigidity_n_mm2 = {flexural_n_mm2 / 1.3, flexural_n_mm2 / 1.3};
  }
  // A bend of radius R asks for EI/2R² and as much again for friction.
  o.wire.grip_force_n = std::max(2.0, flexural_n_mm2 / 500.0);
  o.wire.grip_torque_n_mm = std::max(2.0, flexural_n_mm2 / 20.0);
  repeat(o.commands, 140, {1.0, 0.0});
  repeat(o.commands, 72, {0.0, 10.0 * kDegree});
  repeat(o.commands, 60, {-1.0, 5.0 * kDegree});
  return o;
}

struct Named {
  const char* name;
  Ordeal (*make)();
};

std::ostream& operator<<(std::ostream& out, const Named& named) {
  return out << named.name;
}

class Torture : public testing::TestWithParam<Named> {};

TEST_P(Torture, NothingCrossesAWall) {
  const Ordeal ordeal = GetParam().make();
  const test::TemporaryFolder folder;
  const test::Vessel vessel = test::made_vessel(ordeal.mesh, folder.path());
  std::size_t next = 0;
  const test::RunFigures run = test::play(
      vessel, ordeal.access, static_cast<int>(ordeal.commands.size()),
      [&](const sim::Simulation&) { return ordeal.commands[next++]; }, folder.path(), ordeal.wire);
  std::printf("%s: %s\n", GetParam().name, run.text().c_str());
  ASSERT_TRUE(run.verdict.is_object()) << "check_crossings gave no verdict";
  EXPECT_EQ(run.verdict["steps"], run.recorded);
  EXPECT_EQ(run.verdict["crossings"], 0) << run.crossings_text();
  EXPECT_EQ(run.converged, run.steps) << run.first_failure;
  EXPECT_LE(run.on_edges, 0.05 * run.substeps) << "walls swing";
}

std::string name_of(const testing::TestParamInfo<Named>& named) {
  return named.param.name;
}

INSTANTIATE_TEST_SUITE_P(Vessels, Torture,
                         testing::Values(Named{"tip_turned_in_a_narrowing", tip_turned_in_a_narrowing},
                                         Named{"tip_turned_in_a_chamber", tip_turned_in_a_chamber},
                                         Named{"three_metres_into_a_dead_end", three_metres_into_a_dead_end},
                                         Named{"lumen_of_half_a_millimetre", lumen_of_half_a_millimetre},
                                         Named{"lumens_side_by_side", lumens_side_by_side},
                                         Named{"carina_head_on", carina_head_on},
                                         Named{"ostia_swept_past", ostia_swept_past},
                                         Named{"coarse_facets", coarse_facets},
                                         Named{"enormous_commands", enormous_commands},
                                         Named{"stiffness_1", [] { return wire_of_stiffness(1.0); }},
                                         Named{"stiffness_10", [] { return wire_of_stiffness(10.0); }},
                                         Named{"stiffness_100", [] { return wire_of_stiffness(100.0); }},
                                         Named{"stiffness_1000", [] { return wire_of_stiffness(1000.0); }},
                                         Named{"stiffness_5000", [] { return wire_of_stiffness(5000.0); }}),
                         name_of);

}  // namespace
}  // namespace endowire

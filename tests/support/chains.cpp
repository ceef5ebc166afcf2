#include "support/chains.hpp"

#include <algorithm>
#include <limits>

#include "endowire/math/transport.hpp"

namespace endowire::test {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

rod::Section uniform_section(double flexural_rigidity_n_mm2, double length_mm) {
  constexpr double kPoisson = 0.3;       // EI/GJ = 1 + ν of a round section
  constexpr double kRigid_n = 1e5;       // EA: closed forms know no stretch; stiffer costs digits
  constexpr double kRadius_mm = 0.4445;  // 0.035"
  rod::Section section;
  section.length_mm = length_mm;
  section.flexural_rigidity_n_mm2 = {flexural_rigidity_n_mm2, flexural_rigidity_n_mm2};
  const double torsional = flexural_rigidity_n_mm2 / (1.0 + kPoisson);
  section.torsional_rigidity_n_mm2 = {torsional, torsional};
  section.axial_rigidity_n = {kRigid_n, kRigid_n};
  section.radius_mm = {kRadius_mm, kRadius_mm};
  return section;
}

rod::Instrument uniform_wire(double flexural_rigidity_n_mm2, double length_mm) {
  rod::Instrument wire;
  wire.model = "uniform";
  wire.sections = {uniform_section(flexural_rigidity_n_mm2, length_mm)};
  return wire;
}

Chain::Chain(const rod::Instrument& wire, int rods, double length_mm, double gravity_m_per_s2)
    : line(wire), rod_length_mm(length_mm) {
  std::vector<double> arc(at(rods + 1));
  for (int i = 0; i <= rods; ++i) arc[at(i)] = i * rod_length_mm;
  rod::fill_material(line, arc, gravity_m_per_s2, 0.0, problem.material);
  problem.line = &line;
  lay_straight();
}

void Chain::lay_straight() {
  rod::ChainShape& shape = problem.shape;
  const int n = problem.material.rods();
  shape.resize(n);
  for (int i = 0; i <= n; ++i) shape.joints_mm[at(i)] = Eigen::Vector3d((n - i) * rod_length_mm, 0.0, 0.0);
  for (rod::Frame& frame : shape.frames) {
    frame.col(0) = Eigen::Vector3d::UnitY();
    frame.col(1) = Eigen::Vector3d::UnitZ();
    frame.col(2) = Eigen::Vector3d::UnitX();
  }
  std::fill(shape.spin_rad.begin(), shape.spin_rad.end(), 0.0);
  std::fill(shape.twist_rad.begin(), shape.twist_rad.end(), 0.0);
  problem.release_all();
}

namespace {

/// The frame of a rod that turned to another direction.
rod::Frame transported(const rod::Frame& frame, const Eigen::Vector3d& tangent) {
  rod::Frame result;
  result.col(0) = math::normal_part(math::parallel_transport(frame.col(0), frame.col(2), tangent), tangent);
  result.col(1) = tangent.cross(result.col(0));
  result.col(2) = tangent;
  return result;
}

}  // namespace

void Chain::lay_untwisted(const std::vector<Eigen::Vector3d>& joints_mm) {
  rod::ChainShape& shape = problem.shape;
  shape.joints_mm = joints_mm;
  const int n = shape.rods();
  for (int i = n - 1; i >= 0; --i) {
    const rod::Frame& from = shape.frames[at(i == n - 1 ? i : i + 1)];
    shape.frames[at(i)] = transported(from, (joints_mm[at(i)] - joints_mm[at(i + 1)]).normalized());
  }
  std::fill(shape.twist_rad.begin(), shape.twist_rad.end(), 0.0);
}

void Chain::move_joints(const std::vector<Eigen::Vector3d>& joints_mm) {
  rod::ChainShape& shape = problem.shape;
  shape.joints_mm = joints_mm;
  for (int i = 0; i < shape.rods(); ++i) {
    rod::Frame& frame = shape.frames[at(i)];
    frame = transported(frame, (joints_mm[at(i)] - joints_mm[at(i + 1)]).normalized());
  }
  for (int j = 1; j < shape.rods(); ++j) {
    shape.twist_rad[at(j)] =
        rod::twist_between(shape.frames[at(j)], shape.frames[at(j - 1)], shape.twist_rad[at(j)]);
  }
}

void Chain::spin(int rod, double angle_rad) {
  rod::ChainShape& shape = problem.shape;
  rod::Frame& frame = shape.frames[at(rod)];
  frame.col(0) = math::spin_about(frame.col(0), frame.col(2), angle_rad);
  frame.col(1) = frame.col(2).cross(frame.col(0));
  shape.spin_rad[at(rod)] += angle_rad;
  if (rod > 0) shape.twist_rad[at(rod)] -= angle_rad;
  if (rod + 1 < shape.rods()) shape.twist_rad[at(rod + 1)] += angle_rad;
}

void Chain::keep_plane() {
  for (int i = 0; i < problem.shape.rods(); ++i) {
    problem.hold_joint(i, false, false, true);
    problem.hold_spin(i);
  }
}

solve::NewtonSpec statics_spec() {
  solve::NewtonSpec spec;
  spec.correction_tolerance_mm = 1e-7;  // discretisation is what these tests measure
  spec.correction_tolerance_rad = 1e-9;
  spec.max_step_mm = 1e3;
  spec.max_turn_rad = 10.0;
  spec.max_iterations = 200;
  return spec;
}

double nan_unless_converged(const solve::SolveReport& report) {
  return report.converged() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace endowire::test

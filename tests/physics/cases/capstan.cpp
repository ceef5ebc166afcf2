// V10  Capstan: a wire without bending stiffness is pulled through a bend of total angle Θ against a dead force at its tip.
//
//   F_out = F_in exp(μ Θ)
//
// The wire lies on the inside of an analytic tube of little clearance; the hand draws it back in steps, each with its detection, its
// minimisation and its friction remembered, as a simulation does, until all of it slides.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cases.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kBendRadius_mm = 20.0;
constexpr double kStraight_mm = 15.0;  // before and behind the bend
constexpr double kClearance_mm = 0.01;
constexpr double kRod_mm = 1.0;
constexpr double kTip_n = 1.0;
constexpr double kLimp_n_mm2 = 2e-3;  // EI/R² is 5e-6 N, against 1 N
constexpr double kStiff_mpa = 1000.0;

/// Joints of a wire on the inside of the bend, the tip first.
std::vector<Eigen::Vector3d> joints_inside(const vessel::BentTubeField& tube, int rods) {
  std::vector<Eigen::Vector3d> joints;
  for (int i = 0; i <= rods; ++i) {
    // The inside is shorter than the centreline: places are counted on the inside, from the hand.
    const double shorter = (kBendRadius_mm - kClearance_mm) / kBendRadius_mm;
    const double inside_mm = (rods - i) * kRod_mm - kStraight_mm;
    const double bend_mm = tube.bend_length_mm();
    const double s = inside_mm < 0.0                 ? inside_mm
                     : inside_mm < bend_mm * shorter ? inside_mm / shorter
                                                     : inside_mm + bend_mm * (1.0 - shorter);
    const Eigen::Vector3d t = tube.tangent(s);
    joints.emplace_back(tube.centreline_mm(s) + kClearance_mm * Eigen::Vector3d(-t.y(), t.x(), 0.0));
  }
  return joints;
}

/// Tension at the hand once the whole wire slides.
double pull_n(double friction, double angle_rad) {
  rod::Instrument wire = uniform_wire(kLimp_n_mm2, 500.0);
  wire.sections[0].friction = friction;
  const vessel::BentTubeField tube(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(),
                                   Eigen::Vector3d::UnitY(), kBendRadius_mm, angle_rad,
                                   wire.sections[0].radius_mm.at_tip_side + kClearance_mm);
  const int rods = static_cast<int>((2.0 * kStraight_mm + tube.bend_length_mm()) / kRod_mm);
  Chain chain(wire, rods, kRod_mm);
  chain.lay_untwisted(joints_inside(tube, rods));
  sim::ChainProblem& problem = chain.problem;
  problem.clamp_hand_end();
  problem.loads.tip_force_n = kTip_n * tube.tangent(tube.bend_length_mm());

  contact::ContactSpec contact_spec;
  contact_spec.wall.modulus_mpa = kStiff_mpa;
  solve::NewtonSpec spec = statics_spec();
  spec.lag_tolerance = 1e-4;
  solve::Newton newton;
  contact::FrictionMemory memory;
  // All slides after a step; then the mean over the length of a rod, which joints passing the ends of the bend make ripple.
  constexpr int kSteps = 10;
  constexpr double kStep_mm = kRod_mm / kSteps;
  double sum_n = 0.0;
  for (int step = 0; step < 2 * kSteps; ++step) {
    const contact::Wire seen{chain.line, problem.material, problem.shape};
    problem.contact.begin(seen, memory);
    problem.contact.place(seen, rods - 1, tube, contact_spec);
    if (step > 0) {  // every joint moves along its own rod, away from the tip
      std::vector<Eigen::Vector3d> joints = problem.shape.joints_mm;
      for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        joints[i] += kStep_mm * (problem.shape.joints_mm[i + 1] - problem.shape.joints_mm[i]).normalized();
      }
      joints.back().x() -= kStep_mm;
      chain.move_joints(joints);
    }
    problem.contact.detect(seen, tube, contact_spec);
    const bool converged = newton.minimise(problem, spec).converged();
    if (!converged ||
        problem.contact.verify(seen, tube, contact_spec).gap_error_mm > contact_spec.gap_error_mm) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    problem.contact.remember(problem.shape, memory);
    if (step >= kSteps) sum_n += rod::axial_force_n(problem.material, problem.shape, rods - 2);
  }
  return sum_n / kSteps;
}

}  // namespace

Checks capstan() {
  Checks checks;
  for (const auto& [angle_rad, name] : {std::pair{0.5 * std::numbers::pi, "π/2"}, {std::numbers::pi, "π"}}) {
    for (const double friction : {0.1, 0.2, 0.3}) {
      checks.push_back({"V10",
                        std::string("hand force over tip force, Θ = ") + name +
                            ", μ = " + std::to_string(friction).substr(0, 3),
                        "exp(μΘ)", std::exp(friction * angle_rad), pull_n(friction, angle_rad) / kTip_n, 1e-2,
                        ErrorKind::relative, "Euler and Eytelwein"});
    }
  }
  return checks;
}

Figure capstan_figure() {
  Figure figure{"v10", "V10  Capstan: bends of π/2 and π", "μΘ", "F_out/F_in", {}};
  Series exact{Mark::line, {}, ""};
  Series ours{Mark::rings, {}, ""};
  constexpr double kMost = 1.0;
  constexpr double kStep = 0.02;
  for (double x = 0.0; x < kMost; x += kStep) exact.points.push_back({x, std::exp(x)});
  for (const double angle_rad : {0.5 * std::numbers::pi, std::numbers::pi}) {
    for (const double friction : {0.1, 0.2, 0.3})
      ours.points.push_back({friction * angle_rad, pull_n(friction, angle_rad) / kTip_n});
  }
  figure.series = {exact, ours};
  return figure;
}

}  // namespace endowire::test

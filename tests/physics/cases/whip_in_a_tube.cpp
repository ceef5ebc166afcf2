// V8b  Torque whip in contact: a wire of rest curvature κ0 lies in a tight bend and is turned at the hand, no friction.
//
//   GJ α'' = EI κ0 κt sin α,  α' = 0 at the tip,  Λ = L √(EI κ0 κt/GJ)
//
// A whole simulation: the wire is fed until a length L lies in the bend, and turned in steps of 1°. Its angles are read where the bend
// starts and at the tip. Clearance lets the wire leave the middle of the tube; it is kept small.
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "cases.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "figures.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kTubeRadius_mm = 40.0;
constexpr double kRestCurvature_per_mm = 1.0 / 30.0;
constexpr double kClearance_mm = 0.005;
constexpr double kInlet_mm = 5.0;
constexpr double kRod_mm = 1.0;
constexpr double kStiff_mpa = 1000.0;

/// The angles of hand and tip, pair by pair, as the hand turns.
struct Turning {
  double length_mm = 0.0;         ///< of wire in the bend
  std::vector<double> hand_rad;   ///< at the sheath
  std::vector<double> start_rad;  ///< where the bend starts
  std::vector<double> tip_rad;

  /// Angle at the start of the bend at which the tip comes to an angle.
  [[nodiscard]] double start_for_tip_rad(double tip) const {
    for (std::size_t i = 1; i < tip_rad.size(); ++i) {
      if (tip_rad[i] < tip) continue;
      const double w = (tip - tip_rad[i - 1]) / (tip_rad[i] - tip_rad[i - 1]);
      return start_rad[i - 1] + w * (start_rad[i] - start_rad[i - 1]);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

/// The wire comes along x through a straight piece of tube, where the sheath ends; the bend towards y starts at the origin.
Turning turn_in_bend(double lambda, double most_rad) {
  rod::Instrument wire = uniform_wire(10.0, 200.0);
  rod::Section& section = wire.sections[0];
  const double bent_n = section.flexural_rigidity_n_mm2.at_tip_side * kRestCurvature_per_mm / kTubeRadius_mm;
  const double length_mm = lambda * std::sqrt(section.torsional_rigidity_n_mm2.at_tip_side / bent_n);
  section.rest_curvature_per_mm = kRestCurvature_per_mm;
  // A wire along x enters with its first director along z; the inside of the bend is a quarter turn back from it.
  section.rest_plane_rad = -0.5 * kPi;

  sim::SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  spec.wall.modulus_mpa = kStiff_mpa;
  spec.solver.rods.adaptive = false;
  spec.solver.rods.rod_length_mm = kRod_mm;
  spec.solver.correction_tolerance_mm =
      1e-6;  // the figures are tabulated: their digits must not hang on the path
  spec.solver.correction_tolerance_deg = 1e-5;
  const Eigen::Vector3d centre_mm(0.0, kTubeRadius_mm, 0.0);
  const auto tube = std::make_shared<vessel::BentTubeField>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(),
                                                            centre_mm, kTubeRadius_mm, kPi,
                                                            section.radius_mm.at_tip_side + kClearance_mm);
  sim::Simulation simulation(tube, wire, {Eigen::Vector3d(-kInlet_mm, 0.0, 0.0), Eigen::Vector3d::UnitX()},
                             spec);

  /// Angle of the rest curvature of a rod against the inside of the tube, in the branch nearest to another angle.
  const auto angle_rad = [&](std::size_t rod, double near_rad) {
    const sim::State& state = simulation.state();
    const Eigen::Vector3d e = (state.joints_mm[rod] - state.joints_mm[rod + 1]).normalized();
    const Eigen::Vector3d rest = -e.cross(state.directors[rod]);
    const Eigen::Vector3d middle = 0.5 * (state.joints_mm[rod] + state.joints_mm[rod + 1]);
    Eigen::Vector3d inside =
        middle.x() < 0.0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d(centre_mm - middle);
    inside.z() = 0.0;
    const double angle = std::atan2(inside.cross(rest).dot(e), inside.dot(rest));
    return angle + 2.0 * kPi * std::round((near_rad - angle) / (2.0 * kPi));
  };
  /// Where the bend starts, between the middles of two rods.
  const auto start_rad = [&] {
    const auto& joints = simulation.state().joints_mm;
    const auto middle = [&](std::size_t rod) { return 0.5 * (joints[rod].x() + joints[rod + 1].x()); };
    std::size_t rod = joints.size() - 3;
    while (rod > 0 && middle(rod) < 0.0) --rod;
    const double w = middle(rod) / (middle(rod) - middle(rod + 1));
    const double hand = simulation.state().hand_turn_rad;
    return (1.0 - w) * angle_rad(rod, hand) + w * angle_rad(rod + 1, hand);
  };

  Turning result;
  result.length_mm = length_mm;
  const sim::StepReport& report = simulation.step({kInlet_mm + length_mm, 0.0});
  if (!report.converged || std::abs(report.hand_slip_mm) > kRod_mm * 0.01) return result;
  do {
    result.hand_rad.push_back(simulation.state().hand_turn_rad);
    result.start_rad.push_back(start_rad());
    result.tip_rad.push_back(angle_rad(0, simulation.state().spin_rad.front()));
  } while (result.hand_rad.back() < most_rad && simulation.step({0.0, kDegree}).converged);
  return result;
}

}  // namespace

Checks whip_in_a_tube() {
  constexpr double kTolerance_deg = 5.0;
  Checks checks;
  for (const double lambda : {0.5, 1.0, 1.5}) {
    const Turning turning = turn_in_bend(lambda, 210.0 * kDegree);
    for (const int tip_deg : {30, 60, 90, 120, 150}) {
      const double tip = tip_deg * kDegree;
      checks.push_back({"V8",
                        "hand angle, tight tube, Λ = " + std::to_string(lambda).substr(0, 3) + ", tip " +
                            std::to_string(tip_deg) + "° [°]",
                        "GJ α'' = EI κ0 κt sin α", whip_hand_angle_rad(lambda, tip) / kDegree,
                        turning.start_for_tip_rad(tip) / kDegree, kTolerance_deg, ErrorKind::absolute,
                        "first variation"});
    }
  }
  const Turning turning = turn_in_bend(2.0, 220.0 * kDegree);
  double furthest = 0.0;
  double snap = std::numeric_limits<double>::quiet_NaN();
  double start = snap;
  for (std::size_t i = 1; i < turning.tip_rad.size(); ++i) {
    const double jump = turning.tip_rad[i] - turning.tip_rad[i - 1];
    if (jump <= furthest) continue;
    furthest = jump;
    snap = 0.5 * (turning.hand_rad[i] + turning.hand_rad[i - 1]);
    start = turning.start_rad[i - 1];
  }
  constexpr double kSnap = 45.0 * kDegree;
  checks.push_back(
      {"V8", "hand angle at which the tip snaps, tight tube behind 5 mm of straight, Λ = 2.0 [°]",
       "GJ α'' = EI κ0 κt sin α", whip_snap_angle_rad(2.0, kInlet_mm / turning.length_mm) / kDegree,
       furthest > kSnap ? snap / kDegree : std::numeric_limits<double>::quiet_NaN(), kTolerance_deg,
       ErrorKind::absolute, "first variation"});
  // The hand's angle at the start of the bend hardly changes there: whether the snap begins a little earlier matters little.
  checks.push_back({"V8", "angle at the start of the bend before the tip snaps, tight tube, Λ = 2.0 [°]",
                    "GJ α'' = EI κ0 κt sin α", whip_snap_angle_rad(2.0) / kDegree,
                    furthest > kSnap ? start / kDegree : std::numeric_limits<double>::quiet_NaN(),
                    kTolerance_deg, ErrorKind::absolute, "first variation"});
  return checks;
}

Figure whip_in_a_tube_figure() {
  Figure figure{"v8_tube",
                "V8  Torque whip in a tight tube, as the hand turns: Λ = 1, and 2 with its snap",
                "angle at the start of the bend [°]",
                "angle at the tip [°]",
                {}};
  constexpr int kEvery = 6;
  for (const double lambda : {1.0, 2.0}) {
    const Turning turning = turn_in_bend(lambda, 220.0 * kDegree);
    Series exact{Mark::line, {{0.0, 0.0}}, ""};
    Series ours{Mark::rings, {}, ""};
    constexpr int kHalfTurn_deg = 180;
    for (int tip = 3; tip <= kHalfTurn_deg; tip += 3)
      exact.points.push_back(
          {whip_hand_angle_rad(lambda, tip * kDegree) / kDegree, static_cast<double>(tip)});
    for (std::size_t i = 0; i < turning.tip_rad.size() && turning.tip_rad[i] < kPi; i += kEvery)
      ours.points.push_back({turning.start_rad[i] / kDegree, turning.tip_rad[i] / kDegree});
    figure.series.push_back(exact);
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

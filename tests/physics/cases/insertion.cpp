// V11  A straight wire pushed through a straight tube into a bend of radius R, no friction, clearance → 0:
//
//   hand force EI/(2R²), axial compression inside the bend EI/R²
//
// The wire costs ½EI/R² of energy per length that enters the bend: that is the hand's force. At the start of the bend the balance of
// forces along the wire has the jump ½EIκ², so inside it carries twice as much.
//
// With clearance c the force is EI/(2(R + c)²), once the tip is far from the sheath: what grows then lies on the outer wall, while the shapes
// at the sheath and at the tip stay what they are. It takes more of a bend than half a turn to get there: a torus.
//
// Nothing is lost: at any clearance, and wherever the sheath ends, the work of the hand is the energy that the wire gains.
//
// The hand's force ripples as joints enter the bend. Held to the centreline, rods of length l that have moved on by u into it store
//
//   E(u) = (EIκ²l/2) Σ (φ_j/κl)²,  dE/du = (EIκ²/2)(u³ + 2(1 − u) − (1 − u)³),  u in rods: between 0.91 and 1.09 of the mean
//
// whatever l is. Clearance smooths that away once it is large against the sagitta κl²/8 of a rod: 1.6 µm for rods of 0.5 mm here.
#include "insertion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "cases.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/vessel/analytic_field.hpp"
#include "figures.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kBendRadius_mm = 20.0;
constexpr double kRigidity_n_mm2 = 100.0;
/// Long enough for the wire to come to rest in the middle of it: a clamp nearer to the bend shares in the hand force.
constexpr double kLongInlet_mm = 60.0;
constexpr double kShortInlet_mm = 25.0;
constexpr double kStiff_mpa = 1000.0;

/// What the hand and the wire feel while the tip moves on by 10 mm, well inside the bend.
struct Push {
  double hand_n = 0.0;         ///< mean
  double hand_ripple = 0.0;    ///< largest deviation from the mean, relative
  double compression_n = 0.0;  ///< mean, in the middle of the part that lies in the bend
  double work_n = 0.0;         ///< work of the hand, and
  double stored_n = 0.0;       ///< bending energy gained, both per length inserted
};

/// Bending energy of the chain that comes out of the sheath; its walls are rigid and its rods hardly give.
double bending_energy_mj(const sim::State& state) {
  double energy = 0.0;
  const std::size_t sheath = state.joints_mm.size() - 2;  // the joint at its end
  for (std::size_t j = 1; j <= sheath; ++j) {
    const Eigen::Vector3d tip_side = state.joints_mm[j - 1] - state.joints_mm[j];
    const Eigen::Vector3d hand_side = state.joints_mm[j] - state.joints_mm[j + 1];
    const double angle = std::atan2(tip_side.cross(hand_side).norm(), tip_side.dot(hand_side));
    const double span_mm = 0.5 * (tip_side.norm() + (j == sheath ? 0.0 : hand_side.norm()));
    energy += 0.5 * kRigidity_n_mm2 * angle * angle / span_mm;
  }
  return energy;
}

/// No weight, uniform rods, and a stop so tight that the digits of the table do not hang on the path.
sim::SimulationSpec tight_spec(double rod_mm, double wall_mpa) {
  sim::SimulationSpec spec;
  spec.gravity_m_per_s2.setZero();
  spec.wall.modulus_mpa = wall_mpa;
  spec.solver.rods.adaptive = false;
  spec.solver.rods.rod_length_mm = rod_mm;
  spec.solver.correction_tolerance_mm = 1e-6;
  spec.solver.correction_tolerance_deg = 1e-5;
  return spec;
}

/// The wire enters at x = −inlet_mm and moves along x; the tube bends towards y at the origin.
/// @param settled_mm  of wire in the bend before measuring
Push push(double clearance_mm, double rod_mm, double wall_mpa, double inlet_mm, double settled_mm) {
  constexpr double kMeasured_mm = 10.0;
  constexpr double kStep_mm = 0.25;
  const rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 200.0);
  const double radius_mm = wire.sections[0].radius_mm.at_tip_side;
  const auto tube = std::make_shared<vessel::BentTubeField>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(),
                                                            Eigen::Vector3d::UnitY(), kBendRadius_mm,
                                                            std::numbers::pi, radius_mm + clearance_mm);
  sim::Simulation simulation(tube, wire, {Eigen::Vector3d(-inlet_mm, 0.0, 0.0), Eigen::Vector3d::UnitX()},
                             tight_spec(rod_mm, wall_mpa));

  Push result;
  const auto failed = [&] {
    result.hand_n = result.compression_n = result.work_n = std::numeric_limits<double>::quiet_NaN();
    return result;
  };
  const double axial_n = wire.sections[0].axial_rigidity_n.at_tip_side;
  double least_n = HUGE_VAL;
  double most_n = -HUGE_VAL;
  int steps = 0;
  int rods = 0;
  double before_mj = 0.0;
  double before_n = 0.0;
  for (double inserted = kStep_mm; inserted < inlet_mm + settled_mm + kMeasured_mm + 0.5 * kStep_mm;
       inserted += kStep_mm) {
    const sim::StepReport& report = simulation.step({kStep_mm, 0.0});
    if (!report.converged) return failed();
    const double last_n = std::exchange(before_n, report.push_force_n);
    if (inserted < inlet_mm + settled_mm + 0.5 * kStep_mm) {
      if (inserted > inlet_mm) before_mj = bending_energy_mj(simulation.state());
      continue;
    }
    ++steps;
    result.work_n += 0.5 * (last_n + report.push_force_n);
    result.hand_n += report.push_force_n;
    least_n = std::min(least_n, report.push_force_n);
    most_n = std::max(most_n, report.push_force_n);
    const auto& joints = simulation.state().joints_mm;
    for (std::size_t i = 0; i + 2 < joints.size(); ++i) {
      const double angle = std::atan2(joints[i].x(), kBendRadius_mm - joints[i].y());
      if (joints[i].x() < 0.0 || angle < 0.5 || static_cast<double>(i) * rod_mm < 10.0)
        continue;  // away from both ends of the bent part
      result.compression_n += axial_n * (1.0 - (joints[i] - joints[i + 1]).norm() / rod_mm);
      ++rods;
    }
  }
  result.stored_n = (bending_energy_mj(simulation.state()) - before_mj) / (steps * kStep_mm);
  result.hand_n /= steps;
  result.work_n /= steps;
  result.compression_n /= rods;
  result.hand_ripple = std::max(most_n - result.hand_n, result.hand_n - least_n) / result.hand_n;
  return result;
}

}  // namespace

std::vector<HandForce> push_round_a_torus(double clearance_mm) {
  constexpr double kInserted_mm = 110.0;  // of the 126 mm once round
  constexpr double kStep_mm = 0.25;
  constexpr double kRod_mm = 0.5;
  const rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 200.0);
  const auto tube = std::make_shared<vessel::TorusField>(
      Eigen::Vector3d(0.0, kBendRadius_mm, 0.0), Eigen::Vector3d::UnitZ(), kBendRadius_mm,
      wire.sections[0].radius_mm.at_tip_side + clearance_mm);
  sim::Simulation simulation(tube, wire, {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()},
                             tight_spec(kRod_mm, kStiff_mpa));
  std::vector<HandForce> forces;
  for (double inserted = kStep_mm; inserted < kInserted_mm + 0.5 * kStep_mm; inserted += kStep_mm) {
    const sim::StepReport& report = simulation.step({kStep_mm, 0.0});
    forces.push_back({report.inserted_length_mm,
                      report.converged ? report.push_force_n : std::numeric_limits<double>::quiet_NaN()});
  }
  return forces;
}

namespace {

/// The mean over the last 10 mm.
double steady_n(const std::vector<HandForce>& forces) {
  constexpr double kMeasured_mm = 10.0;
  double sum_n = 0.0;
  int steps = 0;
  for (const HandForce& f : forces) {
    if (f.inserted_mm < forces.back().inserted_mm - kMeasured_mm) continue;
    sum_n += f.force_n;
    ++steps;
  }
  return sum_n / steps;
}

}  // namespace

double steady_push_n(double clearance_mm) {
  return kRigidity_n_mm2 / (2.0 * std::pow(kBendRadius_mm + clearance_mm, 2));
}

Checks insertion_into_a_torus() {
  Checks checks;
  for (const double clearance_mm : {0.25, 1.0, 3.0}) {
    checks.push_back(
        {"V11", "steady hand force, clearance " + std::to_string(clearance_mm).substr(0, 4) + " mm [mN]",
         "EI/2(R + c)²", 1e3 * steady_push_n(clearance_mm), 1e3 * steady_n(push_round_a_torus(clearance_mm)),
         1e-2, ErrorKind::relative, "energy conservation"});
  }
  return checks;
}

Checks insertion_into_a_bend() {
  constexpr double kRod_mm = 0.5;
  constexpr double kTight_mm = 0.005;
  const double hand_n = kRigidity_n_mm2 / (2.0 * kBendRadius_mm * kBendRadius_mm);
  Checks checks;
  const Push tight = push(kTight_mm, kRod_mm, kStiff_mpa, kLongInlet_mm, 25.0);
  checks.push_back({"V11", "mean hand force, clearance 0.005 mm [mN]", "EI/2R²", 1e3 * hand_n,
                    1e3 * tight.hand_n, 1e-2, ErrorKind::relative, "Bigoni2015"});
  checks.push_back({"V11", "work of the hand per length, clearance 0.005 mm [mN]", "ΔE/ΔL",
                    1e3 * tight.stored_n, 1e3 * tight.work_n, 2e-3, ErrorKind::relative,
                    "energy conservation"});
  checks.push_back({"V11", "mean compression in the bend [mN]", "EI/R²", 2e3 * hand_n,
                    1e3 * tight.compression_n, 1e-2, ErrorKind::relative, "Bigoni2015"});
  checks.push_back({"V11", "ripple of the hand force, rods of 0.5 mm [%]", "0", 0.0, 1e2 * tight.hand_ripple,
                    2.0, ErrorKind::absolute, "Bigoni2015"});
  // A loose tube: the rise is known to the whole percent only, and not over which part of the way. It grows, has a plateau of
  // 10 mm, and falls when the tip comes to the end of the bend.
  struct Loose {
    double clearance_mm, settled_mm, percent, allowed;
  };
  for (const auto& [clearance_mm, settled_mm, percent, allowed] :
       {Loose{0.25, 20.0, 3.0, 1.0}, {1.0, 30.0, 12.0, 2.0}}) {
    const Push loose = push(clearance_mm, kRod_mm, kStiff_mpa, kLongInlet_mm, settled_mm);
    const std::string clearance = std::to_string(clearance_mm).substr(0, 4);
    checks.push_back({"V11", "work of the hand per length, clearance " + clearance + " mm [mN]", "ΔE/ΔL",
                      1e3 * loose.stored_n, 1e3 * loose.work_n, 2e-3, ErrorKind::relative,
                      "energy conservation"});
    checks.push_back({"V11", "rise of the hand force, clearance " + clearance + " mm [%]", "none", percent,
                      1e2 * (loose.hand_n / hand_n - 1.0), allowed, ErrorKind::absolute,
                      "known to the whole percent"});
  }
  // The sleeve holds the wire by a moment here, and pushing against that takes the configurational force M²/2EI.
  const Push held = push(1.0, kRod_mm, kStiff_mpa, kShortInlet_mm, 30.0);
  checks.push_back(
      {"V11", "work of the hand per length, clearance 1.00 mm, sheath 25 mm before the bend [mN]", "ΔE/ΔL",
       1e3 * held.stored_n, 1e3 * held.work_n, 5e-3, ErrorKind::relative, "Bigoni2015"});
  return checks;
}

Figure torus_figure() {
  Figure figure{"v11",
                "V11  Hand force as a wire goes round a torus, by the clearance",
                "inserted [mm]",
                "hand force [mN]",
                {}};
  constexpr double kFrom_mm = 20.0;
  constexpr std::size_t kEvery = 6;
  for (const double clearance_mm : {0.25, 1.0, 3.0}) {
    const std::vector<HandForce> forces = push_round_a_torus(clearance_mm);
    Series ours{Mark::rings, {}, ""};
    for (std::size_t i = 0; i < forces.size(); i += kEvery)
      if (forces[i].inserted_mm > kFrom_mm)
        ours.points.push_back({forces[i].inserted_mm, 1e3 * forces[i].force_n});
    const double exact_mn = 1e3 * steady_push_n(clearance_mm);
    figure.series.push_back({Mark::line,
                             {{kFrom_mm, exact_mn}, {forces.back().inserted_mm, exact_mn}},
                             std::to_string(clearance_mm).substr(0, 4) + " mm"});
    figure.series.push_back(ours);
  }
  return figure;
}

}  // namespace endowire::test

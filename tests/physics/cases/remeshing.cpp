// V16  Dividing and joining rods leaves energy and shape within the error of discretisation.
//
// A cantilever on long rods comes to rest; all its rods but the clamped one are halved as a simulation halves them, on the curve that the
// chain stands for; it comes to rest again. How far both move it is measured by how far it was from a chain of very short rods.
#include <cmath>
#include <vector>

#include "cases.hpp"
#include "endowire/rod/remesh.hpp"
#include "support/chains.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kLoad = 5.0;  // α = P L²/EI

/// The cantilever of V1, at rest on so many rods.
struct Cantilever {
  explicit Cantilever(int rods)
      : chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / (rods - 0.5)) {
    chain.problem.loads.tip_force_n.y() = kLoad * kRigidity_n_mm2 / (kLength_mm * kLength_mm);
    settle();
  }
  void settle() {
    chain.problem.release_all();
    chain.problem.clamp_hand_end();
    solve::Newton newton;
    failed += nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
  }
  /// Bending and stretch.
  [[nodiscard]] double energy_mj() const {
    return rod::chain_energy(chain.problem.material, chain.problem.shape) + failed;
  }
  /// The tip, from the clamp in the middle of the last rod.
  [[nodiscard]] Eigen::Vector3d tip_mm() const {
    const rod::ChainShape& shape = chain.problem.shape;
    const std::size_t n = shape.joints_mm.size() - 1;
    return shape.joints_mm.front() - 0.5 * (shape.joints_mm[n] + shape.joints_mm[n - 1]);
  }

  Chain chain;
  double failed = 0.0;
};

}  // namespace

Checks remeshing() {
  constexpr int kLong = 25;
  constexpr int kShort = 800;
  const Cantilever exact(kShort);
  Cantilever wire(kLong);
  const double energy_mj = wire.energy_mj();
  const Eigen::Vector3d tip_mm = wire.tip_mm();
  sim::ChainProblem& problem = wire.chain.problem;
  const rod::ImmersedWire immersed{&wire.chain.line, 0.0, 0.0};
  for (int rod = kLong - 2; rod >= 0; --rod) {
    const std::vector<double>& arc = problem.material.arc_mm;
    const auto i = static_cast<std::size_t>(rod);
    rod::divide_rod(problem.material, problem.shape, rod, 0.5 * (arc[i] + arc[i + 1]));
    immersed.fill(rod, rod + 2, problem.material);
  }
  const double divided_mj = wire.energy_mj();
  const double divided_tip_mm = (wire.tip_mm() - tip_mm).norm();
  wire.settle();
  const double error_mj = std::abs(energy_mj - exact.energy_mj());
  const double error_mm = (tip_mm - exact.tip_mm()).norm();
  const auto check = [](const char* quantity, double ours, double allowed) {
    return Check{"V16", quantity, "0", 0.0, ours, allowed, ErrorKind::absolute, "discretisation"};
  };
  return {check("all of 25 rods halved: energy that this injects, over that of the wire [%]",
                1e2 * (divided_mj - energy_mj) / energy_mj, 5.0),
          check("all of 25 rods halved: shift of the tip, over its discretisation error",
                divided_tip_mm / error_mm, 1.0),
          check("at rest again: change of energy, over its discretisation error",
                (wire.energy_mj() - energy_mj) / error_mj, 1.0),
          check("at rest again: shift of the tip, over its discretisation error",
                (wire.tip_mm() - tip_mm).norm() / error_mm, 1.0)};
}

}  // namespace endowire::test

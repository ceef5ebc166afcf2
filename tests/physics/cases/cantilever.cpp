// V1  Cantilever with a dead end force, α = P L²/EI.   [BisshoppDrucker1945]
// V2  Cantilever under its own weight, γ = w L³/EI.     [Rohde1953]
//
// The clamp holds the middle of the rod at the hand, so L = (n − ½) l.
#include <cmath>
#include <numbers>

#include "cases.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kTolerance = 1e-3;
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// The end of a converged cantilever along x that bends towards y, measured from the clamp.
ElasticaEnd end_of(const Chain& chain) {
  const rod::ChainShape& shape = chain.problem.shape;
  const Eigen::Vector3d& tip = shape.joints_mm.front();
  const Eigen::Vector3d& tangent = shape.frames.front().col(2);
  const double clamp_mm = shape.joints_mm.back().x() + 0.5 * chain.rod_length_mm;
  return {std::atan2(tangent.y(), tangent.x()), tip.y() / kLength_mm,
          1.0 - (tip.x() - clamp_mm) / kLength_mm};
}

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Checks tip_loaded_cantilever(int rods) {
  Checks checks;
  for (const double alpha : {0.25, 1.0, 2.0, 5.0, 10.0}) {
    Chain chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / (rods - 0.5));
    chain.problem.clamp_hand_end();
    chain.problem.loads.tip_force_n.y() = alpha * kRigidity_n_mm2 / (kLength_mm * kLength_mm);
    solve::Newton newton;
    const double failed = nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
    const ElasticaEnd ours = end_of(chain);
    const ElasticaEnd exact = tip_loaded_elastica(alpha);
    const auto add = [&](const char* quantity, double reference, double value) {
      checks.push_back({"V1", std::string(quantity) + ", α = " + number(alpha), "EI θ'' = −P cos θ",
                        reference, value + failed, kTolerance, ErrorKind::relative, "BisshoppDrucker1945"});
    };
    add("tip angle [°]", exact.tip_angle_rad * kDegrees, ours.tip_angle_rad * kDegrees);
    add("δ/L", exact.deflection, ours.deflection);
    add("1 − x/L", exact.shortening, ours.shortening);
  }
  return checks;
}

Checks self_weight_cantilever(int rods) {
  constexpr double kGravity_m_per_s2 = 9.81;
  constexpr double kGramMetreToNewton = 1e-3;
  Checks checks;
  for (const double gamma : {1.0, 4.0, 8.0, 16.0, 32.0}) {
    rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm);
    const double weight_n_per_mm = gamma * kRigidity_n_mm2 / std::pow(kLength_mm, 3);
    wire.sections[0].linear_density_g_per_mm = weight_n_per_mm / (kGravity_m_per_s2 * kGramMetreToNewton);
    Chain chain(wire, rods, kLength_mm / (rods - 0.5), kGravity_m_per_s2);
    chain.problem.clamp_hand_end();
    chain.problem.loads.gravity_direction = Eigen::Vector3d::UnitY();
    solve::Newton newton;
    const double failed = nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
    checks.push_back({"V2", "δ/L, γ = " + number(gamma), "EI θ'' = −w s cos θ",
                      self_weight_elastica(gamma).deflection, end_of(chain).deflection + failed, kTolerance,
                      ErrorKind::relative, "Rohde1953"});
  }
  return checks;
}

}  // namespace endowire::test

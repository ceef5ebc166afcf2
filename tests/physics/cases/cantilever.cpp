// V1  Cantilever with a dead end force, α = P L²/EI.   [BisshoppDrucker1945]
// V2  Cantilever under its own weight, γ = w L³/EI.     [Rohde1953]
//
// The clamp holds the middle of the rod at the hand, so L = (n − ½) l.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "cases.hpp"
#include "figures.hpp"
#include "support/chains.hpp"
#include "support/closed_forms.hpp"

namespace endowire::test {

namespace {

constexpr double kLength_mm = 100.0;
constexpr double kRigidity_n_mm2 = 10.0;
constexpr double kTolerance = 1e-3;
constexpr double kGravity_m_per_s2 = 9.81;
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

/// The tip-loaded and the self-weight cantilever, at rest.
struct TipLoaded {
  TipLoaded(int rods, double alpha)
      : chain(uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm), rods, kLength_mm / (rods - 0.5)) {
    chain.problem.clamp_hand_end();
    chain.problem.loads.tip_force_n.y() = alpha * kRigidity_n_mm2 / (kLength_mm * kLength_mm);
    solve::Newton newton;
    failed = nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
  }
  Chain chain;
  double failed;
};

rod::Instrument heavy_wire(double gamma) {
  constexpr double kGramMetreToNewton = 1e-3;
  rod::Instrument wire = uniform_wire(kRigidity_n_mm2, 2.0 * kLength_mm);
  const double weight_n_per_mm = gamma * kRigidity_n_mm2 / std::pow(kLength_mm, 3);
  wire.sections[0].linear_density_g_per_mm = weight_n_per_mm / (kGravity_m_per_s2 * kGramMetreToNewton);
  return wire;
}

struct SelfWeight {
  SelfWeight(int rods, double gamma)
      : chain(heavy_wire(gamma), rods, kLength_mm / (rods - 0.5), kGravity_m_per_s2) {
    chain.problem.clamp_hand_end();
    chain.problem.loads.gravity_direction = Eigen::Vector3d::UnitY();
    solve::Newton newton;
    failed = nan_unless_converged(newton.minimise(chain.problem, statics_spec()));
  }
  Chain chain;
  double failed;
};

/// Every fifth joint, as shares of the length from the clamp.
std::vector<PlanePoint> joints_of(const Chain& chain, double failed) {
  constexpr int kEvery = 5;
  const auto& joints = chain.problem.shape.joints_mm;
  const double clamp_mm = joints.back().x() + 0.5 * chain.rod_length_mm;
  std::vector<PlanePoint> points;
  for (std::size_t i = 0; i + 1 < joints.size(); i += kEvery)
    points.push_back({(joints[i].x() - clamp_mm) / kLength_mm + failed, joints[i].y() / kLength_mm});
  return points;
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
    const TipLoaded rod(rods, alpha);
    const ElasticaEnd ours = end_of(rod.chain);
    const ElasticaEnd exact = tip_loaded_elastica(alpha);
    const auto add = [&](const char* quantity, double reference, double value) {
      checks.push_back({"V1", std::string(quantity) + ", α = " + number(alpha), "EI θ'' = −P cos θ",
                        reference, value + rod.failed, kTolerance, ErrorKind::relative,
                        "BisshoppDrucker1945"});
    };
    add("tip angle [°]", exact.tip_angle_rad * kDegrees, ours.tip_angle_rad * kDegrees);
    add("δ/L", exact.deflection, ours.deflection);
    add("1 − x/L", exact.shortening, ours.shortening);
  }
  return checks;
}

Checks self_weight_cantilever(int rods) {
  Checks checks;
  for (const double gamma : {1.0, 4.0, 8.0, 16.0, 32.0}) {
    const SelfWeight rod(rods, gamma);
    checks.push_back({"V2", "δ/L, γ = " + number(gamma), "EI θ'' = −w s cos θ",
                      self_weight_elastica(gamma).deflection, end_of(rod.chain).deflection + rod.failed,
                      kTolerance, ErrorKind::relative, "Rohde1953"});
  }
  return checks;
}

Figure tip_loaded_figure() {
  Figure figure{"v1", "V1  Cantilever under a dead end force, α = P L²/EI", "x/L", "y/L", {}, true};
  for (const double alpha : {0.25, 1.0, 2.0, 5.0, 10.0}) {
    const TipLoaded rod(kRods, alpha);
    figure.series.push_back({Mark::line, tip_loaded_shape(alpha), "α = " + number(alpha)});
    figure.series.push_back({Mark::rings, joints_of(rod.chain, rod.failed), ""});
  }
  return figure;
}

Figure self_weight_figure() {
  Figure figure{"v2", "V2  Cantilever under its own weight, γ = w L³/EI", "x/L", "y/L", {}, true};
  for (const double gamma : {1.0, 4.0, 8.0, 16.0, 32.0}) {
    const SelfWeight rod(kRods, gamma);
    figure.series.push_back({Mark::line, self_weight_shape(gamma), "γ = " + number(gamma)});
    figure.series.push_back({Mark::rings, joints_of(rod.chain, rod.failed), ""});
  }
  return figure;
}

}  // namespace endowire::test

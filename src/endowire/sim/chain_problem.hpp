#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "endowire/contact/contact_set.hpp"
#include "endowire/rod/chain.hpp"
#include "endowire/sim/feed.hpp"
#include "endowire/solve/newton.hpp"

namespace endowire::sim {

/// Dead loads on a chain; energies, so that Newton sees their potential.
struct Loads {
  /// Weight is ChainMaterial::weight_n along this unit direction.
  Eigen::Vector3d gravity_direction = Eigen::Vector3d::Zero();
  /// A force on the tip joint that keeps its direction: −F·x₀.
  Eigen::Vector3d tip_force_n = Eigen::Vector3d::Zero();
  /// A moment on the tip rod about a fixed axis: −M ψ, ψ the turn of its tangent about the axis.
  /// Domain: the tangent stays normal to the axis (plane problems).
  Eigen::Vector3d tip_moment_axis = Eigen::Vector3d::UnitZ();
  double tip_moment_n_mm = 0.0;
};

/// A chain of rods with its loads, ends, contacts and hand, as a problem to minimise:
///
///   Π = bending + twist + stretch + gravity + loads + wall + friction (normal forces lagged) + grip
///
/// This is the merit of the line search. Joint n is always held; `held` names further fixed unknowns. Instruments that share the
/// chain's centreline are held and turned each for itself; with such, the problem is one of statics: without feed and walls.
class ChainProblem final : public solve::Problem {
 public:
  rod::ChainMaterial material;
  rod::ChainShape shape;  ///< base state
  Loads loads;
  Feed feed;
  contact::ContactSet contact;
  const rod::MaterialLine* line = nullptr;  ///< needed by a feed: what enters the lumen
  std::vector<char> held;                   ///< one per unknown
  double region_mm = 1e9;                   ///< the base state may move this far from where detection saw it

  void reserve(int rods, std::size_t samples);
  /// No unknown held but joint n, and the spins of rods that an instrument does not reach.
  void release_all();
  void hold_joint(int joint, bool x, bool y, bool z);
  /// @param instrument  0 for the one that reaches to the tip, then those of `shape.coaxial`
  void hold_spin(int rod, int instrument = 0);
  /// Holds the last rod, of all instruments: a clamp at its middle.
  void clamp_hand_end();

  /// Gives the entering rod its length, and what hangs on it, for a feed with so much wire inserted.
  void fit_entering(double inserted_mm);

  [[nodiscard]] int unknowns() const override { return unknowns_per_joint() * (shape.rods() + 1); }
  [[nodiscard]] int unknowns_per_joint() const override { return shape.unknowns_per_joint(); }
  double linearise(math::BandMatrix& hessian, std::vector<double>& gradient) override;
  solve::ContactPart add_contacts(const std::vector<double>& step, solve::ContactHessian kind,
                                  math::BandMatrix& hessian, std::vector<double>& gradient) override;
  bool correct_contacts(const std::vector<double>& step) override;
  double try_step(const std::vector<double>& direction, double alpha) override;
  void accept_step() override;
  [[nodiscard]] solve::ForceScales scales() const override { return scales_; }
  [[nodiscard]] double lag_error() const override { return contact.lag_error(); }
  void renew_lagged() override { contact.renew_lagged(); }
  [[nodiscard]] bool inside_region() const override;
  solve::Validity check() override;

  /// What check() asks; without it the walls hold wherever the region does.
  std::function<solve::Validity()> checker;
  /// Called after every step taken.
  std::function<void()> on_step;

  /// Force and torque of the hand on the wire at the base state.
  [[nodiscard]] double push_force_n() const;
  [[nodiscard]] double hand_torque_n_mm() const;
  /// Energy of the base state with fixed normal forces.
  [[nodiscard]] double energy_mj();

 private:
  [[nodiscard]] double potential(const rod::ChainShape& at);
  double add_loads(math::BandMatrix& hessian, std::vector<double>& gradient) const;
  [[nodiscard]] int feed_unknown() const { return feed.active ? 4 * (shape.rods() - 1) : -1; }
  void hold(math::BandMatrix& hessian, std::vector<double>& gradient) const;
  [[nodiscard]] contact::GuidedJoint guided() const;
  void measure_scales();

  rod::ChainShape trial_;
  Feed trial_feed_;
  rod::TridiagonalScratch scratch_;
  std::vector<double> cartesian_;
  contact::ContactModel model_;
  std::vector<double> contact_gradient_;  ///< at the base state
  double contact_energy_ = 0.0;
  std::vector<double> geometric_force_;
  solve::ForceScales scales_;
  double moment_turn_ = 0.0;
};

}  // namespace endowire::sim

#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "endowire/rod/instrument.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/sim/target.hpp"
#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::paper {

using Line = std::vector<Eigen::Vector3d>;

/// A vessel that wires are played in.
struct Vessel {
  std::shared_ptr<const vessel::Field> field;
  /// Exact distance to the wall, positive in the lumen: of the closed form or of the triangles, not of the field. [mm]
  std::function<double(const Eigen::Vector3d&)> exact_mm;
  sim::Access access;
  std::shared_ptr<const vessel::CentrelineTree> tree;  ///< null: branches are not asked for
  std::size_t triangles = 0;                           ///< 0: a closed form
};

/// What a hand does to a wire in a vessel.
struct Procedure {
  std::string name;
  Vessel vessel;
  rod::Instrument wire;
  sim::SimulationSpec spec;
  std::vector<sim::Command> commands;
  std::optional<sim::TargetSpec> target;
};

/// One step of a run.
struct Step {
  double inserted_mm = 0.0;
  double push_n = 0.0;
  double rods = 0.0;
  double cpu_us = 0.0;
  double detections = 0.0;
  double correction_mm = 0.0;  ///< by which its last iteration still moved the wire
  bool converged = false;
  bool calm = false;  ///< converged, and the last snap is some steps ago
  Line joints_mm;
};

/// What came of a procedure. All but the times is the same from run to run.
struct Run {
  std::vector<Step> steps;  ///< fewer than commands where the wire was stuck
  std::size_t commands = 0;
  int converged = 0;
  int snaps = 0;
  int splits = 0;
  double detections = 0.0;
  double calm_detections = 0.0;  ///< of steps without a snap
  double verifications = 0.0;
  double iterations = 0.0;
  double deepest_mm =
      0.0;  ///< surface of the wire behind the wall, by the exact distance, at the end of any step
  double slipped_mm = 0.0;  ///< in the hand
  double most_push_n = 0.0;
  double resolution_energy_mj = 0.0;  ///< most of a step
  std::string branch;                 ///< that the tip ended in; empty: not asked for
  bool reached = false;               ///< the target

  [[nodiscard]] double mean_rods() const;
  [[nodiscard]] double mean_us() const;
  [[nodiscard]] double percentile_us(double fraction) const;
  /// Every command was played and converged.
  [[nodiscard]] bool complete() const { return converged == static_cast<int>(commands); }
};

/// A wire behind the wall by more than this has crossed it: the wall yields up to 0.15 mm.
inline constexpr double kCrossing_mm = 0.2;

/// Plays a procedure to its end, or until ten steps in a row have not converged.
[[nodiscard]] Run play(const Procedure& procedure);
/// The same with other rods.
[[nodiscard]] Run play(const Procedure& procedure, const sim::ResolutionSpec& rods);

/// Rods of one length from tip to hand; nothing shortens them, not even a curved tip.
[[nodiscard]] sim::ResolutionSpec fixed_rods(double length_mm);

}  // namespace endowire::paper

#pragma once

#include <cstdint>
#include <vector>

#include "endowire/sim/simulation.hpp"
#include "endowire/sim/snapshot.hpp"

namespace endowire::io {

/// What a report shows of one step.
struct HistoryStep {
  std::uint64_t step = 0;  ///< counted from 1
  double time_s = 0.0;
  double inserted_mm = 0.0;
  double push_force_n = 0.0;
  double torque_n_mm = 0.0;
  double wall_force_n = 0.0;  ///< largest over all windows of 5 mm
  double tip_force_n = 0.0;   ///< over the last 5 mm
};

/// The shape of the wire after a step, in single precision: an error of 0.03 µm at half a metre.
struct KeyFrame {
  std::uint64_t step = 0;
  std::vector<float> position_mm;  ///< three a point, from the tip
  std::vector<float> radius_mm;
  std::vector<float> wall_force_n_per_mm;
};

/// The course of a run, kept while it is played, in bounded memory: at most `most_steps` steps and `most_frames`
/// shapes, whatever its length.
class RunHistory {
 public:
  static constexpr std::uint64_t most_steps = 8'000;  ///< more than a chart has pixels
  static constexpr std::size_t most_frames = 200;
  static constexpr std::size_t even_frames = 150;  ///< at equal intervals; the others are steps with events

  /// @param planned_steps  of the whole run
  explicit RunHistory(std::uint64_t planned_steps);

  /// Every step in order. Of a longer run each stretch of `every()` steps is kept as the one that presses the wall most.
  /// @param event  the step began an event: its shape is kept if there is room
  void add(std::uint64_t step, double time_s, const sim::StepReport& report, const sim::Snapshot& snapshot,
           bool event);

  [[nodiscard]] const std::vector<HistoryStep>& steps() const { return steps_; }
  [[nodiscard]] const std::vector<KeyFrame>& frames() const { return frames_; }
  [[nodiscard]] std::uint64_t every() const { return every_; }

 private:
  std::uint64_t planned_;
  std::uint64_t every_;        ///< steps to a kept one
  std::uint64_t frame_every_;  ///< steps to an even key frame
  std::size_t event_frames_ = 0;
  std::vector<HistoryStep> steps_;
  std::vector<KeyFrame> frames_;
};

}  // namespace endowire::io

#include "endowire/io/run_history.hpp"

#include <algorithm>

namespace endowire::io {

namespace {

std::uint64_t stride(std::uint64_t steps, std::uint64_t most) {
  return std::max<std::uint64_t>(1, (steps + most - 1) / most);
}

KeyFrame frame_of(std::uint64_t step, const sim::Snapshot& snapshot) {
  KeyFrame frame;
  frame.step = step;
  for (const sim::SnapshotPoint& point : snapshot.points) {
    for (int c = 0; c < 3; ++c) frame.position_mm.push_back(static_cast<float>(point.position_mm[c]));
    frame.radius_mm.push_back(static_cast<float>(point.radius_mm));
    frame.wall_force_n_per_mm.push_back(static_cast<float>(point.wall_force_n_per_mm));
  }
  return frame;
}

}  // namespace

RunHistory::RunHistory(std::uint64_t planned_steps)
    : planned_(planned_steps),
      every_(stride(planned_steps, most_steps)),
      frame_every_(stride(planned_steps, even_frames - 1)) {}  // the last step is one of them

void RunHistory::add(std::uint64_t step, double time_s, const sim::StepReport& report,
                     const sim::Snapshot& snapshot, bool event) {
  const HistoryStep now{step,
                        time_s,
                        report.inserted_length_mm,
                        report.push_force_n,
                        report.torque_n_mm,
                        report.max_force_5mm_n,
                        report.tip_force_n};
  const bool stretch_begins = (step - 1) % every_ == 0;
  if (stretch_begins) {
    steps_.push_back(now);
  } else if (now.wall_force_n > steps_.back().wall_force_n) {
    steps_.back() = now;
  }
  if (snapshot.points.size() < 2) return;
  const bool even = step % frame_every_ == 0 || step == planned_;
  if (!even && (!event || event_frames_ == most_frames - even_frames)) return;
  if (!even) ++event_frames_;
  frames_.push_back(frame_of(step, snapshot));
}

}  // namespace endowire::io

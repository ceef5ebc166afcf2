#include "endowire/sim/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "endowire/base/error.hpp"

namespace endowire::sim {

namespace {

double travel_mm(const Command& command) {
  const double turned_deg = std::abs(command.torque_rad) * 180.0 / std::numbers::pi;
  return std::max(std::abs(command.advance_mm), travel_mm_per_deg * turned_deg);
}

double quiet_limit_mm(EventKind kind) {
  return kind == EventKind::snap ? 0.0 : event_quiet_mm;
}

}  // namespace

EventWatch::EventWatch(std::shared_ptr<const vessel::CentrelineTree> tree) : tree_(std::move(tree)) {
  if (tree_ && tree_->branches().empty()) tree_.reset();
  begun_.reserve(event_kinds);
}

void EventWatch::reserve(std::size_t points, double length_mm) {
  overlap_.reserve(points, length_mm);
}

void EventWatch::restore(const EventMemory& memory) {
  const auto branches = tree_ ? static_cast<std::int32_t>(tree_->branches().size()) : 0;
  if (memory.branch < -1 || memory.branch >= branches || memory.place.branch < -1 ||
      memory.place.branch >= branches)
    throw base::InputError("events: a branch that the vessel does not have");
  memory_ = memory;
}

std::span<const Event> EventWatch::after(const Command& commanded, const StepReport& report,
                                         const Snapshot& snapshot) {
  // A command that is no number was refused: the hand stayed where it was.
  const bool finite = std::isfinite(commanded.advance_mm) && std::isfinite(commanded.torque_rad);
  const Command command = finite ? commanded : Command{};
  begun_.clear();
  for (Episode& episode : memory_.episodes) episode.shown = false;
  for (const Event& sign : report.events) show(sign);
  watch_stall(command, report, snapshot);
  if (const SelfGap gap = overlap_.nearest(snapshot.points); gap.gap_mm < 0.0)
    show({EventKind::self_overlap, gap.gap_mm, gap.position_mm});
  for (Episode& episode : memory_.episodes) {
    if (!episode.shown) {
      episode.quiet_mm += travel_mm(command);
      episode.open = episode.open && episode.quiet_mm < quiet_limit_mm(episode.sign.kind);
      continue;
    }
    if (!episode.open) begun_.push_back(episode.sign);
    episode.open = true;
    episode.quiet_mm = 0.0;
  }
  watch_branch(snapshot);
  return begun_;
}

/// Of several signs of a kind in one step the strongest counts.
void EventWatch::show(const Event& sign) {
  Episode& episode = memory_.episodes[static_cast<std::size_t>(sign.kind)];
  if (episode.shown && std::abs(sign.value) <= std::abs(episode.sign.value)) return;
  episode.shown = true;
  episode.sign = sign;
}

void EventWatch::watch_stall(const Command& command, const StepReport& report, const Snapshot& snapshot) {
  if (snapshot.points.empty() || command.advance_mm < 0.0) {
    memory_.pushing = memory_.stalled = false;
    return;
  }
  const Eigen::Vector3d& tip_mm = snapshot.points.front().position_mm;
  if (memory_.pushing) memory_.pushed_mm += command.advance_mm;
  if (memory_.pushing && memory_.pushed_mm >= stall_window_mm) {
    const double progress = (tip_mm - memory_.tip_then_mm).norm() / memory_.pushed_mm;
    memory_.stalled = progress < (memory_.stalled ? free_progress : stall_progress);
    memory_.pushing = false;
  }
  if (!memory_.pushing) {
    memory_.pushing = true;
    memory_.pushed_mm = 0.0;
    memory_.tip_then_mm = tip_mm;
  }
  if (memory_.stalled) show({EventKind::stall, report.push_force_n, tip_mm});
}

void EventWatch::watch_branch(const Snapshot& snapshot) {
  if (!tree_ || snapshot.points.empty()) return;
  const Eigen::Vector3d& tip_mm = snapshot.points.front().position_mm;
  const vessel::NearestCentreline tip = tree_->nearest(tip_mm, memory_.place);
  memory_.place = tip.place;
  const std::int32_t branch = tree_->lumen_branch(tip.place);
  const auto vessel_of = [&](std::int32_t b) -> const std::string& {
    return tree_->branches()[static_cast<std::size_t>(b)].vessel;
  };
  // The next stretch of the same vessel is no news.
  if (memory_.branch >= 0 && vessel_of(branch) != vessel_of(memory_.branch)) {
    if (!inside(branch, tip)) return;
    begun_.push_back({EventKind::new_branch, tip.radius_mm, tip_mm, branch});
  }
  memory_.branch = branch;
}

/// Whether a place lies well within a branch, not just behind one of its ends that lead to others.
bool EventWatch::inside(std::int32_t branch, const vessel::NearestCentreline& tip) const {
  if (tip.place.branch != branch) return false;  // before an ostium
  const vessel::CentrelineBranch& b = tree_->branches()[static_cast<std::size_t>(branch)];
  double depth_mm = std::numeric_limits<double>::infinity();
  if (b.parent >= 0) depth_mm = std::min(depth_mm, tip.place.arc_mm - b.ostium_arc_mm);
  if (!b.children.empty()) depth_mm = std::min(depth_mm, b.length_mm - tip.place.arc_mm);
  // A short stretch counts from a quarter of it on.
  return depth_mm >= std::min(branch_depth_radii * tip.radius_mm, 0.25 * (b.length_mm - b.ostium_arc_mm));
}

}  // namespace endowire::sim

#include "endowire/sim/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

std::span<const Event> EventWatch::after(const Command& command, const StepReport& report,
                                         const Snapshot& snapshot) {
  begun_.clear();
  for (Episode& episode : episodes_) episode.shown = false;
  for (const Event& sign : report.events) show(sign);
  watch_stall(command, report, snapshot);
  if (const SelfGap gap = overlap_.nearest(snapshot.points); gap.gap_mm < 0.0)
    show({EventKind::self_overlap, gap.gap_mm, gap.position_mm});
  for (Episode& episode : episodes_) {
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
  Episode& episode = episodes_[static_cast<std::size_t>(sign.kind)];
  if (episode.shown && std::abs(sign.value) <= std::abs(episode.sign.value)) return;
  episode.shown = true;
  episode.sign = sign;
}

void EventWatch::watch_stall(const Command& command, const StepReport& report, const Snapshot& snapshot) {
  if (snapshot.points.empty() || command.advance_mm < 0.0) {
    pushing_ = stalled_ = false;
    return;
  }
  const Eigen::Vector3d& tip_mm = snapshot.points.front().position_mm;
  if (pushing_) pushed_mm_ += command.advance_mm;
  if (pushing_ && pushed_mm_ >= stall_window_mm) {
    const double progress = (tip_mm - tip_then_mm_).norm() / pushed_mm_;
    stalled_ = progress < (stalled_ ? free_progress : stall_progress);
    pushing_ = false;
  }
  if (!pushing_) {
    pushing_ = true;
    pushed_mm_ = 0.0;
    tip_then_mm_ = tip_mm;
  }
  if (stalled_) show({EventKind::stall, report.push_force_n, tip_mm});
}

void EventWatch::watch_branch(const Snapshot& snapshot) {
  if (!tree_ || snapshot.points.empty()) return;
  const Eigen::Vector3d& tip_mm = snapshot.points.front().position_mm;
  const vessel::NearestCentreline tip = tree_->nearest(tip_mm, place_);
  place_ = tip.place;
  const std::int32_t branch = tree_->lumen_branch(tip.place);
  const auto vessel_of = [&](std::int32_t b) -> const std::string& {
    return tree_->branches()[static_cast<std::size_t>(b)].vessel;
  };
  // The next stretch of the same vessel is no news.
  if (branch_ >= 0 && vessel_of(branch) != vessel_of(branch_)) {
    if (!inside(branch, tip)) return;
    begun_.push_back({EventKind::new_branch, tip.radius_mm, tip_mm, branch});
  }
  branch_ = branch;
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

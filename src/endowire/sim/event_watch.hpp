#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "endowire/sim/event.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/sim/self_overlap.hpp"
#include "endowire/sim/simulation.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/vessel/centreline_tree.hpp"

namespace endowire::sim {

// Constants of the watch, in millimetres that the hand travels: a degree of turning counts as 0.1 mm, the ratio of the
// largest steps, so that events end under a hand that only turns.
inline constexpr double travel_mm_per_deg = 0.1;
/// What has not been seen for so long has ended; the next time is a new event. Less: one event flickers and is told
/// many times; more: two are taken for one. Snaps are instants: any step without one ends them.
inline constexpr double event_quiet_mm = 3.0;
/// The tip stalls when it goes less than a tenth of so much advance, and is free again when it goes half of it. Less:
/// the slack of a wire that is pushed after it was pulled counts as a stall; more: the stall is told late.
inline constexpr double stall_window_mm = 5.0;
inline constexpr double stall_progress = 0.1;
inline constexpr double free_progress = 0.5;
/// A vessel is entered when the tip is so far beyond its ostium, or beyond the bifurcation on the way back, in radii of
/// the lumen. Less: a tip that rubs on a carina changes vessel at each step.
inline constexpr double branch_depth_radii = 0.5;

/// All that a watch remembers between two steps, as a value.
struct EventMemory {
  /// One kind of event: under way or not.
  struct Episode {
    bool shown = false;  ///< by this step
    bool open = false;
    double quiet_mm = 0.0;  ///< travelled since it was last shown
    Event sign;
  };
  std::array<Episode, event_kinds> episodes{};
  // Stall: how far the hand has pushed since the tip was last looked at, and where it was then.
  bool pushing = false;
  double pushed_mm = 0.0;
  Eigen::Vector3d tip_then_mm = Eigen::Vector3d::Zero();
  bool stalled = false;
  // Branch: the one that the tip is known to be in; -1: of none yet.
  std::int32_t branch = -1;
  vessel::CentrelinePlace place;
};

/// Turns what single steps show into events that are told once, when they begin.
///
/// Stands above the step: it reads commands, reports and snapshots, and changes nothing. It is a value: saved and put
/// back together with the State it goes on as if nothing had happened.
class EventWatch {
 public:
  /// @param tree  of the vessel; null or empty: vessels entered are not watched for
  explicit EventWatch(std::shared_ptr<const vessel::CentrelineTree> tree = nullptr);

  /// Memory for wires of so many points and so long: afterwards `after` allocates nothing.
  void reserve(std::size_t points, double length_mm);

  /// The events that began in the step just taken; valid until the next call.
  [[nodiscard]] std::span<const Event> after(const Command& commanded, const StepReport& report,
                                             const Snapshot& snapshot);

  [[nodiscard]] const EventMemory& memory() const { return memory_; }
  /// Goes on as the watch that remembered this, of the same vessel.
  /// @throws base::InputError when the vessel lacks a branch that it names
  void restore(const EventMemory& memory);

 private:
  using Episode = EventMemory::Episode;

  void show(const Event& sign);
  void watch_stall(const Command& command, const StepReport& report, const Snapshot& snapshot);
  void watch_branch(const Snapshot& snapshot);
  [[nodiscard]] bool inside(std::int32_t branch, const vessel::NearestCentreline& tip) const;

  std::shared_ptr<const vessel::CentrelineTree> tree_;
  SelfOverlap overlap_;
  std::vector<Event> begun_;
  EventMemory memory_;
};

}  // namespace endowire::sim

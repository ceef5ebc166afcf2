#include "endowire/sim/state.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/error.hpp"
#include "endowire/base/hash.hpp"
#include "endowire/sim/feed.hpp"

namespace endowire::sim {

std::uint64_t State::hash() const {
  base::Hash h;
  for (const double v :
       {inserted_mm, hand_turn_rad, grip_stretch_mm, grip_twist_rad, drift.advance_mm, drift.slip_mm})
    h.add(v);
  h.add(steps);
  for (const auto* list : {&joints_mm, &directors, &drift.joints_mm}) {
    h.add(static_cast<std::uint64_t>(list->size()));
    for (const Eigen::Vector3d& v : *list) {
      for (int c = 0; c < 3; ++c) h.add(v[c]);
    }
  }
  for (const auto* list :
       {&arc_mm, &spin_rad, &twist_rad, &drift.arc_mm, &friction.arc_mm, &friction.normal_n_per_mm}) {
    h.add(static_cast<std::uint64_t>(list->size()));
    for (const double v : *list) h.add(v);
  }
  h.add(static_cast<std::uint64_t>(friction.traction_n_per_mm.size()));
  for (const Eigen::Vector2d& v : friction.traction_n_per_mm) {
    h.add(v[0]);
    h.add(v[1]);
  }
  return h.value();
}

namespace {

bool sound(const std::vector<Eigen::Vector3d>& list) {
  return std::all_of(list.begin(), list.end(), [](const Eigen::Vector3d& v) { return v.allFinite(); });
}

bool sound(const std::vector<double>& list) {
  return std::all_of(list.begin(), list.end(), [](double v) { return std::isfinite(v); });
}

bool ascending(const std::vector<double>& arcs) {
  return sound(arcs) && std::is_sorted(arcs.begin(), arcs.end());
}

/// Rods stretch by thousandths. One that is far longer would be given samples and pieces without end; one without a length
/// has no direction.
bool as_long_as_their_material(const State& state) {
  constexpr double most_stretch = 2.0;
  constexpr double slack_mm = 1.0;  // of the rod that enters: its length is that of the grip's stretch, too
  const std::size_t rods = state.directors.size();
  for (std::size_t i = 0; i < rods; ++i) {
    const double end_mm = i + 2 < rods ? state.arc_mm[i + 1] : state.inserted_mm;
    const double material_mm = i + 1 < rods ? end_mm - state.arc_mm[i] : kSheathRod_mm;
    const double length_mm = (state.joints_mm[i] - state.joints_mm[i + 1]).norm();
    if (!(length_mm > 0.0 && length_mm <= most_stretch * material_mm + slack_mm)) return false;
  }
  return true;
}

void require(bool good, const char* what) {
  if (!good) throw base::InputError(what);
}

}  // namespace

void require_sound(const State& state, const StateLimits& limits) {
  const std::size_t rods = state.directors.size();
  const auto most = static_cast<std::size_t>(limits.most_rods);
  require(
      rods == 0 ? state.joints_mm.empty() && state.arc_mm.empty()
                : rods >= 2 && rods <= most && state.joints_mm.size() == rods + 1 &&
                      state.arc_mm.size() == rods - 1 && state.spin_rad.size() == rods &&
                      state.twist_rad.size() == rods + 1,
      "state: sizes of joints, arcs, directors, spin and twist do not belong together or to this instrument");
  for (const double v : {state.inserted_mm, state.hand_turn_rad, state.grip_stretch_mm, state.grip_twist_rad,
                         state.drift.advance_mm, state.drift.slip_mm})
    require(std::isfinite(v), "state: lengths, turns and grip must be finite");
  require(sound(state.joints_mm) && sound(state.directors) && sound(state.spin_rad) && sound(state.twist_rad),
          "state: joints, directors, spin and twist must be finite");
  require(rods == 0 ||
              (state.arc_mm[0] == 0.0 && ascending(state.arc_mm) && state.inserted_mm > state.arc_mm.back()),
          "state.arc_mm must begin with 0, ascend, and end before inserted_mm");
  require(std::all_of(state.directors.begin(), state.directors.end(),
                      [](const Eigen::Vector3d& d) { return std::abs(d.squaredNorm() - 1.0) < 1e-6; }),
          "state.directors must be of length one");
  require(state.inserted_mm <= limits.wire_length_mm,
          "state.inserted_mm must be within the length of the wire");
  require(rods == 0 || (state.joints_mm[rods - 1] - limits.access_mm).norm() <= kSheathRod_mm,
          "state.joints_mm must end in the sheath");
  require(as_long_as_their_material(state),
          "state.joints_mm must lie as far apart as the wire between them is long");
  const contact::FrictionMemory& friction = state.friction;
  require(friction.traction_n_per_mm.size() == friction.arc_mm.size() &&
              friction.normal_n_per_mm.size() == friction.arc_mm.size() &&
              friction.arc_mm.size() <= limits.most_samples && ascending(friction.arc_mm) &&
              sound(friction.normal_n_per_mm) &&
              std::all_of(friction.traction_n_per_mm.begin(), friction.traction_n_per_mm.end(),
                          [](const Eigen::Vector2d& t) { return t.allFinite(); }),
          "state.friction: its lists must be finite, equally long, not too long for this instrument, and "
          "arcs ascend");
  require(state.drift.joints_mm.size() == state.drift.arc_mm.size() && state.drift.arc_mm.size() <= most &&
              sound(state.drift.joints_mm) && ascending(state.drift.arc_mm),
          "state.drift: its lists must be finite, equally long, not too long for this instrument, and arcs "
          "ascend");
}

}  // namespace endowire::sim

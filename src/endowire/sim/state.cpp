#include "endowire/sim/state.hpp"

#include "endowire/base/hash.hpp"

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

}  // namespace endowire::sim

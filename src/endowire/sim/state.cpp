#include "endowire/sim/state.hpp"

#include "endowire/base/hash.hpp"

namespace endowire::sim {

std::uint64_t State::hash() const {
  base::Hash h;
  for (const double v :
       {inserted_mm, hand_turn_rad, grip_stretch_mm, grip_twist_rad, drift.advance_mm, drift.slip_mm})
    h.add(v);
  h.add(steps);
  h.add(static_cast<std::uint64_t>(joints_mm.size()));
  for (const auto* list : {&joints_mm, &directors, &drift.joints_mm}) {
    for (const Eigen::Vector3d& v : *list) {
      for (int c = 0; c < 3; ++c) h.add(v[c]);
    }
  }
  for (const auto* list : {&spin_rad, &twist_rad, &friction.arc_mm, &friction.normal_n_per_mm}) {
    for (const double v : *list) h.add(v);
  }
  for (const Eigen::Vector2d& v : friction.anchor_mm) {
    h.add(v[0]);
    h.add(v[1]);
  }
  return h.value();
}

}  // namespace endowire::sim

#include "endowire/io/saved_state.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "endowire/vessel/storage.hpp"

namespace endowire::io {

namespace {

constexpr vessel::StorageKind kind{0x4554415453574e45ULL /* "ENWSTATE" */, 1, "saved state",
                                   "it belongs to another scene, instrument or vessel"};

// One description of the format, walked by a writer and by a reader: they cannot part.

struct Write {
  vessel::StorageWriter& out;
  template <typename T>
  void number(const T& v) {
    out.value(v);
  }
  void any(double v) { out.value(v); }
  template <typename List, typename Each>
  void list(List& list, std::size_t, Each each) {
    out.value(static_cast<std::uint64_t>(list.size()));
    for (auto& v : list) each(v);
  }
};

struct Read {
  vessel::StorageReader& in;
  template <typename T>
  void number(T& v) {
    v = in.value<T>();
  }
  void number(double& v) {
    v = in.value<double>();
    if (!std::isfinite(v)) in.fail("a number is not finite");
  }
  void number(bool& v) {
    const auto byte = in.value<std::uint8_t>();
    if (byte > 1) in.fail("a flag is neither 0 nor 1");
    v = byte == 1;
  }
  void any(double& v) { v = in.value<double>(); }
  template <typename List, typename Each>
  void list(List& list, std::size_t bytes_each, Each each) {
    list.resize(in.size_of_array(bytes_each));
    for (auto& v : list) each(v);
  }
};

template <class Walk, class Vector>
void walk_vector(Walk& walk, Vector& v) {
  for (int k = 0; k < v.size(); ++k) walk.number(v[k]);
}

template <class Walk, class State>
void walk_state(Walk& walk, State& s) {
  const auto number = [&](auto& v) { walk.number(v); };
  const auto vector = [&](auto& v) { walk_vector(walk, v); };
  for (auto* v : {&s.inserted_mm, &s.hand_turn_rad, &s.grip_stretch_mm, &s.grip_twist_rad,
                  &s.drift.advance_mm, &s.drift.slip_mm})
    number(*v);
  number(s.steps);
  for (auto* list : {&s.joints_mm, &s.directors, &s.drift.joints_mm}) walk.list(*list, 24, vector);
  for (auto* list : {&s.arc_mm, &s.spin_rad, &s.twist_rad, &s.drift.arc_mm, &s.friction.arc_mm,
                     &s.friction.normal_n_per_mm})
    walk.list(*list, 8, number);
  walk.list(s.friction.traction_n_per_mm, 16, vector);
}

template <class Walk, class Memory>
void walk_events(Walk& walk, Memory& m) {
  for (auto& episode : m.episodes) {
    walk.number(episode.shown);
    walk.number(episode.open);
    walk.any(episode.quiet_mm);    // grows without bound under a hand that never rests
    walk.any(episode.sign.value);  // of a step that failed: whatever its residual was
    walk_vector(walk, episode.sign.position_mm);
    walk.number(episode.sign.branch);
  }
  walk.number(m.pushing);
  walk.number(m.pushed_mm);
  walk_vector(walk, m.tip_then_mm);
  walk.number(m.stalled);
  walk.number(m.branch);
  walk.number(m.place.branch);
  walk.number(m.place.arc_mm);
}

template <class Walk, class Snapshot>
void walk_snapshot(Walk& walk, Snapshot& s) {
  walk.list(s.points, 96, [&](auto& p) {
    walk_vector(walk, p.position_mm);
    for (auto* v : {&p.arc_mm, &p.radius_mm, &p.curvature_per_mm, &p.twist_rad, &p.wall_force_n_per_mm,
                    &p.friction_n_per_mm})
      walk.number(*v);
    walk_vector(walk, p.wall_force_direction);
  });
  for (auto* v : {&s.inserted_length_mm, &s.push_force_n, &s.torque_n_mm}) walk.number(*v);
}

template <class Walk, class Saved>
void walk_all(Walk walk, Saved& saved) {
  walk_state(walk, saved.state);
  walk_events(walk, saved.events);
  walk_snapshot(walk, saved.last);
}

}  // namespace

std::string pack_state(const SavedState& saved, std::uint64_t scene_key) {
  vessel::StorageWriter out(kind, scene_key, 1 << 14);
  out.value(static_cast<std::uint8_t>(saved.seed ? 1 : 0));
  out.value(saved.seed.value_or(0));
  walk_all(Write{out}, saved);
  const std::vector<std::byte> bytes = out.seal();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

SavedState unpack_state(const std::string& bytes, std::uint64_t scene_key, const std::string& label) {
  vessel::StorageReader in(std::as_bytes(std::span(bytes.data(), bytes.size())), kind, scene_key, label);
  SavedState saved;
  bool seeded = false;
  Read{in}.number(seeded);
  const auto seed = in.value<std::uint64_t>();
  if (seeded) saved.seed = seed;
  for (std::size_t k = 0; k < sim::event_kinds; ++k)
    saved.events.episodes[k].sign.kind = static_cast<sim::EventKind>(k);
  walk_all(Read{in}, saved);
  in.expect_end();
  const auto& joints = saved.state.joints_mm;
  if (!std::equal(joints.begin(), joints.end(), saved.last.points.begin(), saved.last.points.end(),
                  [](const auto& joint, const auto& point) { return joint == point.position_mm; }))
    in.fail("its forces are not those of its shape");
  return saved;
}

}  // namespace endowire::io

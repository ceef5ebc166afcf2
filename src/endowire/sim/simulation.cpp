#include "endowire/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "endowire/base/error.hpp"
#include "endowire/sim/chain_problem.hpp"
#include "endowire/sim/clearance.hpp"
#include "endowire/sim/measure.hpp"
#include "endowire/sim/predictor.hpp"
#include "endowire/sim/resolution.hpp"
#include "endowire/sim/sheath.hpp"
#include "endowire/sim/waypoints.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// A joint has snapped that is so far, after one sub-step, both off the trace of the wire before it and from where its motion of
/// the step before would have taken it.
constexpr double kSnap_mm = 1.5;
/// Local walls hold this far around the place of detection; a state beyond is detected anew.
constexpr double kRegion_mm = 0.8;
/// Halvings for a corner's sake.
constexpr int kCornerSplits = 3;
/// Corrections below which the walls are checked, before the solution is polished.
constexpr double kCheck_mm = 0.05;
/// Longest motion of a joint in one Newton iteration: local walls are believed about as far.
constexpr double kMaxStep_mm = 0.7;
/// Detections within one sub-step: a snap crosses the lumen in pieces of kRegion_mm.
constexpr int kMaxDetections = 400;
/// Corrections of touching walls within one sub-step: where the field has an edge, they need not come to rest. Over a crest that nearly
/// tips the wire over they settle by a tenth a time only.
constexpr int kMaxCorrections = 48;
/// From this one on the field's own error is allowed.
constexpr int kUnevenFrom = 12;
/// Room for samples: eight a millimetre are the most that a narrow lumen asks for, and some for ridges.
constexpr double kSamples_per_mm = 10.0;
constexpr std::size_t kLeastSamples = 400;
constexpr double kStandardGravity_floor = 1e-12;

[[noreturn]] void refuse(const std::string& text) {
  throw base::InputError(text);
}

std::string show(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << "[" << v[0] << ", " << v[1] << ", " << v[2] << "]";
  return text.str();
}

}  // namespace

class Simulation::Impl {
 public:
  Impl(std::shared_ptr<const vessel::Field> field, rod::Instrument instrument, Access access,
       SimulationSpec spec);

  const StepReport& step(const Command& command);
  void require_fitting(const State& state) const;
  void restore(const State& state);
  void save(State& out) const;
  void snapshot(Snapshot& out) const;
  void waypoint(int index, Snapshot& out) const;
  void observe_stages(base::StageObserver* observer);

  State state_;  ///< the last converged state
  StepReport report_;
  Waypoints waypoints_;
  Resolution resolution_;

 private:
  bool advance(const Command& command, int split);
  bool advance_once(const Command& command);
  bool settle();
  solve::Validity check_walls();
  void redetect();
  void detect_again();
  void keep_waypoint();
  [[nodiscard]] bool tip_cuts_corner(const Command& command) const;
  [[nodiscard]] bool leg_of_snap_cuts_corner(int attempt) const;
  void adapt_rods();
  void finish(const Command& command);
  void measure();
  [[nodiscard]] contact::Wire wire() const { return {line_, problem_.material, problem_.shape}; }
  [[nodiscard]] bool in_sheath() const { return problem_.shape.rods() == 0; }

  std::shared_ptr<const vessel::Field> field_;
  rod::MaterialLine line_;
  Access access_;
  SimulationSpec spec_;
  contact::ContactSpec contact_spec_;
  solve::NewtonSpec newton_spec_;

  ChainProblem problem_;
  Sheath sheath_;
  solve::Newton newton_;
  contact::FrictionMemory friction_;
  double hand_turn_rad_ = 0.0;
  int rounds_ = 0;       ///< detections of single samples since the detection of all
  int corrections_ = 0;  ///< of walls that touch, since then
  std::vector<Eigen::Vector3d> trace_;
  Drift drift_;
  std::vector<Eigen::Vector3d> traced_;  ///< the trace of the present step, without drift
  double hand_mm_ = 0.0;                 ///< advance of the hand in the present sub-step
  double traced_inserted_mm_ = 0.0;
  std::vector<Eigen::Vector3d> predicted_;
  int attempts_ = 0;  ///< sub-steps of the present step
  base::StageObserver* stages_ = nullptr;
};

Simulation::Impl::Impl(std::shared_ptr<const vessel::Field> field, rod::Instrument instrument, Access access,
                       SimulationSpec spec)
    : field_(std::move(field)), line_(std::move(instrument)), access_(access), spec_(spec) {
  if (!(access_.direction.norm() > 1e-9) || !access_.direction.allFinite()) {
    refuse("access.direction is " + show(access_.direction) + "; must be a finite vector, not zero");
  }
  if (!access_.position_mm.allFinite())
    refuse("access.position_mm is " + show(access_.position_mm) + "; must be finite");
  access_.direction.normalize();
  const double height = field_->at(access_.position_mm).distance_mm;
  if (!(height > 0.0)) {
    std::ostringstream text;
    text << "access.position_mm is " << show(access_.position_mm) << ", " << -height
         << " mm outside the lumen; must lie inside";
    refuse(text.str());
  }
  const double radius = line_.radius_mm(0.0);
  if (height < radius) {
    std::ostringstream text;
    text << "access.position_mm is " << show(access_.position_mm) << ", " << height
         << " mm from the wall; must be at least " << radius << " mm, the radius of "
         << line_.instrument().model;
    refuse(text.str());
  }

  const SolverSpec& solver = spec_.solver;
  contact_spec_.wall = spec_.wall;
  contact_spec_.stick_stiffness_ratio = solver.stick_stiffness_ratio;
  newton_spec_.correction_tolerance_mm = solver.correction_tolerance_mm;
  newton_spec_.correction_tolerance_rad = solver.correction_tolerance_deg * M_PI / 180.0;
  newton_spec_.force_tolerance = solver.force_tolerance;
  newton_spec_.proximal_scale = solver.proximal_scale;
  newton_spec_.max_iterations = solver.max_iterations;
  newton_spec_.max_step_mm = kMaxStep_mm;
  newton_spec_.check_correction_mm = kCheck_mm;
  problem_.checker = [this] { return check_walls(); };
  problem_.on_step = [this] {
    keep_waypoint();
    if (spec_.solver.detection == Detection::every_iteration) detect_again();
  };

  const double gravity_m_per_s2 = spec_.gravity_m_per_s2.norm();
  const rod::ImmersedWire immersed{&line_, gravity_m_per_s2, spec_.blood_density_g_per_mm3};
  solver.rods.validate("solver.rods");
  resolution_ = Resolution(solver.rods, immersed, *field_);
  sheath_ = Sheath(immersed, access_, resolution_);
  problem_.line = &line_;
  problem_.region_mm = kRegion_mm;
  if (gravity_m_per_s2 > kStandardGravity_floor) {
    problem_.loads.gravity_direction = spec_.gravity_m_per_s2 / gravity_m_per_s2;
  }
  Feed& feed = problem_.feed;
  feed.active = true;
  feed.point_mm = access_.position_mm;
  feed.direction = access_.direction;
  feed.push = {solver.grip_stiffness_n_per_mm, line_.instrument().grip_force_n};
  // The same stiffness at a lever of one millimetre.
  feed.torque = {solver.grip_stiffness_n_per_mm, line_.instrument().grip_torque_n_mm};

  const int joints = resolution_.most_rods() + 1;
  const auto samples = static_cast<std::size_t>(kSamples_per_mm * line_.length_mm()) + kLeastSamples;
  problem_.reserve(joints, samples);
  newton_.reserve(4 * (joints + 1));
  friction_.reserve(samples);
  trace_.reserve(at(joints + 1));
  for (auto* list : {&predicted_, &traced_, &drift_.joints_mm, &state_.drift.joints_mm})
    list->reserve(at(joints + 1));
  for (auto* list : {&drift_.arc_mm, &state_.drift.arc_mm, &state_.arc_mm}) list->reserve(at(joints));
  waypoints_.reserve(at(joints + 1));
  report_.events.reserve(16);
  state_.joints_mm.reserve(at(joints + 1));
  state_.directors.reserve(at(joints));
  state_.spin_rad.reserve(at(joints));
  state_.twist_rad.reserve(at(joints + 1));
  state_.friction.reserve(samples);
}

void Simulation::Impl::save(State& out) const {
  const rod::ChainShape& shape = problem_.shape;
  out.inserted_mm = problem_.feed.inserted_mm;
  out.hand_turn_rad = hand_turn_rad_;
  out.grip_stretch_mm = problem_.feed.stretch_mm;
  out.grip_twist_rad = problem_.feed.twist_rad;
  out.joints_mm.assign(shape.joints_mm.begin(), shape.joints_mm.end());
  const std::vector<double>& arcs = problem_.material.arc_mm;
  out.arc_mm.assign(arcs.begin(), arcs.begin() + std::max(0, shape.rods() - 1));
  out.directors.resize(shape.frames.size());
  for (std::size_t i = 0; i < shape.frames.size(); ++i) out.directors[i] = shape.frames[i].col(0);
  out.spin_rad.assign(shape.spin_rad.begin(), shape.spin_rad.end());
  out.twist_rad.assign(shape.twist_rad.begin(), shape.twist_rad.end());
  out.drift.advance_mm = drift_.advance_mm;
  out.drift.slip_mm = drift_.slip_mm;
  out.drift.arc_mm.assign(drift_.arc_mm.begin(), drift_.arc_mm.end());
  out.drift.joints_mm.assign(drift_.joints_mm.begin(), drift_.joints_mm.end());
  out.friction.arc_mm.assign(friction_.arc_mm.begin(), friction_.arc_mm.end());
  out.friction.traction_n_per_mm.assign(friction_.traction_n_per_mm.begin(),
                                        friction_.traction_n_per_mm.end());
  out.friction.normal_n_per_mm.assign(friction_.normal_n_per_mm.begin(), friction_.normal_n_per_mm.end());
}

void Simulation::Impl::require_fitting(const State& state) const {
  require_sound(
      state, {resolution_.most_rods(), friction_.arc_mm.capacity(), line_.length_mm(), access_.position_mm});
}

void Simulation::Impl::restore(const State& state) {
  const std::size_t rods = state.directors.size();
  if (&state != &state_) state_ = state;
  rod::ChainShape& shape = problem_.shape;
  hand_turn_rad_ = state.hand_turn_rad;
  problem_.feed.inserted_mm = state.inserted_mm;
  problem_.feed.stretch_mm = state.grip_stretch_mm;
  problem_.feed.twist_rad = state.grip_twist_rad;
  if (rods == 0) {
    Sheath::leave(problem_);
  } else {
    shape.resize(static_cast<int>(rods));
    shape.joints_mm.assign(state.joints_mm.begin(), state.joints_mm.end());
    shape.spin_rad.assign(state.spin_rad.begin(), state.spin_rad.end());
    shape.twist_rad.assign(state.twist_rad.begin(), state.twist_rad.end());
    for (std::size_t i = 0; i < rods; ++i) {
      const Eigen::Vector3d e = (shape.joints_mm[i] - shape.joints_mm[i + 1]).normalized();
      shape.frames[i].col(0) = state.directors[i];
      shape.frames[i].col(1) = e.cross(state.directors[i]);
      shape.frames[i].col(2) = e;
    }
    problem_.material.resize(static_cast<int>(rods));
    std::copy(state.arc_mm.begin(), state.arc_mm.end(), problem_.material.arc_mm.begin());
    sheath_.fill_from(0, problem_);
  }
  drift_.advance_mm = state.drift.advance_mm;
  drift_.slip_mm = state.drift.slip_mm;
  drift_.arc_mm.assign(state.drift.arc_mm.begin(), state.drift.arc_mm.end());
  drift_.joints_mm.assign(state.drift.joints_mm.begin(), state.drift.joints_mm.end());
  friction_.arc_mm.assign(state.friction.arc_mm.begin(), state.friction.arc_mm.end());
  friction_.traction_n_per_mm.assign(state.friction.traction_n_per_mm.begin(),
                                     state.friction.traction_n_per_mm.end());
  friction_.normal_n_per_mm.assign(state.friction.normal_n_per_mm.begin(),
                                   state.friction.normal_n_per_mm.end());
  problem_.contact.clear();
}

const StepReport& Simulation::Impl::step(const Command& command) {
  const base::StageScope stage(stages_, base::Stage::rest);
  std::vector<Event> events = std::move(report_.events);  // keeps its memory
  events.clear();
  report_ = StepReport{};
  report_.events = std::move(events);
  waypoints_.clear();
  attempts_ = 0;
  report_.converged = true;
  const bool finite = std::isfinite(command.advance_mm) && std::isfinite(command.torque_rad);
  const double pieces =
      std::max({1.0, std::ceil(std::abs(command.advance_mm) / spec_.max_advance_mm - 1e-9),
                std::ceil(std::abs(command.torque_rad) * 180.0 / M_PI / spec_.max_torque_deg - 1e-9)});
  constexpr double kMaxPieces = 1e6;
  if (!finite || pieces > kMaxPieces) {
    report_.converged = false;
    report_.solve.termination = solve::Termination::left_domain;
    report_.events.push_back({EventKind::not_converged, 0.0, access_.position_mm});
    measure();
    return report_;
  }
  const double before_mm = state_.inserted_mm;
  const Command piece{command.advance_mm / pieces, command.torque_rad / pieces};
  for (int k = 0; k < static_cast<int>(pieces) && report_.converged; ++k) {
    if (k > 0 && !in_sheath() && waypoints_.piece_is_due())
      waypoints_.keep(problem_.shape.joints_mm, problem_.material.arc_mm, attempts_);
    report_.converged = advance(piece, 0);
  }
  ++state_.steps;
  report_.hand_slip_mm = command.advance_mm - (state_.inserted_mm - before_mm);
  if (!report_.converged)
    report_.events.push_back({EventKind::not_converged, report_.solve.force_residual_n, access_.position_mm});
  measure();
  return report_;
}

/// One sub-step; halved and repeated when it fails. Afterwards the state is the last converged one.
bool Simulation::Impl::advance(const Command& command, int split) {
  const int attempt = ++attempts_;
  const bool divisible = command.advance_mm != 0.0 || command.torque_rad != 0.0;
  if (advance_once(command) && (!divisible || split >= kCornerSplits ||
                                !(tip_cuts_corner(command) || leg_of_snap_cuts_corner(attempt)))) {
    finish(command);
    return true;
  }
  restore(state_);
  waypoints_.forget(attempt);
  if (!divisible || split == spec_.solver.max_splits) return false;
  ++report_.splits;
  const Command half{0.5 * command.advance_mm, 0.5 * command.torque_rad};
  return advance(half, split + 1) && advance(half, split + 1);
}

bool Simulation::Impl::advance_once(const Command& command) {
  const base::StageScope stage(stages_, base::Stage::predict);
  Feed& feed = problem_.feed;
  // The end of the wire stays outside: there is nothing left to push.
  const double most = line_.length_mm() - kSheathRod_mm;
  hand_mm_ = std::min(command.advance_mm, most - feed.inserted_mm);
  const double slip = in_sheath() ? 0.0 : predicted_slip_mm(drift_, hand_mm_);
  const double advance_mm = hand_mm_ - slip;
  const double inserted = feed.inserted_mm + advance_mm;
  const bool in_sheath_before = in_sheath();
  if (in_sheath_before) {
    if (inserted < Sheath::kEntry_mm) {
      feed.inserted_mm = inserted;
      return true;
    }
    sheath_.enter(inserted, hand_turn_rad_ + command.torque_rad, problem_);
    problem_.contact.begin(wire(), friction_);
    traced_.assign(problem_.shape.joints_mm.begin(), problem_.shape.joints_mm.end());
    traced_inserted_mm_ = inserted;
  } else {
    if (inserted < Sheath::kLeave_mm) {  // back into the sheath
      Sheath::leave(problem_);
      friction_.clear();
      drift_.advance_mm = drift_.slip_mm = 0.0;
      drift_.arc_mm.clear();
      drift_.joints_mm.clear();
      feed.inserted_mm = inserted;
      feed.stretch_mm = feed.twist_rad = 0.0;
      return true;
    }
    adapt_rods();
    sheath_.adapt(inserted, problem_);
    problem_.contact.begin(wire(), friction_);
    follow_trace(problem_.material, {advance_mm, command.torque_rad}, problem_.shape, trace_);
    traced_.assign(problem_.shape.joints_mm.begin(), problem_.shape.joints_mm.end());
    follow_drift(drift_, problem_.material, hand_mm_, problem_.shape, trace_);
    feed.inserted_mm = traced_inserted_mm_ = inserted;
    feed.stretch_mm += slip;
    sheath_.fill_from(problem_.shape.rods() - 2, problem_);
  }
  const int n = problem_.shape.rods();
  {
    const base::StageScope placing(stages_, base::Stage::place);
    problem_.contact.place(wire(), n - 1, *field_, contact_spec_, in_sheath_before ? 0.0 : advance_mm);
  }
  problem_.release_all();
  problem_.hold_joint(n - 1, true, true, true);
  predicted_.assign(problem_.shape.joints_mm.begin(), problem_.shape.joints_mm.end());
  return settle();
}

/// Rods in the lumen become shorter or longer, as the shape asks for that the last step found.
void Simulation::Impl::adapt_rods() {
  const RodChanges changes = resolution_.adapt(problem_.material, problem_.shape);
  report_.rods_divided += changes.divided;
  report_.rods_joined += changes.joined;
  report_.resolution_energy_mj += changes.energy_mj;
}

/// Detects once and minimises; check_walls() is asked on the way.
bool Simulation::Impl::settle() {
  const base::StageScope stage(stages_, base::Stage::rest);
  contact::ContactSet& contact = problem_.contact;
  {
    const base::StageScope detecting(stages_, base::Stage::detect);
    contact.detect(wire(), *field_, contact_spec_);
  }
  report_.detections += 1.0;
  rounds_ = corrections_ = 0;
  report_.solve = newton_.minimise(problem_, newton_spec_);
  report_.newton_iterations += report_.solve.iterations;
  return report_.solve.converged();
}

/// Whether the local walls agree with the field; samples that they fail are detected anew, the others are not.
solve::Validity Simulation::Impl::check_walls() {
  if (spec_.solver.detection != Detection::as_needed) return solve::Validity::holds;
  const base::StageScope stage(stages_, base::Stage::verify);
  contact::ContactSet& contact = problem_.contact;
  ++report_.verifications;
  const bool rough = rounds_ >= kUnevenFrom;
  const contact::Verification walls =
      contact.verify(wire(), *field_, contact_spec_, rough, corrections_ < kMaxCorrections);
  const int wrong = walls.wrong_samples + contact.add_over_ridges(wire(), *field_, rough);
  if (wrong == 0) {
    if (problem_.inside_region()) {
      corrections_ += walls.corrected ? 1 : 0;
      if (corrections_ == kMaxCorrections) report_.walls_at_rest = false;
      return walls.corrected ? solve::Validity::corrected : solve::Validity::holds;
    }
    // A state on its way that no wall contradicts goes on from where it is.
    contact.mark_outside(problem_.shape, problem_.region_mm);
  }
  if (++rounds_ == kMaxDetections) return solve::Validity::hopeless;
  redetect();
  return solve::Validity::changed;
}

/// Detects the samples found wrong, and counts each as its part of a detection.
void Simulation::Impl::redetect() {
  const base::StageScope stage(stages_, base::Stage::detect);
  contact::ContactSet& contact = problem_.contact;
  report_.detections += static_cast<double>(contact.redetect(wire(), *field_, contact_spec_)) /
                        static_cast<double>(contact.samples().size());
}

/// Detection of the whole wire on its way to equilibrium.
void Simulation::Impl::detect_again() {
  const base::StageScope stage(stages_, base::Stage::detect);
  problem_.contact.detect_again(wire(), *field_, contact_spec_);
  report_.detections += 1.0;
}

bool Simulation::Impl::tip_cuts_corner(const Command& command) const {
  return !in_sheath() && !state_.joints_mm.empty() &&
         cuts_corner(*field_, state_.joints_mm[0], problem_.shape.joints_mm[0], line_.radius_mm(0.0),
                     command.advance_mm);
}

/// Of the legs of a snap the first is longer the further the hand moves: halving the command shortens it.
bool Simulation::Impl::leg_of_snap_cuts_corner(int attempt) const {
  const Waypoints::Shape* first = waypoints_.first_of(attempt);
  if (first == nullptr || state_.arc_mm.empty()) return false;
  // Up to the rod that enters, which comes straight from the sheath.
  return leg_cuts_corner(*field_, line_,
                         {state_.joints_mm.data(), state_.arc_mm.data(), state_.arc_mm.size()},
                         {waypoints_.joints_mm(*first), waypoints_.arc_mm(*first), first->joints - 2});
}

/// Keeps the present shape, on its way to equilibrium, if the wire has moved since the last one kept and lies clear.
void Simulation::Impl::keep_waypoint() {
  const base::StageScope stage(stages_, base::Stage::rest);
  const std::vector<Eigen::Vector3d>& joints = problem_.shape.joints_mm;
  const Eigen::Vector3d* last = waypoints_.last_mm(joints.size());
  if (last == nullptr) last = predicted_.data();
  double moved = 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) moved = std::max(moved, (joints[j] - last[j]).norm());
  if (waypoints_.far_enough(moved) && lies_clear(wire(), *field_, spec_.wall.max_deflection_mm))
    waypoints_.keep(joints, problem_.material.arc_mm, attempts_);
}

void Simulation::Impl::waypoint(int index, Snapshot& out) const {
  const Waypoints::Shape& shape = waypoints_.shape(index);
  out = Snapshot{};
  out.inserted_length_mm = waypoints_.arc_mm(shape)[shape.joints - 2];
  for (std::size_t j = 0; j < shape.joints; ++j) {
    SnapshotPoint point;
    point.position_mm = waypoints_.joints_mm(shape)[j];
    point.arc_mm = waypoints_.arc_mm(shape)[j];
    point.radius_mm = line_.radius_mm(point.arc_mm);
    out.points.push_back(point);
  }
}

void Simulation::Impl::observe_stages(base::StageObserver* observer) {
  stages_ = observer;
  newton_.observe_stages(observer);
}

void Simulation::Impl::finish(const Command& command) {
  Feed& feed = problem_.feed;
  if (in_sheath()) {
    hand_turn_rad_ += command.torque_rad;
  } else {
    const rod::ChainShape& shape = problem_.shape;
    const double beyond_trace_mm = feed.inserted_mm - traced_inserted_mm_;
    bool snapped = false;
    const std::size_t free = shape.frames.size() - 1;
    drift_.joints_mm.resize(free);
    for (std::size_t j = 0; j < free; ++j) {
      drift_.joints_mm[j] = shape.joints_mm[j] - traced_[j] - beyond_trace_mm * shape.frames[j].col(2);
      const double jump_mm =
          std::min(drift_.joints_mm[j].norm(), (shape.joints_mm[j] - predicted_[j]).norm());
      if (snapped || jump_mm < kSnap_mm) continue;
      snapped = report_.snapped = true;
      report_.events.push_back({EventKind::snap, jump_mm, shape.joints_mm[j]});
    }
    drift_.advance_mm = snapped ? 0.0 : hand_mm_;
    drift_.slip_mm = hand_mm_ - (feed.inserted_mm - state_.inserted_mm);
    drift_.arc_mm.assign(problem_.material.arc_mm.begin(),
                         problem_.material.arc_mm.begin() + static_cast<std::ptrdiff_t>(free));
    problem_.contact.remember(shape, friction_);
    feed.stretch_mm = contact::friction_anchor(feed.push, {feed.stretch_mm, 0.0})[0];
    feed.twist_rad = contact::friction_anchor(feed.torque, {feed.twist_rad, 0.0})[0];
    hand_turn_rad_ = shape.spin_rad.back();
  }
  save(state_);
}

/// Forces, extremes and events of the state that the step ended with.
void Simulation::Impl::measure() {
  report_.inserted_length_mm = state_.inserted_mm;
  report_.rods = problem_.shape.rods();
  report_.contact_samples = static_cast<int>(problem_.contact.samples().size());
  if (in_sheath()) return;
  report_.push_force_n = problem_.push_force_n();
  report_.torque_n_mm = problem_.hand_torque_n_mm();
  const WallForces wall = measure_wall(problem_);
  report_.max_wall_deflection_mm = wall.max_deflection_mm;
  report_.max_force_5mm_n = wall.max_window_n;
  report_.tip_force_n = wall.tip_window_n;
  const Eigen::Vector3d& tip = problem_.shape.joints_mm[0];
  if (wall.tip_window_n >= spec_.perforation_force_n) {
    report_.events.push_back({EventKind::perforation, wall.tip_window_n, tip});
  }
  if (wall.narrowest_clearance_mm < 0.0) {
    report_.events.push_back({EventKind::too_narrow, wall.narrowest_clearance_mm, wall.narrowest_at_mm});
  }
  const KinkReserve kink = measure_kink(problem_);
  if (kink.ratio > 1.0) report_.events.push_back({EventKind::kink, kink.curvature_per_mm, kink.position_mm});
  const int opening = field_->exit_at(tip);
  if (opening > 0) report_.events.push_back({EventKind::exit, static_cast<double>(opening), tip});
  if (std::abs(report_.hand_slip_mm) > 1e-2) {
    report_.events.push_back({EventKind::hand_slip, report_.hand_slip_mm, access_.position_mm});
  }
}

void Simulation::Impl::snapshot(Snapshot& out) const {
  fill_snapshot(problem_, line_, out);
  out.inserted_length_mm = state_.inserted_mm;
  out.push_force_n = in_sheath() ? 0.0 : problem_.push_force_n();
  out.torque_n_mm = in_sheath() ? 0.0 : problem_.hand_torque_n_mm();
}

Simulation::Simulation(std::shared_ptr<const vessel::Field> field, rod::Instrument instrument, Access access,
                       SimulationSpec spec)
    : impl_(std::make_unique<Impl>(std::move(field), std::move(instrument), access, spec)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const StepReport& Simulation::step(const Command& command) {
  return impl_->step(command);
}
const State& Simulation::state() const {
  return impl_->state_;
}
void Simulation::restore(const State& state) {
  impl_->require_fitting(state);
  impl_->restore(state);
}
int Simulation::most_rods() const {
  return impl_->resolution_.most_rods();
}
std::uint64_t Simulation::state_hash() const {
  return impl_->state_.hash();
}
void Simulation::snapshot(Snapshot& out) const {
  impl_->snapshot(out);
}
int Simulation::waypoints() const {
  return impl_->waypoints_.size();
}
void Simulation::waypoint(int index, Snapshot& out) const {
  impl_->waypoint(index, out);
}
void Simulation::observe_stages(base::StageObserver* observer) {
  impl_->observe_stages(observer);
}

}  // namespace endowire::sim

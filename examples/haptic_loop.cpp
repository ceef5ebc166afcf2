// haptic_loop [--seconds S] [--speed MM_PER_S] [--fifo PRIORITY] [--unpaced] [SCENE.toml]
//
// A fixed loop of 1 kHz as the driver of a haptic device runs it: read the hand, step the wire, write force and torque.
// Replace haptic::SimulatedDevice by the driver of a device; docs/haptic.md tells the rest. With --unpaced the loop does not wait for
// its ticks: that measures steps, not deadlines.
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/places.hpp"
#include "endowire/io/prepared_scene.hpp"
#include "endowire/io/statistics.hpp"
#include "haptic/coupling.hpp"
#include "haptic/device.hpp"
#include "haptic/tick_clock.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;

constexpr std::int64_t kTick_ns = 1'000'000;
constexpr double kTick_s = 1e-3;

struct Options {
  double seconds = 60.0;
  double speed_mm_per_s = 20.0;
  double turn_rad_per_s = 1.0;
  int fifo = 0;  ///< priority; 0: as every other program
  bool paced = true;
  fs::path scene = fs::path(ENDOWIRE_SOURCE_DIR) / "scenes" / "generated_left_carotid.toml";
};

/// What is measured; its memory is there before the loop begins.
struct Measured {
  explicit Measured(std::size_t most) {
    for (auto* list : {&calm_us, &snap_us, &late_us}) list->reserve(most);
  }
  std::vector<double> calm_us, snap_us;             ///< step times without and with a snap
  std::vector<double> late_us;                      ///< from the beginning of a tick to its thread running
  std::int64_t ticks = 0, missed = 0, missing = 0;  ///< `missing` steps missed `missed` ticks
  std::int64_t flagged = 0, not_converged = 0, not_finite = 0, snaps = 0;
  double most_force_n = 0.0, most_torque_n_mm = 0.0;
};

/// Real-time scheduling and no page faults, where the system allows it.
void ask_for_real_time(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  if (::sched_setscheduler(0, SCHED_FIFO, &wanted) != 0)
    fmt::print("SCHED_FIFO is not permitted: run as root, or grant rtprio in /etc/security/limits.conf\n");
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) fmt::print("memory could not be locked\n");
}

/// The loop. Nothing in it allocates, locks, prints or waits for anything but the clock.
void loop(sim::Simulation& simulation, haptic::SimulatedDevice& device, bool paced, Measured& m) {
  haptic::Coupling coupling;
  const auto ticks = static_cast<std::int64_t>(m.late_us.capacity());
  const haptic::TickClock clock(kTick_ns);
  haptic::HandPosition hand;
  bool missed = false;
  for (std::int64_t tick = 0; tick < ticks;) {
    if (paced) m.late_us.push_back(1e-3 * static_cast<double>(clock.wait(tick)));
    hand = device.position(kTick_s);
    const sim::Command command = coupling.command(hand);
    const std::int64_t before_ns = haptic::TickClock::now_ns();
    const sim::StepReport& report = simulation.step(command);
    const std::int64_t after_ns = haptic::TickClock::now_ns();
    const haptic::HandForce force = coupling.force(command, report, missed);
    device.output(force);

    (report.snapped ? m.snap_us : m.calm_us).push_back(1e-3 * static_cast<double>(after_ns - before_ns));
    ++m.ticks;
    m.snaps += report.snapped ? 1 : 0;
    m.flagged += force.flagged ? 1 : 0;
    m.not_converged += report.converged ? 0 : 1;
    m.not_finite += std::isfinite(force.force_n) && std::isfinite(force.torque_n_mm) ? 0 : 1;
    m.most_force_n = std::max(m.most_force_n, std::abs(force.force_n));
    m.most_torque_n_mm = std::max(m.most_torque_n_mm, std::abs(force.torque_n_mm));

    // A miss: while this thread was still at work ticks began, in which the device held its last force. The hand went on.
    const std::int64_t next =
        paced ? std::max(tick + 1, clock.tick_at(haptic::TickClock::now_ns()) + 1) : tick + 1;
    missed = next > tick + 1;
    m.missed += next - tick - 1;
    m.missing += missed ? 1 : 0;
    for (std::int64_t held = tick + 1; held < std::min(next, ticks); ++held) hand = device.position(kTick_s);
    tick = next;
  }
}

void row(const char* name, const std::vector<double>& us) {
  const auto at = [&](double fraction) { return io::percentile(us, fraction); };
  if (us.empty()) return fmt::print("{:<26}none\n", name);
  fmt::print("{:<26}p50 {:.0f}, p90 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} us ({})\n", name, at(0.5),
             at(0.9), at(0.99), at(0.999), at(1.0), us.size());
}

/// @return  exit code: 3 when a step did not converge or a force was no number
int run(const Options& options) {
  const io::SceneFile scene = io::read_scene_file(
      options.scene, io::instrument_folders({}, ENDOWIRE_SOURCE_DIR), io::Script::optional);
  const io::PreparedScene prepared = io::prepare_scene(scene, io::default_cache_folder());
  sim::Simulation simulation = io::simulation_of(prepared);
  haptic::SimulatedDevice device(scene.motions, options.speed_mm_per_s, options.turn_rad_per_s);
  Measured m(static_cast<std::size_t>(options.seconds / kTick_s));
  if (options.fifo > 0) ask_for_real_time(options.fifo);
  loop(simulation, device, options.paced, m);

  fmt::print("{:<26}{}, {:.3g} mm a tick at most, {:.0f} mm inserted in {:.1f} s\n", "scene",
             options.scene.filename().string(), options.speed_mm_per_s * kTick_s,
             simulation.state().inserted_mm, options.seconds);
  fmt::print("{:<26}{} of {} ticks, by {} steps that took too long\n", "missed",
             options.paced ? std::to_string(m.missed) : "not measured (--unpaced), none", m.ticks + m.missed,
             m.missing);
  row("step, no snap", m.calm_us);
  row("step, with a snap", m.snap_us);
  if (options.paced) row("woken late", m.late_us);
  fmt::print("{:<26}{} steps with a force held or led to its new value\n", "flagged", m.flagged);
  fmt::print("{:<26}{} steps not converged, {} forces not finite\n", "failed", m.not_converged, m.not_finite);
  fmt::print("{:<26}{:.2f} N, {:.2f} N mm\n", "most felt", m.most_force_n, m.most_torque_n_mm);
  fmt::print("{:<26}{:016x}\n", "state hash", simulation.state_hash());
  return m.not_converged > 0 || m.not_finite > 0 ? 3 : 0;
}

/// @throws base::InputError naming the option
Options read(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const auto number = [&](double low, double high) {
      double value = std::nan("");
      try {
        value = std::stod(arguments.at(i + 1));
      } catch (const std::exception&) {  // told below
      }
      if (!(value >= low && value <= high))
        throw base::InputError(fmt::format("haptic_loop: {} must be a number, {} … {}", a, low, high));
      ++i;
      return value;
    };
    if (a == "--seconds")
      options.seconds = number(0.001, 3600.0);
    else if (a == "--speed")
      options.speed_mm_per_s = number(0.1, 100.0);
    else if (a == "--fifo")
      options.fifo = static_cast<int>(number(1, 99));
    else if (a == "--unpaced")
      options.paced = false;
    else if (a.rfind("--", 0) == 0 || i + 1 != arguments.size())
      throw base::InputError(
          "usage: haptic_loop [--seconds S] [--speed MM_PER_S] [--fifo PRIORITY] [--unpaced] [SCENE.toml]");
    else
      options.scene = a;
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(read({argv + 1, argv + argc}));
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", io::one_line(error.what()));
    return 2;
  }
}

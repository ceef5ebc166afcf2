#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/scenario.hpp"
#include "harness/stage_clock.hpp"

namespace endowire::bench {

/// One step of a procedure. Times are medians over the times that it was played.
struct StepRow {
  double travel_mm = 0.0;  ///< of the hand, to and fro
  double inserted_mm = 0.0;
  int rods = 0;
  int samples = 0;
  int iterations = 0;
  bool snapped = false;
  bool converged = false;
  bool split = false;
  double cpu_us = 0.0;  ///< without the stage clock
  StageTimes stage_us{};
};

/// Percentiles of a time. [µs]
struct Percentiles {
  std::size_t count = 0;
  double p50 = 0.0, p95 = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;
};
[[nodiscard]] Percentiles percentiles_of(const std::vector<double>& us);

/// What a scenario came to.
struct Measured {
  Scenario scenario;
  std::string processor, compiler;
  double calibration_before_ns = 0.0, calibration_after_ns = 0.0;
  std::size_t triangles = 0;
  double field_mb = 0.0, prepare_s = 0.0, field_s = 0.0, peak_mb = 0.0;
  int rounds = 0;  ///< times that the procedure was played without the stage clock
  std::size_t steps = 0, converged = 0, snaps = 0, splits = 0;
  int most_rods = 0, most_samples = 0;
  double mean_rods = 0.0, mean_samples = 0.0, mean_iterations = 0.0, mean_factorisations = 0.0,
         calm_detections = 0.0;
  double us_per_iteration_and_rod = 0.0;  ///< all computing over Σ (iterations · rods), calm steps
  Percentiles calm, snap;                 ///< computing time of this thread, steps without and with a snap
  Percentiles wall;        ///< time on the wall, steps without a snap: what else the machine did included
  double total_ms = 0.0;   ///< computing of one round
  double ms_per_mm = 0.0;  ///< of travel of the hand; a step that turns alone has none
  double inserted_mm = 0.0, push_n = 0.0;  ///< at the end
  double shortened_mm =
      0.0;  ///< by how much the push has compressed the wire at the end: elasticity, not lag
  double tip_lag_mm =
      0.0;  ///< the furthest that the tip still moves when the hand stops, tried every 25 steps
  double clock_share = 0.0;  ///< by how much the stage clock slowed a round
  std::uint64_t state_hash = 0;
  bool same_bits = false;  ///< every round, with the stage clock and without, ended in the same state
  StageTimes mean_stage_us{};
  std::vector<StepRow> rows;
};

struct MeasureOptions {
  std::filesystem::path cache_folder;  ///< empty: the field is prepared now
  bool stages = true;                  ///< also rounds with the stage clock
  bool once = false;                   ///< one round, whatever the scenario asks for
};

[[nodiscard]] Measured measure(const Scenario& scenario, const MeasureOptions& options);

}  // namespace endowire::bench

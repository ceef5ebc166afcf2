#include "harness/results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "endowire/io/file.hpp"
#include "harness/stage_picture.hpp"

namespace endowire::bench {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostLines = 1'000;

ordered_json percentiles_json(const Percentiles& p) {
  return {{"count", p.count}, {"p50", p.p50},    {"p95", p.p95},
          {"p99", p.p99},     {"p99.9", p.p999}, {"max", p.max}};
}

/// Key of a stage in files.
std::string key_of(std::string_view stage) {
  std::string key(stage);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key + "_us";
}

/// Three significant digits, without exponents.
std::string short_text(double value) {
  return value >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// The columns of summary.csv: paths into a result.
const std::vector<std::string> kColumns{"/scenario",
                                        "/triangles",
                                        "/steps",
                                        "/converged",
                                        "/snaps",
                                        "/splits",
                                        "/rods/mean",
                                        "/rods/most",
                                        "/samples/mean",
                                        "/samples/most",
                                        "/newton_iterations_mean",
                                        "/factorisations_mean",
                                        "/calm_detections_mean",
                                        "/calm_us/count",
                                        "/calm_us/p50",
                                        "/calm_us/p95",
                                        "/calm_us/p99",
                                        "/calm_us/p99.9",
                                        "/calm_us/max",
                                        "/snap_us/count",
                                        "/snap_us/p50",
                                        "/snap_us/p95",
                                        "/snap_us/p99",
                                        "/snap_us/max",
                                        "/wall_clock_us/p50",
                                        "/wall_clock_us/p99",
                                        "/wall_clock_us/p99.9",
                                        "/us_per_iteration_and_rod",
                                        "/ms_per_mm",
                                        "/inserted_mm",
                                        "/tip_lag_mm",
                                        "/shortened_mm",
                                        "/push_n",
                                        "/crossings",
                                        "/peak_mb",
                                        "/field_mb",
                                        "/field_s",
                                        "/prepare_s",
                                        "/calibration_before_ns",
                                        "/calibration_after_ns",
                                        "/state_hash"};

}  // namespace

ordered_json to_json(const Measured& m) {
  ordered_json stages = ordered_json::object();
  for (std::size_t s = 1; s < base::kStages; ++s) stages[key_of(stage_names[s])] = m.mean_stage_us[s];
  return {{"scenario", m.scenario.name},
          {"what", m.scenario.what},
          {"processor", m.processor},
          {"compiler", m.compiler},
          {"calibration_before_ns", m.calibration_before_ns},
          {"calibration_after_ns", m.calibration_after_ns},
          {"triangles", m.triangles},
          {"field_mb", m.field_mb},
          {"field_s", m.field_s},
          {"prepare_s", m.prepare_s},
          {"peak_mb", m.peak_mb},
          {"rounds", m.rounds},
          {"steps", m.steps},
          {"converged", m.converged},
          {"snaps", m.snaps},
          {"splits", m.splits},
          {"rods", {{"mean", m.mean_rods}, {"most", m.most_rods}}},
          {"samples", {{"mean", m.mean_samples}, {"most", m.most_samples}}},
          {"newton_iterations_mean", m.mean_iterations},
          {"factorisations_mean", m.mean_factorisations},
          {"calm_detections_mean", m.calm_detections},
          {"calm_us", percentiles_json(m.calm)},
          {"snap_us", percentiles_json(m.snap)},
          {"wall_clock_us", percentiles_json(m.wall)},
          {"us_per_iteration_and_rod", m.us_per_iteration_and_rod},
          {"total_ms", m.total_ms},
          {"ms_per_mm", m.ms_per_mm},
          {"inserted_mm", m.inserted_mm},
          {"push_n", m.push_n},
          {"shortened_mm", m.shortened_mm},
          {"tip_lag_mm", m.tip_lag_mm},
          {"crossings", nullptr},
          {"stages_mean_us", stages},
          {"stage_clock_share", m.clock_share},
          {"same_bits", m.same_bits},
          {"state_hash", fmt::format("{:016x}", m.state_hash)}};
}

std::string steps_csv(const Measured& m) {
  std::string out =
      "step,travel_mm,inserted_mm,rods,samples,newton_iterations,snaps,not_converged,cpu_us,max_cpu_us";
  for (std::size_t s = 1; s < base::kStages; ++s) out += "," + key_of(stage_names[s]);
  out += "\n";
  const std::size_t together = (m.rows.size() + kMostLines - 1) / kMostLines;
  for (std::size_t from = 0; from < m.rows.size(); from += together) {
    const std::size_t to = std::min(m.rows.size(), from + together);
    const double n = static_cast<double>(to - from);
    double rods = 0.0, samples = 0.0, iterations = 0.0, us = 0.0, most_us = 0.0;
    int snaps = 0, failed = 0;
    StageTimes stages{};
    for (std::size_t i = from; i < to; ++i) {
      const StepRow& row = m.rows[i];
      rods += row.rods / n;
      samples += row.samples / n;
      iterations += row.iterations / n;
      us += row.cpu_us / n;
      most_us = std::max(most_us, row.cpu_us);
      snaps += row.snapped ? 1 : 0;
      failed += row.converged ? 0 : 1;
      for (std::size_t s = 0; s < stages.size(); ++s) stages[s] += row.stage_us[s] / n;
    }
    const StepRow& last = m.rows[to - 1];
    out += fmt::format("{},{:.3f},{:.3f},{:g},{:g},{:g},{},{},{:.1f},{:.1f}", to, last.travel_mm,
                       last.inserted_mm, rods, samples, iterations, snaps, failed, us, most_us);
    for (std::size_t s = 1; s < stages.size(); ++s) out += fmt::format(",{:.1f}", stages[s]);
    out += "\n";
  }
  return out;
}

void write_results(const std::filesystem::path& folder, const Measured& measured) {
  std::filesystem::create_directories(folder);
  io::write_file_atomically(folder / (measured.scenario.name + ".csv"), steps_csv(measured));
  io::write_file_atomically(folder / (measured.scenario.name + ".svg"), stage_picture_svg(measured));
  io::write_file_atomically(folder / (measured.scenario.name + ".json"), to_json(measured).dump(2) + "\n");
}

std::string summary_csv(const std::vector<ordered_json>& results) {
  std::string out;
  for (const std::string& column : kColumns) {
    std::string name = column.substr(1);
    std::replace(name.begin(), name.end(), '/', '_');
    out += (out.empty() ? "" : ",") + name;
  }
  out += "\n";
  for (const ordered_json& result : results) {
    std::string line;
    for (const std::string& column : kColumns) {
      const ordered_json& value = result.at(ordered_json::json_pointer(column));
      line += (line.empty() ? "" : ",");
      if (value.is_number_float()) line += fmt::format("{:.5g}", value.get<double>());
      if (value.is_number_integer()) line += fmt::format("{}", value.get<long long>());
      if (value.is_string()) line += value.get<std::string>();
    }
    out += line + "\n";
  }
  return out;
}

std::string summary_table(const std::vector<ordered_json>& results) {
  std::string out =
      fmt::format("{:<36}{:>7}{:>6}{:>9}{:>7}{:>7}{:>8}{:>8}{:>8}{:>8}{:>16}{:>9}{:>6}{:>7}{:>7}  {}\n",
                  "scenario", "steps", "rods", "samples", "iter.", "p50", "p95", "p99", "p99.9", "max",
                  "snap p50 / max", "ms/mm", "MB", "prep.", "calib.", "state");
  for (const ordered_json& r : results) {
    const ordered_json& us = r["calm_us"];
    const ordered_json& snap = r["snap_us"];
    const auto time = [](const ordered_json& value) { return short_text(value.get<double>()); };
    const std::string notes =
        (r["converged"] == r["steps"]
             ? ""
             : fmt::format("  {} NOT CONVERGED", r["steps"].get<long>() - r["converged"].get<long>())) +
        (r["same_bits"].get<bool>() ? "" : "  BITS DIFFER") +
        (r["crossings"].is_null() ? "" : fmt::format("  {} crossings", r["crossings"].get<long>()));
    out += fmt::format(
        "{:<36}{:>7}{:>6.0f}{:>9.0f}{:>7.1f}{:>7}{:>8}{:>8}{:>8}{:>8}{:>16}{:>9.3f}{:>6.0f}{:>7.1f}{:>7.2f}  "
        "{}{}\n",
        r["scenario"].get<std::string>(), us["count"].get<long>(), r["rods"]["mean"].get<double>(),
        r["samples"]["mean"].get<double>(), r["newton_iterations_mean"].get<double>(), time(us["p50"]),
        time(us["p95"]), time(us["p99"]), time(us["p99.9"]), time(us["max"]),
        snap["count"] == 0 ? std::string("-") : time(snap["p50"]) + " / " + time(snap["max"]),
        r["ms_per_mm"].get<double>(), r["peak_mb"].get<double>(), r["prepare_s"].get<double>(),
        r["calibration_after_ns"].get<double>(), r["state_hash"].get<std::string>().substr(0, 8), notes);
  }
  return out +
         "Times of steps without a snap are computing time of one thread [us]; prep. [s], calib. [ns] of a "
         "dependent multiply-add.\n";
}

}  // namespace endowire::bench

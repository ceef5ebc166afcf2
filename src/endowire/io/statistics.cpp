#include "endowire/io/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::io {

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  const double rank = std::ceil(fraction * static_cast<double>(values.size()));
  const auto index =
      static_cast<std::ptrdiff_t>(std::clamp(rank, 1.0, static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

std::string_view name_of(sim::EventKind kind) {
  switch (kind) {
    case sim::EventKind::snap:
      return "snap";
    case sim::EventKind::perforation:
      return "perforation";
    case sim::EventKind::kink:
      return "kink";
    case sim::EventKind::exit:
      return "exit";
    case sim::EventKind::too_narrow:
      return "too_narrow";
    case sim::EventKind::hand_slip:
      return "hand_slip";
    case sim::EventKind::not_converged:
      return "not_converged";
    case sim::EventKind::stall:
      return "stall";
    case sim::EventKind::new_branch:
      return "new_branch";
    case sim::EventKind::self_overlap:
      return "self_overlap";
  }
  return "unknown";
}

std::string_view unit_of(sim::EventKind kind) {
  switch (kind) {
    case sim::EventKind::perforation:
    case sim::EventKind::not_converged:
    case sim::EventKind::stall:
      return "N";
    case sim::EventKind::kink:
      return "1/mm";
    case sim::EventKind::exit:
      return "";
    case sim::EventKind::snap:
    case sim::EventKind::too_narrow:
    case sim::EventKind::hand_slip:
    case sim::EventKind::new_branch:
    case sim::EventKind::self_overlap:
      break;
  }
  return "mm";
}

std::string_view name_of(solve::Termination termination) {
  switch (termination) {
    case solve::Termination::converged:
      return "converged";
    case solve::Termination::iteration_limit:
      return "iteration limit";
    case solve::Termination::stalled:
      return "stalled";
    case solve::Termination::left_domain:
      return "left its domain";
  }
  return "unknown";
}

void RunStatistics::add(double time_s, const sim::StepReport& report, std::span<const sim::Event> begun,
                        double wall_time_us) {
  ++steps;
  if (report.converged) {
    ++converged_steps;
  } else if (failed.empty()) {
    failed.push_back({steps, time_s, report.inserted_length_mm, report.solve});
  }
  if (report.splits > 0) ++split_steps;
  detections += report.detections;
  if (!report.snapped) calm_detections += report.detections;
  verifications += static_cast<std::uint64_t>(std::max(0, report.verifications));
  least_rods = steps == 1 ? report.rods : std::min(least_rods, report.rods);
  most_rods = std::max(most_rods, report.rods);
  last_rods = report.rods;
  rods += report.rods;
  rods_divided += static_cast<std::uint64_t>(std::max(0, report.rods_divided));
  rods_joined += static_cast<std::uint64_t>(std::max(0, report.rods_joined));
  max_resolution_energy_mj = std::max(max_resolution_energy_mj, report.resolution_energy_mj);
  most_contact_samples = std::max(most_contact_samples, report.contact_samples);
  max_force_5mm_n = std::max(max_force_5mm_n, report.max_force_5mm_n);
  max_tip_force_n = std::max(max_tip_force_n, report.tip_force_n);
  max_push_force_n = std::max(max_push_force_n, report.push_force_n);
  min_push_force_n = std::min(min_push_force_n, report.push_force_n);
  max_torque_n_mm = std::max(max_torque_n_mm, std::abs(report.torque_n_mm));
  hand_slip_mm += report.hand_slip_mm;
  newton_iterations.push_back(report.newton_iterations);
  wall_deflection_mm.push_back(report.max_wall_deflection_mm);
  (report.snapped ? snap_step_us : step_us).push_back(wall_time_us);
  for (const sim::Event& event : begun) events.push_back({steps, time_s, event});
}

}  // namespace endowire::io

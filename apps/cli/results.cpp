#include "results.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include "crossings.hpp"
#include "endowire/io/report.hpp"
#include "endowire/io/summary.hpp"
#include "endowire/math/processor.hpp"

namespace endowire::cli {

namespace {

namespace fs = std::filesystem;

const char* instruction_set() {
#if defined(__x86_64__)
  return math::runs_avx2() ? "x86-64 with AVX2" : "x86-64";
#elif defined(__aarch64__)
  return "arm64";
#else
  return "other";
#endif
}

std::string crossings_text(const io::CrossingVerdict& verdict) {
  return verdict.crossings ? fmt::format("{}", *verdict.crossings) : verdict.note;
}

/// "2 snap, 1 new_branch", in the order in which the kinds first came.
std::string events_text(const io::RunStatistics& statistics) {
  std::vector<std::pair<std::string_view, int>> counts;
  for (const io::TimedEvent& timed : statistics.events) {
    const std::string_view kind = io::name_of(timed.event.kind);
    const auto found =
        std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == kind; });
    if (found == counts.end())
      counts.emplace_back(kind, 1);
    else
      ++found->second;
  }
  std::string text;
  for (const auto& [kind, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text.empty() ? "none" : text;
}

std::string target_text(const Procedure& procedure, const Eigen::Vector3d& tip) {
  const sim::TargetDistance distance = sim::distance_to(*procedure.target, *procedure.centrelines, tip);
  return fmt::format("{}, {:.1f} mm to go, {:.2f} radii from the centreline",
                     distance.reached ? "reached" : "not reached", distance.to_go_mm, distance.offset_radii);
}

std::string branch_text(const Procedure& procedure, const Eigen::Vector3d& tip) {
  const std::int32_t branch = procedure.centrelines->branch_at(tip);
  if (branch < 0) return "";
  return fmt::format(", in branch {}",
                     procedure.centrelines->branches()[static_cast<std::size_t>(branch)].name);
}

Eigen::Vector3d tip_of(const Procedure& procedure) {
  return procedure.last.points.empty() ? procedure.scene.access.position_mm
                                       : procedure.last.points.front().position_mm;
}

std::string subtitle_of(const Procedure& procedure) {
  const fs::path& file = procedure.scene.vessel.file;
  return fmt::format(
      "{}, {:.0f} mm inserted into {}", procedure.scene.instrument.model, procedure.last.inserted_length_mm,
      file.empty() ? procedure.vessel.source : (file.parent_path().filename() / file.filename()).string());
}

std::string picture_of(const Procedure& procedure, const io::CrossingVerdict& verdict) {
  const io::RunStatistics& statistics = procedure.statistics;
  const Eigen::Vector3d tip = tip_of(procedure);
  io::PictureContent content;
  content.title = procedure.scene.title;
  content.subtitle = subtitle_of(procedure);
  content.numbers = {
      {"Inserted", fmt::format("{:.1f} mm", procedure.last.inserted_length_mm)},
      {"Tip", fmt::format("{:.1f}, {:.1f}, {:.1f} mm", tip.x(), tip.y(), tip.z())},
      {"Largest push", fmt::format("{:.3f} N", statistics.max_push_force_n)},
      {"Largest torque", fmt::format("{:.3f} N·mm", statistics.max_torque_n_mm)},
      {"Largest wall force in 5 mm", fmt::format("{:.3f} N", statistics.max_force_5mm_n)},
      {"Wall crossings", verdict.crossings ? fmt::format("{}", *verdict.crossings) : "not judged"}};
  content.forces = procedure.forces;
  content.gravity_m_per_s2 = procedure.scene.simulation.gravity_m_per_s2;
  return io::wire_picture_svg(procedure.vessel.repaired.mesh, procedure.last, procedure.scene.access,
                              content);
}

void print_table(const Procedure& procedure, const io::CrossingVerdict& verdict,
                 const io::MachineFacts& machine, const io::RunOutput& output) {
  const io::RunStatistics& statistics = procedure.statistics;
  const Eigen::Vector3d tip = tip_of(procedure);
  const auto row = [](const char* name, const std::string& value) {
    fmt::print("  {:<18} {}\n", name, value);
  };
  fmt::print("{}: {} steps, {} converged, {} split\n", procedure.scene.name, statistics.steps,
             statistics.converged_steps, statistics.split_steps);
  row("inserted", fmt::format("{:.1f} mm", procedure.last.inserted_length_mm));
  row("tip",
      fmt::format("({:.1f}, {:.1f}, {:.1f}) mm{}", tip.x(), tip.y(), tip.z(), branch_text(procedure, tip)));
  if (procedure.target) row("target", target_text(procedure, tip));
  row("largest push", fmt::format("{:.3f} N", statistics.max_push_force_n));
  row("largest torque", fmt::format("{:.3f} N mm", statistics.max_torque_n_mm));
  row("largest wall force", fmt::format("{:.3f} N in 5 mm, {:.3f} N at the tip", statistics.max_force_5mm_n,
                                        statistics.max_tip_force_n));
  row("wall crossings", crossings_text(verdict));
  row("events", events_text(statistics));
  row("step time", fmt::format("{:.0f} us median, {:.0f} us 99 %", io::percentile(statistics.step_us, 0.5),
                               io::percentile(statistics.step_us, 0.99)));
  row("preparation",
      fmt::format("{:.2f} s{}", machine.preparation_s, machine.field_from_cache ? ", from the cache" : ""));
  row("peak memory", fmt::format("{:.0f} MB", machine.peak_memory_mb));
  std::string files;
  for (const std::string& name : output.written()) files += (files.empty() ? "" : ", ") + name;
  row("written", fmt::format("{}: {}", output.folder().string(), files));
  if (!io::vtp_available())
    row("",
        "wire.vtp, wire.pvd and steps/ are not written: this build has no VTK (ENDOWIRE_WITH_VTK is off)");
}

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

void write_results(const Procedure& procedure, const fs::path& triangles, double peak_mb,
                   const RunOptions& options, io::RunOutput& output, Progress& progress) {
  progress.stage("judging wall crossings …");
  const bool of_the_file = io::uses_the_files_triangles(procedure.vessel);  // else written in mm
  const io::CrossingVerdict verdict = judge_crossings(
      output.folder() / "wire.pvd", triangles, of_the_file ? vessel::name_of(procedure.vessel.unit) : "mm");
  output.file("wire.svg", picture_of(procedure, verdict));
  const io::MachineFacts machine{peak_mb, procedure.preparation_s,
                                 procedure.prepared.origin == io::FieldOrigin::cached, instruction_set()};
  const std::string summary =
      io::summary_json(procedure.scene, procedure.vessel, *procedure.prepared.field,
                       {*procedure.centrelines, procedure.target}, procedure.statistics, procedure.last,
                       procedure.state_hash, verdict, machine);
  progress.stage("writing the report …");
  output.file("report.html",
              io::report_html({procedure.scene.title, subtitle_of(procedure), summary,
                               procedure.vessel.repaired.mesh, *procedure.history, procedure.scene.access,
                               procedure.scene.simulation.gravity_m_per_s2}));
  output.file("summary.json", summary);
  progress.clear();
  if (!options.quiet) print_table(procedure, verdict, machine, output);
}

}  // namespace endowire::cli

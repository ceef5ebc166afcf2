#include "vessels_section.hpp"

#include <fmt/format.h>

#include "table.hpp"
#include "verdict.hpp"

namespace endowire::paper {

namespace {

struct Tables {
  Table figures{{"vessel", "triangles", "steps", "solved", "halved", "snaps",
                 "detections a step without a snap", "Newton iterations", "rods",
                 "energy of a change of rods, most [mJ]", "deepest behind the wall [mm]", "largest push [N]",
                 "ends in", "target"}};
  Table times{{"vessel", "median of a step [ms]", "99 % [ms]", "advance in real time [mm/s]"}};
  bool sound = true;
};

void add(const Case& subject, const Run& run, Tables& tables) {
  const double steps = static_cast<double>(run.steps.size());
  tables.sound = tables.sound && run.complete() && run.deepest_mm <= kCrossing_mm;
  tables.figures.row({subject.sort, fmt::format("{}", subject.procedure.vessel.triangles),
                      fmt::format("{}", run.commands), fmt::format("{}", run.converged),
                      fmt::format("{}", run.splits), fmt::format("{}", run.snaps),
                      fmt::format("{:.3f}", run.calm_detections / std::max(1.0, steps - run.snaps)),
                      fmt::format("{:.1f}", run.iterations / steps), fmt::format("{:.0f}", run.mean_rods()),
                      fmt::format("{:.4f}", run.resolution_energy_mj), fmt::format("{:.3f}", run.deepest_mm),
                      fmt::format("{:.3f}", run.most_push_n), run.branch,
                      !subject.procedure.target ? ""
                      : run.reached             ? "reached"
                                                : "**missed**"});
  tables.times.row({subject.sort, fmt::format("{:.2f}", 1e-3 * run.percentile_us(0.5)),
                    fmt::format("{:.2f}", 1e-3 * run.percentile_us(0.99)),
                    fmt::format("{:.0f}", 1e6 / run.mean_us())});
}

}  // namespace

Section vessels_section(const std::vector<Compared>& generated, const std::vector<Case>& real) {
  Tables tables;
  for (const Compared& one : generated) add(*one.subject, one.runs.back(), tables);
  for (const Case& one : real) add(one, play(one.procedure), tables);
  Section section;
  section.markdown = fmt::format(
      R"(## 5. Wide, tortuous, narrow and branching vessels

**Set-up.** The procedures of section 2 as the product plays them{}. *Solved* means: forces balance to 1e-6 and every
wall was held against the field. *Deepest* is the surface of the wire behind the wall at the end of any step, every
0.5 mm along the wire, by the exact distance to the triangles; the wall yields by up to 0.15 mm, more than 0.2 mm
would be a crossing. (The ways between steps are judged by `check_crossings` in `tests/vessels`, not here.)

{}
{}
)",
      real.empty() ? "; real vessels (`../shared`) were not there"
                   : ", and two in a real aorta (`../shared`)",
      tables.figures.markdown(), tables.times.markdown());
  section.markdown += claim("The method is robust in vessels of every sort", verdict(tables.sound, false),
                            "every step solved, no wall crossed.");
  section.markdown += "\n";
  return section;
}

}  // namespace endowire::paper

#include "rods_section.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "support/chart.hpp"
#include "table.hpp"
#include "verdict.hpp"

namespace endowire::paper {

using drawing::Chart;
using drawing::Mark;
using drawing::Series;
using drawing::svg;

namespace {

constexpr std::array<double, 5> kTurns_deg{-10.0, -5.0, 0.0, 5.0, 10.0};

struct Point {
  double rods, beside_mm;
};

std::vector<Point> points_of(const Compared& one) {
  std::vector<Point> points;
  for (const Run& run : one.runs)
    points.push_back({run.mean_rods(), difference(run, one.reference).beside_median_mm});
  return points;
}

/// How many rods of one length would lie as near to the reference as the adapted ones, by log-log interpolation; 0 outside.
double fixed_rods_of_equal_error(const std::vector<Point>& points) {
  const double error = points.back().beside_mm;
  for (std::size_t i = 0; i + 2 < points.size(); ++i) {
    const Point& coarse = points[i];
    const Point& fine = points[i + 1];
    if (error > coarse.beside_mm || error < fine.beside_mm) continue;
    const double t = std::log(error / coarse.beside_mm) / std::log(fine.beside_mm / coarse.beside_mm);
    return coarse.rods * std::pow(fine.rods / coarse.rods, t);
  }
  return 0.0;
}

/// In how many of a few slightly turned runs the tip ends in the branch that the fine wire ends in.
std::vector<int> agreement(const Procedure& procedure) {
  std::vector<int> same(kinds().size(), 0);
  for (const double turn_deg : kTurns_deg) {
    const Procedure other = turned(procedure, turn_deg);
    const std::string expected = play(other, fixed_rods(0.5)).branch;
    for (std::size_t k = 0; k < kinds().size(); ++k)
      same[k] += play(other, kinds()[k].rods()).branch == expected ? 1 : 0;
  }
  return same;
}

std::string state_of(const Run& run) {
  switch (outcome_of(run)) {
    case Outcome::through:
      return "through";
    case Outcome::slipped:
      return fmt::format("**locked** at {:.0f} mm", run.steps.back().inserted_mm);
    case Outcome::stuck:
      return fmt::format("**{} of {} steps solved**", run.converged, run.commands);
    case Outcome::crossed:
      return "**crossed**";
  }
  return "";
}

Chart chart_of(const Compared& one) {
  const std::vector<Point> points = points_of(one);
  Series fixed{"rods of one length, 16 to 1 mm", {}, true, Mark::ring, 0};
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    fixed.points.push_back({points[i].rods, points[i].beside_mm});
  const Series adaptive{"adapted rods", {{points.back().rods, points.back().beside_mm}}, false, Mark::dot, 1};
  return {one.subject->sort,
          {"rods, mean", true},
          {"beside the fine wire, median [mm]", true},
          {fixed, adaptive},
          false};
}

struct Tally {
  int saves = 0;    ///< vessels in which adapted rods are fewer
  int decided = 0;  ///< in which both can be compared
  std::string ratios;
  std::vector<int> same;  ///< ends like those of the fine wire, by kind
  int ends = 0;
};

std::string rows(const std::vector<Compared>& all, Tally& tally) {
  Table table({"vessel", "rods", "mean number", "run", "ends in", "beside, median [mm]", "beside, 90 % [mm]",
               "push, median [%]", "same end, turned by up to ±10°"});
  tally.same.assign(kinds().size(), 0);
  for (const Compared& one : all) {
    const std::vector<int> same = agreement(one.subject->procedure);
    tally.ends += static_cast<int>(kTurns_deg.size());
    table.row({one.subject->sort, "0.5 mm", fmt::format("{:.0f}", one.reference.mean_rods()),
               state_of(one.reference), one.reference.branch, "", "", "", ""});
    for (std::size_t k = 0; k < kinds().size(); ++k) {
      const Run& run = one.runs[k];
      const Difference d = difference(run, one.reference);
      tally.same[k] += same[k];
      const bool elsewhere = run.branch != one.reference.branch;
      table.row({"", kinds()[k].name, fmt::format("{:.0f}", run.mean_rods()), state_of(run),
                 elsewhere ? "**" + run.branch + "**" : run.branch, fmt::format("{:.3f}", d.beside_median_mm),
                 fmt::format("{:.3f}", d.beside_p90_mm), fmt::format("{:.1f}", 100.0 * d.push_median),
                 fmt::format("{} of {}", same[k], kTurns_deg.size())});
    }
    const std::vector<Point> points = points_of(one);
    const double equal = fixed_rods_of_equal_error(points);
    if (equal == 0.0) continue;
    ++tally.decided;
    const double ratio = equal / points.back().rods;
    tally.saves += ratio > 1.1 ? 1 : 0;
    tally.ratios += fmt::format("{}{:.2f} ({})", tally.ratios.empty() ? "" : ", ", ratio, one.subject->sort);
  }
  return table.markdown();
}

std::string times(const std::vector<Compared>& all) {
  std::vector<std::string> head{"mean time of a step"};
  for (const Kind& kind : kinds()) head.push_back(kind.name);
  Table table(head);
  for (const Compared& one : all) {
    std::vector<std::string> row{one.subject->sort};
    const double adaptive_us = one.runs.back().mean_us();
    for (const Run& run : one.runs)
      row.push_back(run.complete() ? fmt::format("{:.2f}", run.mean_us() / adaptive_us) : "not solved");
    row.back() += fmt::format(" ({:.2f} ms)", 1e-3 * adaptive_us);
    table.row(row);
  }
  return table.markdown();
}

}  // namespace

Section rods_section(const std::vector<Compared>& all) {
  Tally tally;
  const std::string table = rows(all, tally);
  std::vector<Chart> charts;
  for (const Compared& one : all) charts.push_back(chart_of(one));
  Section section;
  section.figures = {{"rods.svg", svg(charts)}};
  section.markdown =
      "## 2. Adapted against fixed rods in whole procedures\n\n**Set-up.** Vessels made in code, friction "
      "and weight on:\n\n";
  for (const Compared& one : all)
    section.markdown += "- *" + one.subject->sort + "*: " + one.subject->what + ".\n";
  section.markdown += fmt::format(
      R"(
Each procedure is played on rods of one length and on adapted ones and held against rods of 0.5 mm, in the steps in
which both are calm (five steps after a snap are left out). Branches are named as `endowire inspect` lists them. Where
a tip meets a division, a small difference decides; so each procedure is also begun with the wire turned by −10, −5,
0, 5 and 10°, and the last column counts in how many of these the tip ends where that of the fine wire ends.

{}
)",
      table);
  section.markdown += picture("rods.svg", "Distance beside the fine wire over the number of rods");
  section.markdown += "Times, in units of the adapted wire's:\n\n" + times(all) + "\n";
  std::string ends;
  for (std::size_t k = 0; k < kinds().size(); ++k)
    ends += fmt::format("{}{} {}", ends.empty() ? "" : ", ", kinds()[k].name, tally.same[k]);
  section.markdown += fmt::format(
      R"(**What we find.** Long rods fail quietly here: they come through most procedures and end in another branch. Of {} ends
these agree with the fine wire's: {}. A polygon of long rods touches the wall elsewhere and points elsewhere, and at
an ostium that decides.

For equal distance from the fine wire, rods of one length would have to be so many times as many as the adapted ones:
{}. Adapting pays where a wire lies straight here and bent there. In the narrow vessel the bound on rods by lumen
diameter asks for more than the shape needs, and nothing is saved. What is always saved is the choice: one length has to
suit the tightest place of the whole way (section 1), which nobody knows beforehand. The time of a step falls less than
the number of rods, for it goes with the contact samples as well, and these do not depend on the rods; in the tortuous
vessel long rods save no time at all, since a polygon that wedges needs more iterations.

)",
      tally.ends, ends, tally.ratios);
  section.markdown +=
      claim("Adapted rods are as accurate as fixed ones with fewer rods",
            verdict(tally.saves == static_cast<int>(all.size()), tally.saves > 0),
            "rods of one length that lie as near to the fine wire are more by a tenth, in every vessel.");
  section.markdown += claim("Fixed rods send the tip elsewhere, adapted ones do not",
                            verdict(tally.same.back() == tally.ends && tally.same.front() < tally.ends,
                                    tally.same.back() > tally.same.front()),
                            "the adapted wire ends like the fine one in every run, that of 16 mm does not.");
  section.markdown += "\n";
  return section;
}

}  // namespace endowire::paper

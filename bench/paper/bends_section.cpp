#include "bends_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "difference.hpp"
#include "endowire/io/statistics.hpp"
#include "kinds.hpp"
#include "support/chart.hpp"
#include "table.hpp"
#include "verdict.hpp"

namespace endowire::paper {

using drawing::Chart;
using drawing::Mark;
using drawing::Series;
using drawing::svg;

namespace {

constexpr double kReference_mm = 0.25;  // rods of the wire that the others are held against

/// A bend passed by all kinds of wire.
struct Passed {
  Bend bend;
  std::vector<Run> runs;  ///< in the order of kinds()
  std::vector<Difference> differences;
};

Passed pass(const Bend& bend) {
  const Procedure procedure = push_through(bend);
  const Run reference = play(procedure, fixed_rods(kReference_mm));
  Passed passed{bend, {}, {}};
  for (const Kind& kind : kinds()) {
    passed.runs.push_back(play(procedure, kind.rods()));
    passed.differences.push_back(difference(passed.runs.back(), reference));
  }
  return passed;
}

std::string cell(const Run& run, const Difference& d) {
  const double at_mm = run.steps.back().inserted_mm;
  switch (outcome_of(run)) {
    case Outcome::through:
      return fmt::format("{:.3f} mm, {:.1f} %", d.beside_median_mm, 100.0 * d.push_median);
    case Outcome::slipped:
      return fmt::format("**locked** at {:.0f} mm", at_mm);
    case Outcome::stuck:
      return fmt::format("**not solved** from {:.0f} mm", at_mm);
    case Outcome::crossed:
      return fmt::format("**crossed**, {:.2f} mm", run.deepest_mm);
  }
  return "";
}

std::vector<std::string> cells(const Passed& passed) {
  std::vector<std::string> row{fmt::format("{:g}", passed.bend.radius_mm),
                               fmt::format("{:g}", passed.bend.lumen_mm),
                               fmt::format("{:.1f}", passed.bend.longest_rod_mm())};
  for (std::size_t k = 0; k < passed.runs.size(); ++k)
    row.push_back(cell(passed.runs[k], passed.differences[k]));
  return row;
}

std::vector<std::string> head() {
  std::vector<std::string> names{"bend radius [mm]", "lumen [mm]", "4√(Rc) [mm]"};
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  return names;
}

bool through(const Run& run) {
  return outcome_of(run) == Outcome::through;
}

/// What a kind of wire did over all bends.
struct Totals {
  int through = 0;
  double rods = 0.0;  ///< mean over the bends passed
  std::vector<double> beside_mm, push;
};

Totals totals(const std::vector<Passed>& all, std::size_t kind) {
  Totals sum;
  for (const Passed& passed : all) {
    if (!through(passed.runs[kind])) continue;
    ++sum.through;
    sum.rods += passed.runs[kind].mean_rods();
    sum.beside_mm.push_back(passed.differences[kind].beside_median_mm);
    sum.push.push_back(passed.differences[kind].push_median);
  }
  sum.rods /= std::max(1, sum.through);
  return sum;
}

std::string totals_table(const std::vector<Passed>& all) {
  Table table({"rods", "bends passed", "rods, mean of these", "beside the fine wire, median [mm]",
               "largest [mm]", "push, median [%]", "largest [%]"});
  for (std::size_t k = 0; k < kinds().size(); ++k) {
    const Totals sum = totals(all, k);
    table.row({kinds()[k].name, fmt::format("{} of {}", sum.through, all.size()),
               fmt::format("{:.1f}", sum.rods), fmt::format("{:.3f}", io::percentile(sum.beside_mm, 0.5)),
               fmt::format("{:.3f}", io::percentile(sum.beside_mm, 1.0)),
               fmt::format("{:.1f}", 100.0 * io::percentile(sum.push, 0.5)),
               fmt::format("{:.1f}", 100.0 * io::percentile(sum.push, 1.0))});
  }
  return table.markdown();
}

/// Which lengths come through which bends, and the line that geometry draws.
Figure map(const std::vector<Passed>& all) {
  Series passed{"came through", {}, false, Mark::dot, 0};
  Series failed{"locked or not solved", {}, false, Mark::cross, 1};
  Series limit{"longest straight rod that fits, 4√(Rc)", {}, true, Mark::none, -1};
  for (const Passed& one : all) {
    const double root = 0.25 * one.bend.longest_rod_mm();
    for (std::size_t k = 0; k < kinds().size(); ++k) {
      if (kinds()[k].length_mm == 0.0) continue;
      (through(one.runs[k]) ? passed : failed).points.push_back({root, kinds()[k].length_mm});
    }
  }
  for (const double root : {1.0, 2.0, 4.0, 5.0}) limit.points.push_back({root, 4.0 * root});
  return {"bends.svg", svg({{"Rods of one length in a bend",
                             {"√(bend radius × clearance) [mm]", true},
                             {"rod length [mm]", true},
                             {passed, failed, limit},
                             false}})};
}

/// Outlines of a bend and the wires in it.
Figure wires_in(const Passed& passed) {
  const auto wall = [&](double offset_mm) {
    Series line{"", {}, true, Mark::none, -1};
    const double r = passed.bend.radius_mm + offset_mm;
    line.points.push_back({passed.bend.radius_mm - r, -20.0});
    for (int i = 0; i <= 60; ++i) {
      const double a = std::numbers::pi * i / 60.0;
      line.points.push_back({passed.bend.radius_mm - r * std::cos(a), r * std::sin(a)});
    }
    line.points.push_back({passed.bend.radius_mm + r, -30.0});
    return line;
  };
  std::vector<Chart> charts;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}, kinds().size() - 1}) {
    Chart chart;
    chart.title = kinds()[k].length_mm > 0.0 ? "rods of " + kinds()[k].name : "adapted rods";
    chart.x.label = "x [mm]";
    chart.y.label = "z [mm]";
    chart.true_to_scale = true;
    chart.series = {wall(0.5 * passed.bend.lumen_mm), wall(-0.5 * passed.bend.lumen_mm)};
    Series wire{"", {}, true, Mark::dot, static_cast<int>(k == 0)};
    const Line& joints = passed.runs[k].steps.back().joints_mm;
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) wire.points.push_back({joints[j].x(), joints[j].z()});
    chart.series.push_back(wire);
    charts.push_back(chart);
  }
  return {"bend_wires.svg", svg(charts)};
}

/// Bends that adapted rods passed and these did not; and how much longer than the geometric limit they were, at least.
struct Failures {
  int fixed = 0, adaptive = 0;
  double least_ratio = HUGE_VAL;
  double most_ratio_passed = 0.0;
  double most_push = 0.0;  ///< error of the push of those that came through, relative
  double deepest_mm = 0.0;
};

Failures failures(const std::vector<Passed>& all) {
  Failures count;
  for (const Passed& one : all) {
    for (std::size_t k = 0; k < kinds().size(); ++k) {
      const double length = kinds()[k].length_mm;
      count.deepest_mm = std::max(count.deepest_mm, one.runs[k].deepest_mm);
      if (length == 0.0) {
        count.adaptive += through(one.runs[k]) ? 0 : 1;
        continue;
      }
      const double ratio = length / one.bend.longest_rod_mm();
      if (through(one.runs[k])) {
        count.most_ratio_passed = std::max(count.most_ratio_passed, ratio);
        count.most_push = std::max(count.most_push, one.differences[k].push_median);
      } else {
        ++count.fixed;
        count.least_ratio = std::min(count.least_ratio, ratio);
      }
    }
  }
  return count;
}

}  // namespace

std::string bend_row(const Bend& bend) {
  Table table(head());
  table.row(cells(pass(bend)));
  const std::string& text = table.markdown();
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

Section bends_section() {
  std::vector<Passed> all;
  for (const double radius_mm : {40.0, 20.0, 10.0, 5.0})
    for (const double lumen_mm : {6.0, 3.0, 1.5, 0.75}) all.push_back(pass({radius_mm, lumen_mm}));
  const auto pictured = std::find_if(all.begin(), all.end(), [](const Passed& one) {
    return one.bend.radius_mm == 10.0 && one.bend.lumen_mm == 3.0;
  });
  const Failures count = failures(all);

  Section section;
  section.figures = {map(all), wires_in(*pictured)};
  Table table(head());
  for (const Passed& one : all) table.row(cells(one));
  section.markdown = fmt::format(
      R"(## 1. Fixed rods in bends

**Set-up.** A 0.014" wire (EI 10 N·mm², friction 0.05, straight, weightless) is pushed through a tube that bends by
180°, a millimetre a step, until 30 mm lie beyond the bend. The wall is a closed form; no mesh blurs it. Rods are of
one length throughout, or adapted by the default rule; the reference has rods of {} mm. An entry tells how far the
rods lie beside the reference (the farthest point of any rod, median over the steps), and how far the push is off; or
how the wire failed: *locked* means that the hand slips at its grip of 2 N while the wire stands still.

{}
{}
)",
      kReference_mm, table.markdown(), totals_table(all));
  section.markdown +=
      picture("bends.svg", "Lengths that come through, and the longest straight rod that fits");
  section.markdown += picture("bend_wires.svg",
                              "The end of three runs in a bend of 10 mm radius and 3 mm lumen: rods of 16 mm "
                              "lock, rods of 8 mm pass as a polygon, adapted ones follow the bend");
  const std::size_t two_mm = 3;  // of kinds()
  const Totals adapted = totals(all, kinds().size() - 1);
  const Totals two = totals(all, two_mm);
  section.markdown += fmt::format(
      R"(**What we find.** Where a fixed-length wire fails is geometry, not numerics. A straight rod passes a bend of radius R
with a clearance c between wire and wall as long as it is shorter than 4√(Rc), both ends on the outer wall and its
middle on the inner one. No rod shorter than {:.2f} of that failed, and none longer than {:.2f} of it came through;
what lies between is the wall, which gives way by up to 0.15 mm. The failure is loud: the push climbs from hundredths
of a newton to the grip, or the step is reported as not solved. The wire came {:.2f} mm behind the wall at most, within
what the wall yields. Before it fails, a long rod is wrong: its middle lies h²/8R beside the curve, and where it just
fits, it wedges: the push is then off by up to {:.0f} % while the shape still looks fair.

Adapted rods failed in {} of {} bends. They save nothing here: {:.0f} adapted rods lie {:.3f} mm beside the fine wire in
the median, {:.0f} rods of 2 mm {:.3f} mm. All of such a wire is bent or near a bend, so there is nothing to be coarse
about; and in the narrowest lumens the rule, a rod of at most two lumen diameters, asks for more than the shape needs.

)",
      count.least_ratio, count.most_ratio_passed, count.deepest_mm, 100.0 * count.most_push, count.adaptive,
      all.size(), adapted.rods, io::percentile(adapted.beside_mm, 0.5), two.rods,
      io::percentile(two.beside_mm, 0.5));
  section.markdown +=
      claim("A wire of fixed rods fails in high curvature and small diameter, an adapted one does not",
            verdict(count.adaptive == 0 && count.fixed > 0, count.fixed > count.adaptive),
            "adapted rods pass every bend, and some fixed length does not.");
  section.markdown += "\n";
  return section;
}

}  // namespace endowire::paper

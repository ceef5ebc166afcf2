#include "sensitivity_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "support/chart.hpp"
#include "table.hpp"
#include "verdict.hpp"

namespace endowire::paper {

using drawing::Chart;
using drawing::Mark;
using drawing::Series;
using drawing::svg;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const std::vector<double> kTurns_deg{2.0, 5.0, 10.0, 20.0, 40.0, 80.0};
const std::vector<double> kBiases_deg{1.0, 3.0, 8.6, 20.0, 50.0};
const std::vector<double> kCurves{0.0, 0.5, 0.8, 0.9, 1.0, 1.1, 1.2, 1.5};

/// One value of a parameter, played.
struct Tried {
  double value;
  Run run;
  Difference from_reference;
};

using Change = sim::ResolutionSpec (*)(double value);

/// φ_m beside the other criteria, as in the product.
sim::ResolutionSpec with_turn(double deg) {
  sim::ResolutionSpec rods;
  rods.max_turn_rad = deg * kDegree;
  return rods;
}

/// φ_m as the only criterion that looks at the shape: the others are as wide as they go.
sim::ResolutionSpec with_turn_alone(double deg) {
  sim::ResolutionSpec rods = with_turn(deg);
  rods.shape_tolerance_mm = 1.0;
  rods.lumen_diameters = 100.0;
  return rods;
}

sim::ResolutionSpec with_bias(double deg) {
  sim::ResolutionSpec rods;
  rods.max_bias_rad = deg * kDegree;
  return rods;
}

std::vector<Tried> tried(const Compared& one, const std::vector<double>& values, Change change) {
  std::vector<Tried> all;
  for (const double value : values) {
    Run run = play(one.subject->procedure, change(value));
    const Difference d = difference(run, one.reference);
    all.push_back({value, std::move(run), d});
  }
  return all;
}

bool same_end(const std::vector<Tried>& all, const Compared& one) {
  return std::all_of(all.begin(), all.end(), [&](const Tried& t) {
    return t.run.complete() && t.run.branch == one.reference.branch;
  });
}

void add_rows(Table& table, const Compared& one, const std::string& criterion,
              const std::vector<Tried>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Tried& t = all[i];
    const bool elsewhere = t.run.branch != one.reference.branch;
    table.row({i == 0 ? one.subject->sort : "", i == 0 ? criterion : "", fmt::format("{:g}°", t.value),
               fmt::format("{:.0f}", t.run.mean_rods()),
               t.run.complete() ? (elsewhere ? "**" + t.run.branch + "**" : t.run.branch)
                                : fmt::format("**{} of {} steps solved**", t.run.converged, t.run.commands),
               fmt::format("{:.3f}", t.from_reference.beside_median_mm),
               fmt::format("{:.1f}", 100.0 * t.from_reference.push_median)});
  }
}

Chart chart_of(const Compared& one, const std::vector<Tried>& with_others, const std::vector<Tried>& alone) {
  Chart chart{one.subject->sort, {"φ_m [°]", true}, {"beside the fine wire, median [mm]", true}, {}, false};
  int colour = 0;
  for (const auto* all : {&with_others, &alone}) {
    Series series{colour == 0 ? "with the other criteria" : "φ_m alone", {}, true, Mark::ring, colour};
    for (const Tried& t : *all) series.points.push_back({t.value, t.from_reference.beside_median_mm});
    chart.series.push_back(series);
    ++colour;
  }
  return chart;
}

/// The curve of the tip, which the bias angles are made of, scaled: a change of the instrument, not of its rods.
std::string curves(const std::vector<const Compared*>& compared, bool& matters) {
  Table table({"vessel", "tip", "ends in", "farthest from the usual tip's shape, median [mm]",
               "push, median change [%]", "largest push [N]"});
  for (const Compared* one : compared) {
    const Run& usual = one->runs.back();
    for (const double scale : kCurves) {
      Procedure procedure = one->subject->procedure;
      double angle_deg = 0.0;
      for (rod::Section& section : procedure.wire.sections) {
        section.rest_curvature_per_mm *= scale;
        angle_deg += section.rest_curvature_per_mm * section.length_mm / kDegree;
      }
      const Run run = play(procedure);
      const Difference d = difference(run, usual);
      const bool elsewhere = run.branch != usual.branch;
      matters = matters || elsewhere;
      table.row({scale == kCurves.front() ? one->subject->sort : "", fmt::format("{:.0f}°", angle_deg),
                 elsewhere ? "**" + run.branch + "**" : run.branch, fmt::format("{:.2f}", d.beside_median_mm),
                 fmt::format("{:.1f}", 100.0 * d.push_median), fmt::format("{:.3f}", run.most_push_n)});
    }
  }
  return table.markdown();
}

}  // namespace

Section sensitivity_section(const std::vector<const Compared*>& compared) {
  const std::vector<std::string> head{"vessel",          "criterion", "value",
                                      "rods, mean",      "ends in",   "beside the fine wire, median [mm]",
                                      "push, median [%]"};
  Table turns(head);
  Table biases(head);
  std::vector<Chart> charts;
  bool turn_robust = true;
  bool alone_robust = true;
  bool bias_robust = true;
  double with_others_range_mm = 0.0;
  double alone_range_mm = 0.0;
  const auto most = [](const std::vector<Tried>& all) {
    return std::max_element(all.begin(), all.end(),
                            [](const Tried& a, const Tried& b) {
                              return a.from_reference.beside_median_mm < b.from_reference.beside_median_mm;
                            })
        ->from_reference.beside_median_mm;
  };
  for (const Compared* one : compared) {
    const std::vector<Tried> with_others = tried(*one, kTurns_deg, with_turn);
    const std::vector<Tried> alone = tried(*one, kTurns_deg, with_turn_alone);
    const std::vector<Tried> bias = tried(*one, kBiases_deg, with_bias);
    add_rows(turns, *one, "φ_m with the others", with_others);
    add_rows(turns, *one, "φ_m alone", alone);
    add_rows(biases, *one, "bias at a joint", bias);
    charts.push_back(chart_of(*one, with_others, alone));
    turn_robust = turn_robust && same_end(with_others, *one);
    alone_robust = alone_robust && same_end(alone, *one);
    bias_robust = bias_robust && same_end(bias, *one);
    with_others_range_mm = std::max(with_others_range_mm, most(with_others));
    alone_range_mm = std::max(alone_range_mm, most(alone));
  }
  bool curve_matters = false;
  const std::string curve_table = curves(compared, curve_matters);

  Section section;
  section.figures = {{"turns.svg", svg(charts)}};
  section.markdown = fmt::format(
      R"(## 4. Sensitivity to φ_m and to the bias angles

**Set-up.** φ_m, the largest turn at a joint, is a numerical bound here: where a joint turns by more, rods are
divided. It stands beside three others (sagitta of a rod, rods to a lumen diameter, bias at a joint;
`docs/decisions/0012`). It is varied with these in force, and alone, the others as wide as they go. Shapes and push
are held against rods of 0.5 mm. The default is 20°.

{}
)",
      turns.markdown());
  section.markdown += picture("turns.svg", "Distance beside the fine wire over φ_m");
  section.markdown += fmt::format(
      R"(The bias angles φ_1, φ_2, … are the curve of the tip, cut at the joints. How it is cut is numerical, bounded by
`max_bias_deg` (8.6° by default):

{}
What the curve *is* belongs to the instrument. Scaled, with everything else the same:

{}
)",
      biases.markdown(), curve_table);
  section.markdown += fmt::format(
      R"(**What we find.** With the other criteria in force, φ_m hardly matters from 10° on: the sagitta ε asks for more rods
than φ_m does, until a bend is tighter than 8ε/φ_m², a radius of {:.1f} mm at the defaults. The wire stays within {:.2f} mm
of the fine one. Alone, φ_m is no good criterion: a bound on the angle permits long rods in gentle bends, h = φ_m R,
however narrow the lumen, and from 10° on the longest rod allowed (16 mm) and the rest curve of the tip set the rods; the
error reaches {:.2f} mm, and still the tip ends in the same branch. How finely the bias angles are cut hardly matters
either; the other criteria cut a bent tip as well.

The curve of the tip itself is another matter. It is how the wire is steered: a straight tip ends elsewhere, as it must, while
a change of its angle by a tenth or two moves the tip by tenths of a millimetre and not into another branch.

)",
      8.0 * sim::ResolutionSpec{}.shape_tolerance_mm /
          (sim::ResolutionSpec{}.max_turn_rad * sim::ResolutionSpec{}.max_turn_rad),
      with_others_range_mm, alone_range_mm);
  section.markdown +=
      claim("The result does not depend on φ_m", verdict(turn_robust && alone_robust, turn_robust),
            "the tip ends where that of the fine wire does for every φ_m, also alone; partly if with the "
            "other criteria only.");
  section.markdown +=
      claim("The result does not depend on how the bias angles are cut", verdict(bias_robust, false),
            "the tip ends where that of the fine wire does for every bound.");
  section.markdown += claim("Bias angles steer the wire", verdict(curve_matters, false),
                            "some other curve of the tip ends in another branch.");
  section.markdown += "\n";
  return section;
}

}  // namespace endowire::paper

#include "long_wire_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coil.hpp"
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

constexpr double kLinear = 1.1;  // the largest exponent that is called linear

struct Pushed {
  Kind kind;
  LongWireRun run;
};

/// Exponent of the time over the rods at full length, between two lengths of rods.
double exponent_at_full_length(const LongWireRun& coarse, const LongWireRun& fine) {
  return std::log(fine.rows.back().median_us / coarse.rows.back().median_us) /
         std::log(fine.rows.back().rods / coarse.rows.back().rods);
}

std::string growth(const std::vector<Pushed>& all) {
  Table table({"rods", "inserted [mm]", "number", "contact samples", "Newton iterations", "factorisations",
               "median of a step [ms]", "a rod [µs]"});
  for (const Pushed& one : all) {
    for (std::size_t i = 4; i < one.run.rows.size(); i += 5) {
      const LongWireRow& row = one.run.rows[i];
      table.row({i == 4 ? one.kind.name : "", fmt::format("{:.0f}", row.inserted_mm),
                 fmt::format("{:.0f}", row.rods), fmt::format("{:.0f}", row.samples),
                 fmt::format("{:.1f}", row.iterations), fmt::format("{:.1f}", row.factorisations),
                 fmt::format("{:.2f}", 1e-3 * row.median_us),
                 fmt::format("{:.1f}", row.median_us / row.rods)});
    }
  }
  return table.markdown();
}

Figure figure(const std::vector<Pushed>& all) {
  Chart chart{"260 cm of wire in a coil", {"rods", true}, {"median of a step [ms]", true}, {}, false};
  for (std::size_t k = 0; k < all.size(); ++k) {
    Series series{all[k].kind.name, {}, true, Mark::ring, static_cast<int>(k)};
    for (const LongWireRow& row : all[k].run.rows) series.points.push_back({row.rods, 1e-3 * row.median_us});
    chart.series.push_back(series);
  }
  return {"long_wire.svg", svg({chart})};
}

}  // namespace

Section long_wire_section() {
  const Coil vessel = coil();
  std::vector<Pushed> all;
  for (const Kind& kind : {Kind{"8 mm", 8.0}, Kind{"4 mm", 4.0}, Kind{"2 mm", 2.0}, Kind{"adaptive", 0.0}})
    all.push_back({kind, push_long_wire(vessel, kind.rods())});
  Table ends({"rods", "steps", "solved", "inserted [mm]", "number at the end", "time ~ rods to the power"});
  double most = 0.0;
  double least = HUGE_VAL;
  bool all_in = true;
  for (const Pushed& one : all) {
    const double power = exponent(one.run.rows);
    most = std::max(most, power);
    least = std::min(least, power);
    all_in = all_in && one.run.converged == one.run.steps && one.run.inserted_mm > kLongWire_mm - 1.0;
    ends.row({one.kind.name, fmt::format("{}", one.run.steps), fmt::format("{}", one.run.converged),
              fmt::format("{:.0f}", one.run.inserted_mm), fmt::format("{:.0f}", one.run.rows.back().rods),
              fmt::format("{:.2f}", power)});
  }
  const double at_end = exponent_at_full_length(all[0].run, all[2].run);

  Section section;
  section.figures = {figure(all)};
  section.markdown = fmt::format(
      R"(## 6. 260 cm of wire

**Set-up.** A 0.035" wire of 260 cm is pushed into a coil (radius 80 mm, lumen 8 mm, triangles), a millimetre a step,
until all of it is in. Time is the median of a step over each 100 mm; the exponent is fitted from 150 rods on.

{}
{}
)",
      ends.markdown(), growth(all));
  section.markdown += picture("long_wire.svg", "Time of a step over the number of rods, as the wire goes in");
  const LongWireRow& early = all.back().run.rows[4];
  const LongWireRow& late = all.back().run.rows.back();
  section.markdown += fmt::format(
      R"(**What we find.** The time of a step grows faster than the length of the wire. From {:.0f} to {:.0f} mm the adapted wire
has {:.1f} times the rods, {:.1f} times the contact samples, {:.1f} times the Newton iterations and {:.1f} times the
factorisations of the band; a step takes {:.1f} times as long, about as samples times factorisations. Samples grow faster than
the length because the first turn lies free for the most part and all that follows touches. More factorisations are the
contact's doing as well: each turn of the coil multiplies the push, and the longer the wire, the more places change between
open and closed, stick and slip in one step. It is the length that costs, not the number of rods: at full length, {:.1f} times as many rods (2 instead of 8 mm) take {:.2f} times as long, an exponent of {:.2f}. Long rods
earn nothing here. Their polygon touches the wall at its corners, and more rounds go into settling these.

)",
      early.inserted_mm, late.inserted_mm, late.rods / early.rods, late.samples / early.samples,
      late.iterations / early.iterations, late.factorisations / early.factorisations,
      late.median_us / early.median_us, all[2].run.rows.back().rods / all[0].run.rows.back().rods,
      all[2].run.rows.back().median_us / all[0].run.rows.back().median_us, at_end);
  section.markdown +=
      claim("Wires of 260 cm are simulated", verdict(all_in, false), "all of it goes in, every step solved.");
  section.markdown += claim("The time of a step is linear in the number of rods, at equal length",
                            verdict(at_end <= kLinear, false),
                            "the exponent between rods of 8 and of 2 mm at full length is at most 1.1.");
  section.markdown += claim(
      "The time of a step is linear in the length of the wire", verdict(most <= kLinear, least <= kLinear),
      "the exponent as the wire goes in is at most 1.1 for all kinds of rods; partly if for some.");
  section.markdown += "\n";
  return section;
}

}  // namespace endowire::paper

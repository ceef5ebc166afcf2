// V16  Order of convergence in the rod length: errors of the cases of statics on 25 to 200 rods.
#include "refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "figures.hpp"

namespace endowire::test {

namespace {

/// Errors below this are those of the stop of Newton's method or of the closed form.
constexpr double kFloor = 1e-7;

}  // namespace

Checks with_order(Checks (*run)(int), int rods) {
  const Checks coarse = run(rods / 2);
  Checks fine = run(rods);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const double before = std::abs(coarse[i].error());
    const double after = std::abs(fine[i].error());
    if (fine[i].kind == ErrorKind::relative && after > kFloor && before < 1.0)
      fine[i].order = std::log2(before / after);
  }
  return fine;
}

Figure refinement_figure() {
  struct Line {
    const char* label;
    Checks (*run)(int);
    std::size_t check;
  };
  Figure figure{"v16",  "V16  Errors by the number of rods; the line falls with the square",
                "rods", "relative error",
                {},     false,
                true,   true};
  double highest = 0.0;
  for (const Line& line : {Line{"V1", tip_loaded_cantilever, 10},
                           {"V2", self_weight_cantilever, 2},
                           {"V4", euler_column, 0},

                           {"V6", michell_ring, 0},
                           {"V13", three_point_bend, 0}}) {
    Series ours{Mark::rings, {}, line.label};
    for (const int rods : {26, 50, 100, 200}) {
      const double error = std::abs(line.run(rods)[line.check].error());
      ours.points.push_back({static_cast<double>(rods), error});
      highest = std::max(highest, error);
    }
    figure.series.push_back({Mark::guide, ours.points, ""});
    figure.series.push_back(ours);
  }
  constexpr double kFewest = 26.0;
  constexpr double kMost = 200.0;
  figure.series.push_back(
      {Mark::line, {{kFewest, highest}, {kMost, highest * std::pow(kFewest / kMost, 2)}}, ""});
  return figure;
}

}  // namespace endowire::test

// bench_long_wire: 260 cm of wire in a coiled vessel. How the time of a step grows with the rods.
#include <fmt/format.h>

#include "paper/coil.hpp"

namespace {

using namespace endowire;

void bench(const paper::Coil& coil, bool adaptive) {
  sim::ResolutionSpec rods;
  rods.adaptive = adaptive;
  const paper::LongWireRun run = paper::push_long_wire(coil, rods);
  fmt::print("{} rods: {:.0f} mm in, {} of {} steps converged\n", adaptive ? "adaptive" : "uniform",
             run.inserted_mm, run.converged, run.steps);
  fmt::print("{:>10} {:>12} {:>14}\n", "rods", "median [us]", "per rod [us]");
  for (std::size_t i = 0; i < run.rows.size(); i += 3)
    fmt::print("{:>10.1f} {:>12.0f} {:>14.2f}\n", run.rows[i].rods, run.rows[i].median_us,
               run.rows[i].median_us / run.rows[i].rods);
  fmt::print("from 150 rods on time goes with rods to the power {:.2f}\n\n", paper::exponent(run.rows));
}

}  // namespace

int main() {
  const paper::Coil coil = paper::coil();
  for (const bool adaptive : {false, true}) bench(coil, adaptive);
  return 0;
}

#pragma once

#include "procedure.hpp"

namespace endowire::paper {

/// How a run differs from a reference of the same commands, in the steps in which both are calm and have as much wire inside.
struct Difference {
  double share = 0.0;             ///< of the commands that could be compared
  double beside_median_mm = 0.0;  ///< farthest point of the rods from the reference wire, over the steps
  double beside_p90_mm = 0.0;
  double beside_end_mm = 0.0;  ///< in the last step compared
  double push_median = 0.0;    ///< relative difference of the mean push over 50 steps
  double push_max = 0.0;
};

[[nodiscard]] Difference difference(const Run& run, const Run& reference);

/// Farthest point of the rods of a wire from the rods of another, ends in the sheath left out. [mm]
[[nodiscard]] double beside_mm(const Line& wire, const Line& reference);

}  // namespace endowire::paper

#pragma once

#include <vector>

namespace endowire::test {

/// V11: what the hand feels with so much wire inserted.
struct HandForce {
  double inserted_mm = 0.0;
  double force_n = 0.0;
};

/// A straight wire pushed into a torus, from tangent to its centreline, in steps.
[[nodiscard]] std::vector<HandForce> push_round_a_torus(double clearance_mm);
/// What it comes to: EI/(2(R + c)²).
[[nodiscard]] double steady_push_n(double clearance_mm);

}  // namespace endowire::test

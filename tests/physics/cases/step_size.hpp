#pragma once

#include <vector>

namespace endowire::test {

/// V16: the error of the shape by the size of the steps, with friction.
struct StepSizes {
  std::vector<double> step_mm;
  std::vector<double> error_mm;
};
[[nodiscard]] StepSizes step_sizes_with_friction();

}  // namespace endowire::test

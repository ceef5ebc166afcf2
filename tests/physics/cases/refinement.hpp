#pragma once

#include "cases.hpp"

namespace endowire::test {

/// A case on so many rods, with the order at which its errors fell since half as many.
[[nodiscard]] Checks with_order(Checks (*run)(int), int rods);

}  // namespace endowire::test

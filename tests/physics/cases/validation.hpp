#pragma once

#include <vector>

#include "support/validation_table.hpp"

namespace endowire::test {

/// The whole suite, V1 to V16: runs all of it.
[[nodiscard]] std::vector<Section> validation();

}  // namespace endowire::test

#pragma once

#include <string>
#include <vector>

#include "support/check.hpp"
#include "support/figure.hpp"

namespace endowire::test {

/// One test of the suite as docs/validation.md shows it.
struct Section {
  std::string title;
  std::string text;  ///< the set-up and where the closed form comes from
  std::vector<Figure> figures;
  Checks checks;
};

/// The whole suite, V1 to V16: runs all of it.
[[nodiscard]] std::vector<Section> validation();

}  // namespace endowire::test

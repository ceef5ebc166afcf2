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

/// The text of docs/validation.md: a section for each test, with its pictures and a line for each check. Errors are printed to a hundredth of
/// their tolerance and our values to the same place, so that the file does not depend on the compiler but for the last digit.
[[nodiscard]] std::string validation_document(const std::vector<Section>& sections);

/// The table of one section.
[[nodiscard]] std::string validation_table(const Checks& checks);

/// What is different between two documents or pictures but for one unit in the last printed digit of a number; empty when nothing is.
[[nodiscard]] std::string table_difference(const std::string& committed, const std::string& generated);

}  // namespace endowire::test

#pragma once

#include <string>
#include <vector>

#include "difference.hpp"
#include "kinds.hpp"
#include "procedures.hpp"

namespace endowire::paper {

/// A procedure that stands for a sort of vessel.
struct Case {
  std::string sort;  ///< wide, tortuous, narrow, branching
  std::string what;  ///< for people
  Procedure procedure;
};

/// Vessels made in code, one of every sort: nothing is needed from outside.
[[nodiscard]] std::vector<Case> generated_cases();
/// Those of ../shared; none when it is not there.
[[nodiscard]] std::vector<Case> real_cases();

/// A case played on rods of every kind, held against rods of half a millimetre.
struct Compared {
  const Case* subject = nullptr;
  Run reference;
  std::vector<Run> runs;  ///< in the order of kinds()
};
[[nodiscard]] Compared compared(const Case& subject);

}  // namespace endowire::paper

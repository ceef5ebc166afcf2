#pragma once

#include <string>
#include <vector>

#include "procedure.hpp"

namespace endowire::paper {

/// A way to divide a wire into rods.
struct Kind {
  std::string name;
  double length_mm = 0.0;  ///< of fixed rods; 0: adapted ones

  [[nodiscard]] sim::ResolutionSpec rods() const {
    return length_mm > 0.0 ? fixed_rods(length_mm) : sim::ResolutionSpec{};
  }
};

/// Those that are compared.
[[nodiscard]] inline std::vector<Kind> kinds() {
  return {{"16 mm", 16.0}, {"8 mm", 8.0}, {"4 mm", 4.0}, {"2 mm", 2.0}, {"1 mm", 1.0}, {"adaptive", 0.0}};
}

/// How a wire came through.
enum class Outcome { through, slipped, stuck, crossed };

[[nodiscard]] inline Outcome outcome_of(const Run& run) {
  if (run.deepest_mm > kCrossing_mm) return Outcome::crossed;
  if (!run.complete()) return Outcome::stuck;
  return run.slipped_mm > 5.0 ? Outcome::slipped : Outcome::through;
}

}  // namespace endowire::paper

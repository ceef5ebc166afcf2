#include "endowire/sim/resolution_spec.hpp"

#include <numbers>
#include <sstream>

#include "endowire/base/error.hpp"

namespace endowire::sim {

void ResolutionSpec::validate(const std::string& prefix) const {
  const auto require = [&](const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    std::ostringstream text;
    text << prefix << "." << name << " is " << value << "; must be between " << low << " and " << high;
    throw base::InputError(text.str());
  };
  constexpr double kLeastTurn_rad = 1e-3;
  constexpr double kMostTurn_rad = 0.5 * std::numbers::pi;
  require("rod_length_mm", rod_length_mm, 0.2, 20.0);
  require("longest_mm", longest_mm, 0.5, 64.0);
  require("shortest_mm", shortest_mm, 0.2, longest_mm);
  require("shape_tolerance_mm", shape_tolerance_mm, 1e-4, 1.0);
  require("max_turn_rad", max_turn_rad, kLeastTurn_rad, kMostTurn_rad);
  require("max_bias_rad", max_bias_rad, kLeastTurn_rad, kMostTurn_rad);
  require("lumen_diameters", lumen_diameters, 0.1, 100.0);
  require("budget_mj", budget_mj, 1e-9, 1e3);
}

}  // namespace endowire::sim

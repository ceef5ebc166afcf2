#pragma once

#include <string>

namespace endowire::sim {

/// How long the rods of a wire are.
struct ResolutionSpec {
  bool adaptive = true;  ///< false: rods of `rod_length_mm`, shorter only where max_bias_rad asks for it
  double rod_length_mm = 4.0;        ///< of uniform rods, 0.2 … 20
  double longest_mm = 16.0;          ///< of adaptive ones, 0.5 … 64
  double shortest_mm = 0.5;          ///< of adaptive ones, 0.2 … longest_mm
  double shape_tolerance_mm = 0.05;  ///< how far a rod may lie beside the curve that it stands for, 1e-4 … 1
  double max_turn_rad = 0.35;        ///< φ_m, largest turn of the wire at one joint, 1e-3 … π/2
  double max_bias_rad = 0.15;        ///< largest turn of the unloaded wire at one joint, 1e-3 … π/2
  double lumen_diameters = 2.0;      ///< longest rod in units of the lumen's diameter, 0.1 … 100
  double budget_mj =
      0.01;  ///< energy that changes may inject in one step before the others wait, 1e-9 … 1000

  /// @throws base::InputError naming the first value that is out of its range, as "PREFIX.longest_mm is …"
  void validate(const std::string& prefix) const;
};

}  // namespace endowire::sim

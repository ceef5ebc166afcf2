#pragma once

#include <memory>
#include <vector>

#include "endowire/rod/instrument.hpp"
#include "endowire/sim/resolution_spec.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::paper {

inline constexpr double kLongWire_mm = 2600.0;

/// A vessel for the longest wire there is: a coil that climbs, never back to where it was.
struct Coil {
  std::shared_ptr<const vessel::Field> field;
  sim::Access access;
};
[[nodiscard]] Coil coil();

/// A 0.035" hydrophilic wire, long enough to be pushed in so far.
[[nodiscard]] rod::Instrument long_wire();

/// What a step takes while a hundred millimetres of wire go in.
struct LongWireRow {
  double inserted_mm = 0.0;     ///< at the end of the window
  double rods = 0.0;            ///< mean
  double median_us = 0.0;       ///< of processor time
  double samples = 0.0;         ///< of contact, mean
  double iterations = 0.0;      ///< of Newton, mean
  double factorisations = 0.0;  ///< of the band, mean
};

struct LongWireRun {
  std::vector<LongWireRow> rows;
  int steps = 0;
  int converged = 0;
  double inserted_mm = 0.0;  ///< at the end
};

/// Pushes 260 cm of a 0.035" wire in, a millimetre a step, until it is in, slips in the hand or does not converge.
[[nodiscard]] LongWireRun push_long_wire(const Coil& coil, const sim::ResolutionSpec& rods);

/// Least-squares slope of log time over log rods, from 150 rods on: the first turn of the coil lies free at first, and a rod that touches
/// nothing costs less.
[[nodiscard]] double exponent(const std::vector<LongWireRow>& rows);

}  // namespace endowire::paper

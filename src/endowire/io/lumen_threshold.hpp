#pragma once

#include <string>
#include <vector>

#include "endowire/io/volume.hpp"

namespace endowire::io {

/// A value at which a grey-level image may be cut, and what then lies above it.
struct ThresholdCandidate {
  double value = 0.0;
  double sharpness_per_mm = 0.0;  ///< mean gradient over the surface of that value
  double part_above = 0.0;        ///< of all voxels
  std::size_t voxels_above = 0;
  double connected = 0.0;  ///< of those: in the largest piece
};

/// The threshold of the lumen, or why there is none.
struct ThresholdChoice {
  std::vector<ThresholdCandidate> candidates;  ///< in order of value; one where it is clear
  bool clear = false;
  std::string doubt;  ///< why it is not
};

/// Where the surfaces of an image are sharpest.
///
///   g(T) = Σ |b − a| / h  over  Σ 1   of all pairs of neighbouring voxels with a < T ≤ b, h apart
///
/// The surface of a vessel with contrast is where the values change most, half way between lumen and tissue; there g has a
/// maximum. It is clear when g has one alone, a part of the image that a lumen may take lies above it, and at least half
/// of that is connected. Air around a body, bone beside vessels, and noise do not pass for a lumen.
/// Source  after V. Pekar, R. Wiemker & D. Hempel, IEEE Visualization 2001, p. 223 (mean gradient over isosurfaces).
[[nodiscard]] ThresholdChoice find_lumen_threshold(const Volume& volume);

}  // namespace endowire::io

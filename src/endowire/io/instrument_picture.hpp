#pragma once

#include <string>

#include "endowire/io/instrument_file.hpp"

namespace endowire::io {

/// An instrument as one SVG: bending and torsional rigidity over the distance from the tip, and the unloaded end true to scale, at its width,
/// from the front and, where it is not flat, from above.
[[nodiscard]] std::string instrument_picture_svg(const InstrumentFile& file);

}  // namespace endowire::io

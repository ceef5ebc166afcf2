#pragma once

#include <nlohmann/json_fwd.hpp>

#include "endowire/vessel/generate.hpp"

namespace endowire::io {

/// What is known of a generated vessel beside its triangles: numbers it was made with, access, landmarks, and every
/// vessel's axis with its calibre, a point each `spacing_mm`.
[[nodiscard]] nlohmann::ordered_json generated_json(const vessel::GeneratedVessel& vessel,
                                                    double spacing_mm = 1.0);

}  // namespace endowire::io

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "endowire/rod/instrument.hpp"

namespace endowire::io {

/// An instrument as JSON, exact: reading back gives the same bits. An infinite kink curvature is null.
[[nodiscard]] nlohmann::json to_json(const rod::Instrument& instrument);

/// The instrument of such JSON.
/// @throws nlohmann::json::exception when a field is missing or of another type.
[[nodiscard]] rod::Instrument instrument_from_json(const nlohmann::json& value);

}  // namespace endowire::io

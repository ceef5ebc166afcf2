#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/measure.hpp"

namespace endowire::bench {

/// All but the steps.
[[nodiscard]] nlohmann::ordered_json to_json(const Measured& measured);

/// A line a step, or a line for every so many steps where there are more than a thousand: their means, and the largest time.
[[nodiscard]] std::string steps_csv(const Measured& measured);

/// NAME.json, NAME.csv, NAME.svg.
void write_results(const std::filesystem::path& folder, const Measured& measured);

/// The files NAME.json of a folder, as one CSV with a line a scenario and as a table to print.
[[nodiscard]] std::string summary_csv(const std::vector<nlohmann::ordered_json>& results);
[[nodiscard]] std::string summary_table(const std::vector<nlohmann::ordered_json>& results);

}  // namespace endowire::bench

#pragma once

#include <filesystem>
#include <string_view>

#include "endowire/io/summary.hpp"

namespace endowire::cli {

/// Asks the independent judge, `check_crossings`, about a recording. It is looked for beside this program and
/// in its build folder; without it, without VTK, or when it fails, the verdict holds the reason instead of a
/// count.
[[nodiscard]] io::CrossingVerdict judge_crossings(const std::filesystem::path& series,
                                                  const std::filesystem::path& vessel, std::string_view unit);

}  // namespace endowire::cli
